#include "core/retarget/peaks/peak_result_internal.h"
#include "core/retarget/peaks/ratio_force_internal.h"

namespace sinew {

void setRatios(Musculature& musculature, const Eigen::VectorXd& ratio) {
  for (std::size_t u = 0; u < musculature.units.size(); ++u)
    setFiberTendonRatio(musculature.units[u], ratio[static_cast<Eigen::Index>(u)]);
}

PeakTorqueResult peakTorqueResult(const std::vector<JointMotion>& motions, const std::vector<double>& wanted_theta,
                                  const std::vector<double>& before, const std::vector<double>& after,
                                  const Eigen::VectorXd& ratio, int iterations) {
  PeakTorqueResult result{.outcome = Outcome::Converged, .iterations = iterations};
  for (std::size_t m = 0; m < motions.size(); ++m)
    result.angles.push_back({motions[m].name, motions[m].angle_deg(wanted_theta[m]), motions[m].angle_deg(before[m]),
                             motions[m].angle_deg(after[m])});
  result.ratio.assign(ratio.begin(), ratio.end());
  return result;
}

}  // namespace sinew
