#pragma once
#include <cstdint>
#include <vector>

namespace sinew {

/// A picture in memory: 8-bit RGB, row by row from the top left.
struct RgbImage {
  int width_px = 0, height_px = 0;
  std::vector<std::uint8_t> rgb;

  const std::uint8_t* at(int u, int v) const {
    return &rgb[3 * (std::size_t(v) * std::size_t(width_px) + std::size_t(u))];
  }
};

}  // namespace sinew
