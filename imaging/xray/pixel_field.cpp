#include "imaging/xray/pixel_field.h"

#include <algorithm>
#include <cmath>

#include "core/parallel_rows.h"
#include "core/random_source.h"

namespace sinew {
namespace {

/// Half of a normalised Gaussian, from its centre outwards.
std::vector<float> halfKernel(double sigma_px) {
  std::vector<float> half;
  double sum = 0;
  for (int i = 0; i <= int(std::ceil(3.5 * sigma_px)); ++i) {
    half.push_back(float(std::exp(-0.5 * i * i / (sigma_px * sigma_px))));
    sum += (i ? 2 : 1) * double(half.back());
  }
  for (float& k : half) k = float(k / sum);
  return half;
}

PixelField blurredAlongRows(const PixelField& in, int width, const std::vector<float>& half) {
  PixelField out(in.size());
  const int reach = int(half.size()) - 1;
  forEachRowBand(int(in.size()) / width, [&](RowRange rows) {
    std::vector<float> padded(std::size_t(width + 2 * reach));
    for (int v = rows.begin; v < rows.end; ++v) {
      const float* row = in.data() + std::ptrdiff_t(v) * width;
      std::fill_n(padded.begin(), reach, row[0]);
      std::copy_n(row, width, padded.begin() + reach);
      std::fill_n(padded.end() - reach, reach, row[width - 1]);
      float* target = out.data() + std::ptrdiff_t(v) * width;
      for (int u = 0; u < width; ++u) target[u] = half[0] * padded[std::size_t(u + reach)];
      for (int k = 1; k <= reach; ++k)
        for (int u = 0; u < width; ++u)
          target[u] +=
              half[std::size_t(k)] * (padded[std::size_t(u + reach - k)] + padded[std::size_t(u + reach + k)]);
    }
  });
  return out;
}

PixelField blurredAlongColumns(const PixelField& in, int width, const std::vector<float>& half) {
  PixelField out(in.size());
  const int height = int(in.size()) / width, reach = int(half.size()) - 1;
  forEachRowBand(height, [&](RowRange rows) {
    for (int v = rows.begin; v < rows.end; ++v) {
      float* target = out.data() + std::ptrdiff_t(v) * width;
      for (int k = -reach; k <= reach; ++k) {
        const float* row = in.data() + std::ptrdiff_t(std::clamp(v + k, 0, height - 1)) * width;
        const float weight = half[std::size_t(std::abs(k))];
        for (int u = 0; u < width; ++u) target[u] += weight * row[u];
      }
    }
  });
  return out;
}

/// Means of blocks of `step` x `step` pixels.
PixelField reduced(const PixelField& in, int width, int step, int& reduced_width) {
  const int height = int(in.size()) / width;
  reduced_width = (width + step - 1) / step;
  const int reduced_height = (height + step - 1) / step;
  PixelField out(std::size_t(reduced_width) * std::size_t(reduced_height));
  for (int v = 0; v < reduced_height; ++v)
    for (int u = 0; u < reduced_width; ++u) {
      double sum = 0;
      int count = 0;
      for (int y = v * step; y < std::min(height, (v + 1) * step); ++y)
        for (int x = u * step; x < std::min(width, (u + 1) * step); ++x, ++count)
          sum += in[std::size_t(y) * std::size_t(width) + std::size_t(x)];
      out[std::size_t(v) * std::size_t(reduced_width) + std::size_t(u)] = float(sum / count);
    }
  return out;
}

/// Grid step at which a Gaussian is still well sampled.
int coarseStep(double sigma_px) {
  return std::max(1, int(sigma_px / 4));
}

/// Bilinear interpolation from the means of blocks back to pixels.
PixelField enlarged(const PixelField& coarse, int coarse_width, int step, int width, int height) {
  const int coarse_height = int(coarse.size()) / coarse_width;
  PixelField out(std::size_t(width) * std::size_t(height));
  forEachRowBand(height, [&](RowRange rows) {
    for (int v = rows.begin; v < rows.end; ++v) {
      const double y = std::clamp((v + 0.5) / step - 0.5, 0.0, coarse_height - 1.0);
      const int y0 = std::min(int(y), std::max(coarse_height - 2, 0)), y1 = std::min(y0 + 1, coarse_height - 1);
      for (int u = 0; u < width; ++u) {
        const double x = std::clamp((u + 0.5) / step - 0.5, 0.0, coarse_width - 1.0);
        const int x0 = std::min(int(x), std::max(coarse_width - 2, 0)), x1 = std::min(x0 + 1, coarse_width - 1);
        const auto at = [&](int a, int b) {
          return double(coarse[std::size_t(b) * std::size_t(coarse_width) + std::size_t(a)]);
        };
        const double upper = at(x0, y0) + (x - x0) * (at(x1, y0) - at(x0, y0));
        const double lower = at(x0, y1) + (x - x0) * (at(x1, y1) - at(x0, y1));
        out[std::size_t(v) * std::size_t(width) + std::size_t(u)] = float(upper + (y - y0) * (lower - upper));
      }
    }
  });
  return out;
}

}  // namespace

PixelField blurred(const PixelField& field, int width, double sigma_u_px, double sigma_v_px) {
  PixelField out = sigma_u_px > 0.05 ? blurredAlongRows(field, width, halfKernel(sigma_u_px)) : field;
  return sigma_v_px > 0.05 ? blurredAlongColumns(out, width, halfKernel(sigma_v_px)) : out;
}

PixelField broadlyBlurred(const PixelField& field, int width, double sigma_px) {
  const int step = coarseStep(sigma_px), height = int(field.size()) / width;
  int coarse_width = 0;
  const PixelField small = reduced(field, width, step, coarse_width);
  return enlarged(blurred(small, coarse_width, sigma_px / step, sigma_px / step), coarse_width, step, width, height);
}

PixelField grain(int width, int height, double sigma_u_px, double sigma_v_px, std::uint64_t seed) {
  const int step = coarseStep(std::min(sigma_u_px, sigma_v_px));
  const int coarse_width = (width + step - 1) / step, coarse_height = (height + step - 1) / step;
  PixelField field(std::size_t(coarse_width) * std::size_t(coarse_height));
  forEachRowBand(coarse_height, [&](RowRange rows) {
    for (int v = rows.begin; v < rows.end; ++v) {
      RandomSource random{seed, std::uint64_t(v)};
      for (int u = 0; u < coarse_width; ++u)
        field[std::size_t(v) * std::size_t(coarse_width) + std::size_t(u)] = float(random.normal());
    }
  });
  field = blurred(field, coarse_width, sigma_u_px / step, sigma_v_px / step);
  double sum2 = 0;
  for (const float x : field) sum2 += double(x) * double(x);
  const float scale = float(1 / std::sqrt(sum2 / double(field.size())));
  for (float& x : field) x *= scale;
  return step == 1 ? field : enlarged(field, coarse_width, step, width, height);
}

}  // namespace sinew
