#pragma once
#include <string>

namespace sinew {

/// PNG bytes of an SVG drawing at `scale` pixels a unit. Needs no display.
std::string pngFromSvg(const std::string& svg, double scale);

}  // namespace sinew
