#include "core/retarget/peak_torque.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/kernel/batch.h"
#include "core/muscle/hill.h"
#include "core/parallel.h"
#include "core/retarget/length_curve.h"
#include "core/retarget/ratio_force_internal.h"

namespace sinew {
namespace {

constexpr int kSamples = TorqueGeometry::kSamples;
constexpr double kStep_rad = 1e-4;  // of the differences that moment arms are taken from
constexpr double kRadians = std::numbers::pi / 180;

double thetaOf(int sample) {
  return double(sample) / (kSamples - 1);
}

double span_rad(const JointMotion& motion) {
  return std::abs(motion.end_deg - motion.start_deg) * kRadians;
}

}  // namespace

PoseTable motionPostures(const Skeleton& skeleton, const std::vector<JointMotion>& motions) {
  PoseTable table{motions.size() * kSamples * 3, static_cast<std::size_t>(skeleton.coordinateCount())};
  std::size_t pose = 0;
  for (const JointMotion& motion : motions)
    for (int s = 0; s < kSamples; ++s)
      for (const int side : {-1, 0, 1})
        table.set(pose++, motionPosture(skeleton, motion, thetaOf(s) + side * kStep_rad / span_rad(motion)));
  return table;
}

TorqueGeometry::TorqueGeometry(const Model& model, const PoseTable& postures,
                               const std::vector<std::vector<int>>& units_of, const std::vector<JointMotion>& motions)
    : TorqueGeometry{model, postures, units_of, motions, *this, {}} {}

TorqueGeometry::TorqueGeometry(const Model& model, const PoseTable& postures,
                               const std::vector<std::vector<int>>& units_of, const std::vector<JointMotion>& motions,
                               const TorqueGeometry& previous, const std::vector<bool>& unchanged) {
  const auto isUnchanged = [&](int unit) { return !unchanged.empty() && unchanged[static_cast<std::size_t>(unit)]; };
  Musculature measured;
  std::vector<std::size_t> column(model.musculature.units.size(), 0);
  for (std::size_t u = 0; u < column.size(); ++u)
    if (!isUnchanged(static_cast<int>(u))) {
      column[u] = measured.units.size();
      measured.units.push_back(model.musculature.units[u]);
    }
  PoseTable lengths_m;
  if (!measured.units.empty()) batchLengths(CompiledModel{model.skeleton, measured}, postures, lengths_m);
  for (std::size_t m = 0; m < motions.size(); ++m) {
    auto& units = units_.emplace_back();
    for (const int unit : units_of[m]) {
      if (isUnchanged(unit)) {
        const auto known = std::ranges::find(previous.units_[m], unit, &UnitInMotion::unit);
        if (known != previous.units_[m].end()) units.push_back(*known);
        continue;
      }
      UnitInMotion swept{unit, {}, {}};
      for (int s = 0; s < kSamples; ++s) {
        const std::size_t pose = (m * kSamples + static_cast<std::size_t>(s)) * 3;
        const auto at = [&](std::size_t side) {
          return lengths_m(pose + side, column[static_cast<std::size_t>(unit)]);
        };
        swept.length_m.push_back(at(1));
        // A unit that shortens along the motion turns its way.
        swept.arm_m.push_back(std::max(0.0, (at(0) - at(2)) / (2 * kStep_rad)));
      }
      if (std::ranges::any_of(swept.arm_m, [](double r) { return r > 0; })) units.push_back(std::move(swept));
    }
  }
}

std::vector<double> motionTorque_Nm(const Musculature& musculature, const TorqueGeometry& geometry,
                                    std::size_t motion) {
  std::vector<double> torque_Nm(kSamples, 0.0);
  for (const auto& swept : geometry.unitsOf(motion))
    for (std::size_t s = 0; s < torque_Nm.size(); ++s)
      if (swept.arm_m[s] > 0)
        torque_Nm[s] +=
            swept.arm_m[s] *
            equilibrium(musculature.units[static_cast<std::size_t>(swept.unit)], swept.length_m[s], 1).active_force_N;
  return torque_Nm;
}

double peakTheta(const std::vector<double>& torque_Nm) {
  if (!(*std::ranges::max_element(torque_Nm) > 0)) return std::numeric_limits<double>::quiet_NaN();
  return curveFeatures(torque_Nm).longest.theta;
}

namespace {

/// All torques as functions of the ratios, with the conditions that make a wanted angle the greatest one.
class PeakProblem {
 public:
  PeakProblem(const TorqueGeometry& geometry, const std::vector<JointMotion>& motions,
              const std::vector<double>& wanted_theta, const Musculature& musculature, double price)
      : geometry_{geometry}, motions_{motions}, wanted_theta_{wanted_theta}, price_{price} {
    for (const MusculotendonUnit& unit : musculature.units) forces_.emplace_back(unit);
    for (std::size_t m = 0; m < geometry.motionCount(); ++m)
      swept_.emplace_back().fibers.assign(geometry.unitsOf(m).size() * kSamples, 0.0);
    scale_Nm_.assign(swept_.size(), 0.0);
  }

