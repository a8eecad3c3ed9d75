#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/job.h"
#include "imaging/radiograph/radiograph.h"

namespace sinew {

/// A round shadow found in a radiograph.
struct DetectedBead {
  Eigen::Vector2d uv_px;   ///< its centre, to a fraction of a pixel
  double diameter_px = 0;  ///< of the disc
  double contrast = 0;     ///< mean step against the surroundings, in stored grey values
  double sigma_px = 0.05;  ///< estimated error of the centre, one standard deviation
};

struct BeadDetectionOptions {
  double min_diameter_px = 4, max_diameter_px = 60;
  double min_contrast_to_noise = 6;  ///< step over the noise of the surroundings
};

/// Beads of a phantom image, strongest first. Dense is what displayPixels() shows bright; if fewer than 6 beads are
/// found, the opposite polarity is tried too (fluoroscopy stores dense dark).
/// Candidates: local maxima of a difference of Gaussians over scales, refined by iterated windowed centroid on the
/// background-free image. Rejected: elongated (letters, edges), one-sided or noisy surroundings, image border.
std::vector<DetectedBead> detectBeads(const Radiograph& image, const BeadDetectionOptions& options = {},
                                      const Job& job = {});

}  // namespace sinew
