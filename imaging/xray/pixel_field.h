#pragma once
#include <cstdint>
#include <vector>

namespace sinew {

/// One float a pixel, row by row from the top left; the width is the caller's.
using PixelField = std::vector<float>;

/// Gaussian of standard deviations `sigma_u_px`, `sigma_v_px`; the border pixels repeat outwards.
PixelField blurred(const PixelField& field, int width, double sigma_u_px, double sigma_v_px);

/// Gaussian with a standard deviation of many pixels: on a grid coarser by a quarter of it, then interpolated.
PixelField broadlyBlurred(const PixelField& field, int width, double sigma_px);

/// Random field of mean 0 and standard deviation 1 whose grains measure about the given standard deviations.
PixelField grain(int width, int height, double sigma_u_px, double sigma_v_px, std::uint64_t seed);

}  // namespace sinew
