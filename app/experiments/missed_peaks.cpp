#include "app/experiments/missed_peaks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/experiments/characters.h"
#include "core/retarget/peaks/ratio_force_internal.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/retarget.h"

namespace sinew {

namespace {

bool isWithin(double angle_deg, const PeakTorqueAngle& a) {
  return std::abs(angle_deg - a.reference_deg) <= kPeakTorqueTarget_deg;
}
bool isWithin(const PeakTorqueAngle& a) {
  return isWithin(a.after_deg, a);
}

/// A motion that is within and shares units, and that no ratios bring there together with the missed one.
std::optional<std::size_t> insteadOf(const RetargetReference& reference, const Retargeted& body,
                                     const Musculature& before, std::size_t missed) {
  constexpr PeakReachOptions kOptions{.ratios = 61, .most_rounds = 4000};  // steps of 1 %
  const TorqueGeometry& geometry = *body.torque_geometry;
  const auto wish = [&](std::size_t m) { return PeakWish{m, reference.motions()[m], reference.peakThetas()[m]}; };
  for (std::size_t m = 0; m < geometry.motionCount(); ++m) {
    if (m == missed || !isWithin(body.peak_torque[m])) continue;
    const bool shares = std::ranges::any_of(geometry.unitsOf(m), [&](const auto& unit) {
      return std::ranges::count(geometry.unitsOf(missed), unit.unit, &TorqueGeometry::UnitInMotion::unit) > 0;
    });
    const std::array both{wish(missed), wish(m)};
    if (shares && peakReach(geometry, both, before, kOptions) == PeakReach::Out) return m;
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::optional<MissedPeak>> missedPeaks(const RetargetReference& reference, const Retargeted& body) {
  Musculature before = body.model.musculature;
  for (std::size_t u = 0; u < before.units.size(); ++u)
    setFiberTendonRatio(before.units[u], 1 / body.fiber_tendon_ratio[u]);
  std::vector<std::optional<MissedPeak>> missed;
  for (std::size_t m = 0; m < body.peak_torque.size(); ++m) {
    auto& peak = missed.emplace_back();
    if (!std::isfinite(body.peak_torque[m].reference_deg) || isWithin(body.peak_torque[m])) continue;
    peak.emplace();
    peak->alone = peakReach(*body.torque_geometry, m, reference.motions()[m], reference.peakThetas()[m], before);
    if (peak->alone == PeakReach::Within) peak->instead_of = insteadOf(reference, body, before, m);
  }
  return missed;
}

PeakCount& PeakCount::operator+=(const PeakCount& other) {
  motions += other.motions, before += other.before, after += other.after, left += other.left;
  out_of_reach += other.out_of_reach, undecided += other.undecided, instead += other.instead;
  worst_before_deg = std::max(worst_before_deg, other.worst_before_deg);
  worst_after_deg = std::max(worst_after_deg, other.worst_after_deg);
  return *this;
}

PeakCount peakCount(const std::vector<PeakTorqueAngle>& angles,
                    const std::vector<std::optional<MissedPeak>>& missed) {
  const PeakTorqueTotals t = peakTorqueTotals(angles);
  PeakCount count{.motions = t.motions,
                  .before = t.within_before,
                  .after = t.within_after,
                  .worst_before_deg = t.worst_before_deg,
                  .worst_after_deg = t.worst_after_deg};
  for (std::size_t m = 0; m < angles.size(); ++m) {
    if (!missed[m]) continue;
    count.left += isWithin(angles[m].before_deg, angles[m]);
    count.out_of_reach += missed[m]->alone == PeakReach::Out;
    count.undecided += missed[m]->alone == PeakReach::Undecided;
    count.instead += missed[m]->instead_of.has_value();
  }
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
