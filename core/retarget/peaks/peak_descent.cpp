#include <cmath>

#include "core/parallel.h"
#include "core/retarget/peaks/peak_result_internal.h"
#include "core/retarget/peaks/ratio_force_internal.h"
#include "core/retarget/routing/minimize_internal.h"

namespace sinew {
namespace {

/// The paper's energy of angles of peak torque.
class AngleEnergy {
 public:
  AngleEnergy(const TorqueGeometry& geometry, const std::vector<double>& wanted_theta, const Musculature& musculature)
      : geometry_{geometry},
        wanted_theta_{wanted_theta},
        parts_{partsByUnit(geometry, musculature.units.size())},
        torque_Nm_(geometry.motionCount()) {
    for (const MusculotendonUnit& unit : musculature.units) units_.push_back(withoutPath(unit));
    for (std::size_t m = 0; m < geometry.motionCount(); ++m) shares_Nm_.emplace_back(geometry.unitsOf(m).size());
  }

  double energy(const Eigen::VectorXd& ratio) {
    evaluate(ratio);
    double sum = 0;
    for (std::size_t m = 0; m < torque_Nm_.size(); ++m) sum += term(m, torque_Nm_[m]);
    return sum;
  }

  /// By forward differences; without what would lead out of the bounds.
  Eigen::VectorXd gradient(const Eigen::VectorXd& ratio, double low, double high) {
    constexpr double kStep = 1e-4;
    evaluate(ratio);
    const Eigen::VectorXd moved = ratio.array() + kStep;
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(ratio.size());
    forEachInParallel(units_.size(), {}, "peak torque", [&](std::size_t u) {
      const auto i = static_cast<Eigen::Index>(u);
      for (const UnitPart& part : parts_[u]) {
        const std::size_t m = part.motion;
        const auto share_Nm_now = share_Nm(part, moved);
        auto torque_Nm = torque_Nm_[m];
        for (std::size_t s = 0; s < torque_Nm.size(); ++s)
          torque_Nm[s] += share_Nm_now[s] - shares_Nm_[m][part.place][s];
        slope[i] += (term(m, torque_Nm) - term(m, torque_Nm_[m])) / kStep;
      }
      if ((ratio[i] <= low && slope[i] > 0) || (ratio[i] >= high && slope[i] < 0)) slope[i] = 0;
    });
    return slope;
  }

  std::vector<double> thetas(const Eigen::VectorXd& ratio) {
    evaluate(ratio);
    std::vector<double> thetas;
    for (const auto& torque_Nm : torque_Nm_) thetas.push_back(peakTheta(torque_Nm));
    return thetas;
  }

 private:
  void evaluate(const Eigen::VectorXd& ratio) {
    if (ratio_.size() > 0 && ratio == ratio_) return;
    ratio_ = ratio;
    forEachInParallel(torque_Nm_.size(), {}, "peak torque", [&](std::size_t m) {
      torque_Nm_[m].assign(TorqueGeometry::kSamples, 0.0);
      for (std::size_t k = 0; k < shares_Nm_[m].size(); ++k) {
        shares_Nm_[m][k] = share_Nm({m, k}, ratio);
        for (std::size_t s = 0; s < torque_Nm_[m].size(); ++s) torque_Nm_[m][s] += shares_Nm_[m][k][s];
      }
    });
  }

  std::vector<double> share_Nm(UnitPart part, const Eigen::VectorXd& ratio) const {
    const TorqueGeometry::UnitInMotion& swept = geometry_.unitsOf(part.motion)[part.place];
    MusculotendonUnit unit = units_[static_cast<std::size_t>(swept.unit)];
    setFiberTendonRatio(unit, ratio[swept.unit]);
    return unitTorque_Nm(unit, swept);
  }

  double term(std::size_t m, const std::vector<double>& torque_Nm) const {
    if (std::isnan(wanted_theta_[m])) return 0;
    const double theta = peakTheta(torque_Nm);
    return std::isnan(theta) ? 1 : std::pow(theta - wanted_theta_[m], 2);  // nothing turns: as wrong as can be
  }

  const TorqueGeometry& geometry_;
  const std::vector<double>& wanted_theta_;
  std::vector<std::vector<UnitPart>> parts_;
  std::vector<MusculotendonUnit> units_;  ///< at their original ratios
  // At the ratios evaluated last, by motion: torques, and the shares of its units.
  Eigen::VectorXd ratio_;
  std::vector<std::vector<double>> torque_Nm_;
  std::vector<std::vector<std::vector<double>>> shares_Nm_;
};

}  // namespace

PeakTorqueResult descendPeakTorque(const TorqueGeometry& geometry, const std::vector<JointMotion>& motions,
                                   const std::vector<double>& wanted_theta, Musculature& musculature,
                                   const PeakTorqueOptions& options, const Job& job) {
  constexpr double kFirstStep = 1e-2;  // of all ratios together
  AngleEnergy angles{geometry, wanted_theta, musculature};
  const double low = 1 - options.largest_change, high = 1 + options.largest_change;
  const Eigen::VectorXd start = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(musculature.units.size()));
  const std::vector<double> before = angles.thetas(start);
  const Minimum found =
      descent({[&](const Eigen::VectorXd& x) { return angles.energy(x); },
               [&](const Eigen::VectorXd& x, double) { return angles.gradient(x, low, high); }, low, high},
              start, {.most_iterations = options.most_iterations, .first_step = kFirstStep}, job.stop);
  if (job.cancelled()) return {.outcome = Outcome::Cancelled};
  setRatios(musculature, found.x);
  return peakTorqueResult(motions, wanted_theta, before, angles.thetas(found.x), found.x, found.iterations);
}

}  // namespace sinew
