#include <algorithm>
#include <cmath>
#include <utility>

#include "core/retarget/length_curve.h"
#include "core/retarget/peak_target_internal.h"

namespace sinew {
namespace {

constexpr int kSteps = TorqueGeometry::kSamples - 1;

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
                       const MotionTorques::Samples& first_Nm)
    : motion_{motion},
      wanted_theta_{wanted_theta},
      span_deg_{std::abs(what.end_deg - what.start_deg)},
      scale_Nm_{first_Nm.maxCoeff()} {}

double PeakTarget::off(const MotionTorques::Samples& torque_Nm) const {
  const double theta = peakTheta(torque_Nm);
  return std::isnan(theta) ? 1 : theta - wanted_theta_;
}

void PeakTarget::setTolerance(double tolerance_deg) {
  const double wanted = wanted_theta_ * kSteps, tolerance = tolerance_deg * kSteps / span_deg_;
  alternatives_ = peakAlternatives(wanted - tolerance, wanted + tolerance);
}

TorqueResiduals PeakTarget::violations(const MotionTorques::Samples& torque_Nm) const {
  TorqueResiduals best, found;
  for (const auto& alternative : alternatives_) {
    found.clear();
    for (const TorqueCondition& c : alternative) {
      const double by = margin(c) - c.of(torque_Nm) / scale_Nm_;
      if (!(by > 0)) continue;
      found.push_back({by, c.sample, {}});
      for (std::size_t i = 0; i < 3; ++i) found.back().slope_1_Nm[i] = -c.weight[i] / scale_Nm_;
    }
    if (found.empty()) return {};
    if (best.empty() || energyOf(found) < energyOf(best)) std::swap(best, found);
  }
  return best;
}

TorqueResiduals PeakTarget::deviation(const MotionTorques::Samples& torque_Nm) const {
  const CurveExtremum peak = curveFeatures({torque_Nm.data(), TorqueGeometry::kSamples}).longest;
  return {{peak.theta - wanted_theta_,
           {peak.first_sample, peak.first_sample + 1, peak.first_sample + 2},
           peak.theta_slope}};
}

}  // namespace sinew
