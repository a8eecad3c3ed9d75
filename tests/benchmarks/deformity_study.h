#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/geometry/view.h"
#include "tests/benchmarks/deformities.h"

namespace sinew {

/// One figure of the deformed side (or of the midline) over all draws of one deformity of one amount.
struct DeformityRow {
  std::string quantity, unit;
  int determined = 0, undetermined = 0;
  int triangulated = 0;     ///< of the determined ones: taken from the picks
  double bias = 0, sd = 0;  ///< of estimate minus truth, over the determined ones
  double half_width95 = 0;  ///< mean
  double coverage = 0;      ///< share of the determined ones whose interval holds the truth
};

struct DeformityStudy {
  std::string deformity;
  double amount = 0;
  std::string unit;
  int draws = 0, not_converged = 0;
  int outside = 0;   ///< draws with a bone said to be outside the model
  int left_out = 0;  ///< picks left out as gross errors, all draws together; all picks are true
  double median_ms = 0;
  std::vector<DeformityRow> rows;
};

/// Bodies and postures drawn from the population without deformities, one bone deformed (alternately right and left
/// unless both are), the picking protocol's landmarks projected with noise, fitted, compared with the figures of the
/// deformed landmarks. Deterministic.
DeformityStudy studyDeformity(const std::filesystem::path& resource_dir, const std::vector<View>& views,
                              const Deformity& deformity, double amount, double noise_mm, int draws);

}  // namespace sinew
