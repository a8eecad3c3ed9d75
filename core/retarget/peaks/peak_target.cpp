#include <algorithm>
#include <cmath>
#include <limits>

#include "core/retarget/peaks/peak_target_internal.h"
#include "core/retarget/prepared/length_curve.h"

namespace sinew {
namespace {

/// By how much a condition has to hold: samples far from the highest stay a little below it.
double margin(const TorqueCondition& c) {
  constexpr double kMargin = 1e-3, kFar = 4;  // in full that many samples off
  return c.isSlope() ? 0 : kMargin * std::min(1.0, std::abs(c.sample[1] - c.sample[0]) / kFar);
}

}  // namespace

double energyOf(const TorqueResiduals& residuals) {
  double sum = 0;
  for (const TorqueResidual& r : residuals) sum += r.value * r.value;
  return sum;
}

PeakTarget::PeakTarget(std::size_t motion, const JointMotion& what, double wanted_theta,
                       const Eigen::Ref<const MotionTorques::Samples>& first_Nm)
    : motion_{motion},
      wanted_theta_{wanted_theta},
      span_deg_{std::abs(what.end_deg - what.start_deg)},
      scale_Nm_{first_Nm.maxCoeff()} {}

double PeakTarget::off(const Eigen::Ref<const MotionTorques::Samples>& torque_Nm) const {
  const double theta = peakTheta(torque_Nm);
  return std::isnan(theta) ? 1 : theta - wanted_theta_;
}

void PeakTarget::setTolerance(double tolerance_deg) {
  alternatives_.clear();
  for (const auto& conditions : peakAlternatives(wanted_theta_, tolerance_deg, span_deg_)) {
    auto& alternative = alternatives_.emplace_back();
    for (const TorqueCondition& c : conditions) alternative.push_back({c, margin(c)});
  }
}

TorqueResiduals PeakTarget::violations(const Eigen::Ref<const MotionTorques::Samples>& torque_Nm) const {
  const double scale_1_Nm = 1 / scale_Nm_;
  const auto lack = [&](const Wanted& w) { return std::max(0.0, w.by - scale_1_Nm * w.condition.of(torque_Nm)); };
  const std::vector<Wanted>* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& alternative : alternatives_) {
    double sum = 0;
    for (auto w = alternative.begin(); w != alternative.end() && sum < least; ++w) sum += lack(*w) * lack(*w);
    if (!(sum < least)) continue;
    least = sum;
    best = &alternative;
    if (least == 0) return {};
  }
  TorqueResiduals found;
  if (!best) return found;
  for (const Wanted& w : *best) {
    const double by = lack(w);
    if (!(by > 0)) continue;
    found.push_back({by, w.condition.sample, {}});
    for (std::size_t i = 0; i < 3; ++i) found.back().slope_1_Nm[i] = -scale_1_Nm * w.condition.weight[i];
  }
  return found;
}

TorqueResiduals PeakTarget::deviation(const Eigen::Ref<const MotionTorques::Samples>& torque_Nm) const {
  const CurveExtremum peak = curveFeatures({torque_Nm.data(), TorqueGeometry::kSamples}).longest;
  return {{peak.theta - wanted_theta_,
           {peak.first_sample, peak.first_sample + 1, peak.first_sample + 2},
           peak.theta_slope}};
}

}  // namespace sinew