  void setRatios(const Eigen::VectorXd& ratio) {
    for (std::size_t u = 0; u < forces_.size(); ++u) forces_[u].setFactor(ratio[static_cast<Eigen::Index>(u)]);
  }

  /// Torques of all motions; each is its own, whoever computes it.
  void evaluateAll() {
    forEachInParallel(swept_.size(), {}, "peak torque", [&](std::size_t m) { evaluate(m, swept_[m]); });
  }
  double peakTheta(std::size_t m) const {
    return sinew::peakTheta({swept_[m].torque.begin(), swept_[m].torque.end()});
  }

  /// Sum of squared conditions and the price of the ratios; with its Gauss-Newton expansion.
  double expand(const Eigen::VectorXd& ratio, Eigen::VectorXd& gradient, Eigen::MatrixXd& hessian) {
    const Eigen::VectorXd off = ratio.array() - 1;
    gradient = 2 * price_ * off;
    hessian = 2 * price_ * Eigen::MatrixXd::Identity(ratio.size(), ratio.size());
    double energy = price_ * off.squaredNorm();
    setRatios(ratio);
    evaluateAll();
    for (std::size_t m = 0; m < geometry_.motionCount(); ++m)
      if (!std::isnan(wanted_theta_[m])) energy += addMotion(m, gradient, hessian);
    return energy;
  }

 private:
  using Samples = Eigen::Matrix<double, kSamples, 1>;

  /// One motion: torque by sample, its slopes with the ratios of the motion's units, and the fibre lengths found.
  struct Swept {
    Samples torque;
    Eigen::MatrixXd slopes;
    std::vector<double> fibers;
  };

  void evaluate(std::size_t m, Swept& swept) const {
    const auto& units = geometry_.unitsOf(m);
    swept.torque.setZero();
    swept.slopes.setZero(kSamples, static_cast<Eigen::Index>(units.size()));
    for (std::size_t k = 0; k < units.size(); ++k) {
      double fiber = 0;  // of the sample before: where the first search of all starts
      for (int s = 0; s < kSamples; ++s) {
        const auto i = static_cast<std::size_t>(s);
        if (!(units[k].arm_m[i] > 0)) continue;
        double& start = swept.fibers[k * kSamples + i];
        if (start == 0) start = fiber;
        const CurveValue force = forces_[static_cast<std::size_t>(units[k].unit)].at(units[k].length_m[i], start);
        fiber = start;
        swept.torque[s] += units[k].arm_m[i] * force.value;
        swept.slopes(s, static_cast<Eigen::Index>(k)) = units[k].arm_m[i] * force.slope;
      }
    }
  }

