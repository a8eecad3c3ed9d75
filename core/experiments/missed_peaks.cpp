#include "core/experiments/missed_peaks.h"

#include <algorithm>
#include <cmath>

#include "core/experiments/characters.h"
#include "core/retarget/ratio_force_internal.h"

namespace sinew {

std::vector<std::optional<PeakReach>> missedPeaks(const RetargetReference& reference, const Retargeted& body) {
  Musculature before = body.model.musculature;
  for (std::size_t u = 0; u < before.units.size(); ++u)
    setFiberTendonRatio(before.units[u], 1 / body.fiber_tendon_ratio[u]);
  std::vector<std::optional<PeakReach>> missed;
  for (std::size_t m = 0; m < body.peak_torque.size(); ++m) {
    const PeakTorqueAngle& a = body.peak_torque[m];
    const bool is_off =
        std::isfinite(a.reference_deg) && !(std::abs(a.after_deg - a.reference_deg) <= kPeakTorqueTarget_deg);
    missed.push_back(is_off ? std::optional{peakReach(*body.torque_geometry, m, reference.motions()[m],
                                                      reference.peakThetas()[m], before)}
                            : std::nullopt);
  }
  return missed;
}

PeakCount& PeakCount::operator+=(const PeakCount& other) {
  motions += other.motions, before += other.before, after += other.after, left += other.left;
  out_of_reach += other.out_of_reach, undecided += other.undecided;
  worst_before_deg = std::max(worst_before_deg, other.worst_before_deg);
  worst_after_deg = std::max(worst_after_deg, other.worst_after_deg);
  return *this;
}

PeakCount peakCount(const std::vector<PeakTorqueAngle>& angles, const std::vector<std::optional<PeakReach>>& missed) {
  const PeakTorqueTotals t = peakTorqueTotals(angles);
  PeakCount count{.motions = t.motions,
                  .before = t.within_before,
                  .after = t.within_after,
                  .out_of_reach = static_cast<int>(std::ranges::count(missed, PeakReach::Out)),
                  .undecided = static_cast<int>(std::ranges::count(missed, PeakReach::Undecided)),
                  .worst_before_deg = t.worst_before_deg,
                  .worst_after_deg = t.worst_after_deg};
  for (std::size_t m = 0; m < angles.size(); ++m)
    count.left += missed[m] && std::abs(angles[m].before_deg - angles[m].reference_deg) <= kPeakTorqueTarget_deg;
  return count;
}

PeakCounts peakCounts(const RetargetReference& reference, const std::vector<ShapeParameters>& shapes,
                      const Job& job) {
  PeakCounts result;
  int done = 0;
  for (const ShapeParameters& shape : shapes) {
    job.report(double(done++) / double(shapes.size()), "peak torque of random bodies");
    const Retargeted body = retarget(reference, shape, {}, {.stop = job.stop});
    if (body.outcome != Outcome::Converged) return {.outcome = body.outcome};
    result.count += peakCount(body.peak_torque, missedPeaks(reference, body));
  }
  result.outcome = Outcome::Converged;
  return result;
}

}  // namespace sinew
