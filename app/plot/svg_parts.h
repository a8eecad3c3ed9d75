#pragma once
#include <string>

namespace sinew {

// Pieces of SVG that the figures are made of. Coordinates are pixels, y downwards.

std::string svgNumber(double value);
std::string tickText(double value);  ///< six digits at most, no "-0"
std::string svgEscaped(const std::string& text);
/// Opens the document with a white ground; to be closed by "</svg>".
std::string svgStart(double width, double height);
/// `more`: further attributes.
std::string svgText(double x, double y, const std::string& text, const std::string& more = {});
std::string svgLine(double x1, double y1, double x2, double y2, const std::string& stroke);
std::string svgRectangle(double x, double y, double width, double height, const std::string& fill);

}  // namespace sinew