  /// Adds the square of one condition of motion m, with its slopes by the motion's units.
  void addResidual(std::size_t m, double residual, const Eigen::RowVectorXd& by_unit, Eigen::VectorXd& gradient,
                   Eigen::MatrixXd& hessian) const {
    const auto& units = geometry_.unitsOf(m);
    for (std::size_t a = 0; a < units.size(); ++a) {
      const double slope_a = by_unit[static_cast<Eigen::Index>(a)];
      gradient[units[a].unit] += 2 * residual * slope_a;
      for (std::size_t b = 0; b < units.size(); ++b)
        hessian(units[a].unit, units[b].unit) += 2 * slope_a * by_unit[static_cast<Eigen::Index>(b)];
    }
  }

  /// The peak lies within kTolerance_deg of the wanted angle if torque rises up to that much before it and falls from
  /// that much behind it (at an end: on the one side there is), and no sample farther off is higher. These are
  /// inequalities linear in the torques: where they hold nothing is left to do, but for a small price of the slope at
  /// the angle itself. Torques count relative to the highest at first; slopes by theta.
  double addMotion(std::size_t m, Eigen::VectorXd& gradient, Eigen::MatrixXd& hessian) {
    constexpr double kTolerance_deg = 1.5, kExact = 0.1;
    constexpr double kMargin = 0.003, kMarginSamples = 4;  // by which others stay below, in full that far off
    const auto& [torque, slopes, fibers] = swept_[m];
    if (!(scale_Nm_[m] > 0)) scale_Nm_[m] = torque.maxCoeff();
    if (!(scale_Nm_[m] > 0)) return 0;
    const double wanted = wanted_theta_[m] * (kSamples - 1);  // in samples, as all places below
    const double tolerance = kTolerance_deg * kRadians / span_rad(motions_[m]) * (kSamples - 1);
    const int middle = std::clamp(static_cast<int>(std::lround(wanted)), 1, kSamples - 2);
    const auto around = torque.segment<3>(middle - 1);
    const auto slopes_around = slopes.middleRows<3>(middle - 1);
    double energy = 0;
    const auto add = [&](double residual, const Eigen::RowVectorXd& by_unit) {
      energy += residual * residual;
      addResidual(m, residual, by_unit, gradient, hessian);
    };
    // `wrong`: the sign that the slope of the parabola at a place must not have; 0: it should vanish.
    const auto addSlope = [&](double place, double weight, int wrong) {
      const double t = place - middle;
      const Eigen::Vector3d by_sample =
          weight * (kSamples - 1) / scale_Nm_[m] * Eigen::Vector3d{t - 0.5, -2 * t, t + 0.5};
      const double rise = by_sample.dot(around);
      if (wrong == 0 || rise * wrong > 0) add(rise, by_sample.transpose() * slopes_around);
    };
    const bool from_start = wanted_theta_[m] <= 0, to_end = wanted_theta_[m] >= 1;
    if (!from_start) addSlope(wanted - tolerance, 1, -1);
    if (!to_end) addSlope(wanted + tolerance, 1, 1);
    addSlope(wanted, kExact, from_start ? 1 : to_end ? -1 : 0);

    const double t = wanted - middle;
    const Eigen::Vector3d value{0.5 * t * (t - 1), 1 - t * t, 0.5 * t * (t + 1)};
    const double at_wanted = value.dot(around);
    const Eigen::RowVectorXd at_wanted_slopes = value.transpose() * slopes_around;
    for (int s = 0; s < kSamples; ++s) {
      const double off = std::abs(s - wanted);
      if (off <= 1 + tolerance) continue;
      const double margin = kMargin * std::min(1.0, off / kMarginSamples);
      const double excess = (torque[s] - at_wanted) / scale_Nm_[m] + margin;
      if (excess > 0) add(excess, (slopes.row(s) - at_wanted_slopes) / scale_Nm_[m]);
    }
    return energy;
  }

