#pragma once
#include <string>
#include <vector>

#include "clinical/exam/examiner.h"

namespace sinew {

// What examinations make of a body, over many of them: figures of docs/validation.md.

/// The factor of the group that a test is a test of, over the angle that is measured in it alone.
struct FactorCurve {
  std::string test, group;
  std::vector<double> measured_deg, factor;  ///< as written, rising
  double largest_slope_per_deg = 0;          ///< between neighbours, absolute
  double largest_step_back = 0;              ///< against the direction of the whole curve; 0 = monotone
};
/// Every test of the form that changes lengths, over what the form accepts, right side. `step_deg` apart.
std::vector<FactorCurve> factorCurves(const Examiner& examiner, bool leave_in_norm, double step_deg);

/// Random plausible examinations: right side, every test with probability 1/2, uniform between the form's doubt
/// limits.
struct RandomExams {
  int exams = 0, tests = 0;                          ///< measured tests that change lengths
  int off = 0;                                       ///< residual above kNamedResidual_deg
  int unnamed = 0;                                   ///< of those without a reason
  int not_solved = 0;                                ///< examinations
  std::vector<std::pair<std::string, int>> reasons;  ///< first words of the reasons, most frequent first
};
RandomExams randomExams(const Examiner& examiner, bool leave_in_norm, int exams, unsigned seed);

}  // namespace sinew
