#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/geometry/view.h"

namespace sinew {

/// One line of the accuracy table: errors of a figure over all drawn bodies, both sides together.
struct AccuracyRow {
  std::string quantity, unit;
  int determined = 0, undetermined = 0;  ///< undetermined figures are counted, not judged
  double bias = 0, sd = 0, max = 0;      ///< of estimate minus truth; max of its absolute value
  double half_width95 = 0;               ///< mean half width of the stated interval
  double coverage = 0;                   ///< share of the intervals that hold the truth
};

struct AccuracyStudy {
  std::vector<AccuracyRow> rows;
  int bodies = 0, not_converged = 0;
  double median_ms = 0;  ///< processor time of one fit

  const AccuracyRow& row(const std::string& quantity) const;
};

/// Draws `seeds` bodies and standing postures from the population, projects the landmarks of the picking protocol
/// into `views` with Gaussian noise of `noise_mm` in the plane of the body, fits, and compares every figure with the
/// truth. Deterministic: body and noise depend on the seed alone, whatever the number of threads.
AccuracyStudy studyAccuracy(const std::filesystem::path& resource_dir, const std::vector<View>& views,
                            double noise_mm, int seeds);

}  // namespace sinew