  const TorqueGeometry& geometry_;
  const std::vector<JointMotion>& motions_;
  const std::vector<double>& wanted_theta_;
  double price_;
  std::vector<double> scale_Nm_;  ///< by motion: greatest torque at first
  std::vector<RatioForce> forces_;
  std::vector<Swept> swept_;  ///< by motion
};

/// Newton step within bounds: variables that would leave stay at their bound while the others are solved again.
Eigen::VectorXd boundedStep(const Eigen::VectorXd& x, const Eigen::VectorXd& gradient, const Eigen::MatrixXd& hessian,
                            double low, double high) {
  std::vector<int> free;
  for (int i = 0; i < x.size(); ++i)
    if (!((x[i] <= low && gradient[i] > 0) || (x[i] >= high && gradient[i] < 0))) free.push_back(i);
  Eigen::VectorXd target = x;
  while (!free.empty()) {
    const Eigen::MatrixXd H = hessian(free, free);
    // What is already held at a bound moved by a known amount.
    Eigen::VectorXd g = gradient(free) + hessian(free, Eigen::all) * (target - x);
    g -= H * (target - x)(free);
    const Eigen::VectorXd step = -H.llt().solve(g);
    std::vector<int> inside;
    for (std::size_t k = 0; k < free.size(); ++k) {
      const int i = free[k];
      target[i] = x[i] + step[static_cast<Eigen::Index>(k)];
      if (target[i] >= low && target[i] <= high)
        inside.push_back(i);
      else
        target[i] = std::clamp(target[i], low, high);
    }
    if (inside.size() == free.size()) break;
    free = inside;
    for (const int i : free) target[i] = x[i];
  }
  return target;
}

}  // namespace

PeakTorqueResult optimizePeakTorque(const TorqueGeometry& geometry, const std::vector<JointMotion>& motions,
                                    const std::vector<double>& wanted_theta, Musculature& musculature,
                                    const PeakTorqueOptions& options, const Job& job) {
  PeakTorqueResult result;
  PeakProblem problem{geometry, motions, wanted_theta, musculature, options.ratio_price};
  problem.evaluateAll();
  const auto angle_deg = [&](std::size_t m, double theta) { return motions[m].angle_deg(theta); };
  for (std::size_t m = 0; m < motions.size(); ++m)
    result.angles.push_back({motions[m].name, angle_deg(m, wanted_theta[m]), angle_deg(m, problem.peakTheta(m))});

  const double low = 1 - options.largest_change, high = 1 + options.largest_change;
  Eigen::VectorXd ratio = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(musculature.units.size()));
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
  double energy = problem.expand(ratio, gradient, hessian), damping = 1e-3;
  // A body whose angles are right already - the reference itself - needs nothing.
  constexpr double kRight_deg = 0.01;
  const bool all_right = std::ranges::none_of(result.angles, [](const PeakTorqueAngle& angle) {
    return std::abs(angle.before_deg - angle.reference_deg) > kRight_deg;
  });
  const int most_iterations = all_right ? 0 : options.most_iterations;
  while (result.iterations < most_iterations) {
    if (job.cancelled()) return {.outcome = Outcome::Cancelled};
    job.report(double(result.iterations) / options.most_iterations, "peak torque");
    ++result.iterations;
    Eigen::MatrixXd damped = hessian;
    damped.diagonal() *= 1 + damping;
    const Eigen::VectorXd next = boundedStep(ratio, gradient, damped, low, high);
    Eigen::VectorXd next_gradient;
    Eigen::MatrixXd next_hessian;
    const double next_energy = problem.expand(next, next_gradient, next_hessian);
    if (next_energy < energy) {
      const bool settled = energy - next_energy < 1e-3 * energy;
      ratio = next, energy = next_energy;
      gradient.swap(next_gradient), hessian.swap(next_hessian);
      damping = std::max(1e-6, damping * 0.3);
      if (settled) break;
    } else if ((damping *= 10) > 1e6) {
      break;
    }
  }
  for (std::size_t u = 0; u < musculature.units.size(); ++u)
    setFiberTendonRatio(musculature.units[u], ratio[static_cast<Eigen::Index>(u)]);
  problem.setRatios(ratio);
  problem.evaluateAll();
  for (std::size_t m = 0; m < motions.size(); ++m) result.angles[m].after_deg = angle_deg(m, problem.peakTheta(m));
  result.ratio.assign(ratio.begin(), ratio.end());
  result.outcome = Outcome::Converged;
  return result;
}

}  // namespace sinew
