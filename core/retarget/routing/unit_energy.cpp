#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/retarget/routing/unit_problem_internal.h"

// The energy of UnitProblem with its derivatives.

namespace sinew {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Trapezoidal rule over theta in [0, 1].
double integrationWeight(int sample) {
  const bool end = sample == 0 || sample == kRoutingSamples - 1;
  return (end ? 0.5 : 1.0) / (kRoutingSamples - 1);
}

}  // namespace

/// What the directions of one piece add up to, by the six unknowns of its ends.
struct UnitProblem::PieceSum {
  double energy = 0;
  Vector6 gradient = Vector6::Zero();
  Matrix6 hessian = Matrix6::Zero();
};

/// Direction of the piece from point a to b at one sample: |u x d|^2 with u the reference's. Its length joins sample
/// `length_of` (-1: it does not matter).
///
/// With n the distance, p = u - (u.d) d, q its direction and e = d x q: the residual |p| has the slope -(u.d) q / n
/// along b - a, and the other residual, across, is 0 with the slope e / n.
template <UnitProblem::Order kOrder>
void UnitProblem::addSample(const Eigen::VectorXd& x, std::size_t row, std::size_t piece, double weight,
                            int length_of, PieceSum& sum) const {
  const Place &from = places_[row * points_.size() + piece], &to = places_[row * points_.size() + piece + 1];
  const Eigen::Vector3d& u = reference_->directions[row * (points_.size() - 1) + piece];
  const auto a = static_cast<Eigen::Index>(3 * piece), b = a + 3;
  const Eigen::Vector3d x_a = x.segment<3>(a), x_b = x.segment<3>(b);
  const Eigen::Vector3d difference = (to.c + to.D * x_b) - (from.c + from.D * x_a);
  const double norm = std::max(difference.norm(), 1e-9);
  const Eigen::Vector3d d = difference / norm;
  if (length_of >= 0) lengths_[static_cast<std::size_t>(length_of)] += norm / zero_length_m_;
  if constexpr (kOrder == Order::Value) {
    sum.energy += weight * u.cross(d).squaredNorm();
  } else {
    const auto alongUnknowns = [&](const Eigen::Vector3d& v) {
      Vector6 slope;
      slope.head<3>().noalias() = from.D.transpose() * -v;
      slope.tail<3>().noalias() = to.D.transpose() * v;
      return slope;
    };
    if (length_of >= 0) length_slopes_.col(length_of).segment<6>(a) += alongUnknowns(d) / zero_length_m_;
    const double along = u.dot(d);
    const Eigen::Vector3d p = u - along * d;
    sum.energy += weight * p.squaredNorm();
    if constexpr (kOrder == Order::Gradient) {
      sum.gradient += alongUnknowns(-2 * weight * along / norm * p);
    } else {
      const double sine = p.norm();
      constexpr double kParallel = 1e-9;
      const Eigen::Vector3d q = sine > kParallel ? Eigen::Vector3d{p / sine} : d.unitOrthogonal();
      const Vector6 slope_q = alongUnknowns(along / norm * q), slope_e = alongUnknowns(d.cross(q) / norm);
      sum.gradient -= 2 * weight * sine * slope_q;
      sum.hessian.noalias() += (2 * weight * slope_q) * slope_q.transpose();
      sum.hessian.noalias() += (2 * weight * slope_e) * slope_e.transpose();
    }
  }
}

template <UnitProblem::Order kOrder>
double UnitProblem::collect(const PieceSum& sum, std::size_t piece, Expansion& e) {
  const auto a = static_cast<Eigen::Index>(3 * piece);
  if constexpr (kOrder != Order::Value) e.gradient.segment<6>(a) += sum.gradient;
  if constexpr (kOrder == Order::Hessian) e.hessian.block<6, 6>(a, a) += sum.hessian;
  return sum.energy;
}

/// E_length of one motion: theta_max, theta_min, Delta.
template <UnitProblem::Order kOrder>
double UnitProblem::addFeatures(std::size_t motion) const {
  const CurveFeatures& wanted = reference_->features[motion];
  const CurveFeatures found = curveFeatures(lengths_);
  const double significance = reference_->significance[motion];
  const double at_longest = found.longest.theta - wanted.longest.theta;
  const double at_shortest = found.shortest.theta - wanted.shortest.theta;
  const double range = found.range() - wanted.range();
  if (kOrder != Order::Value && changesLength(motion)) {
    const auto slopes = [&](const CurveExtremum& extremum) {
      return length_slopes_.middleCols<3>(extremum.first_sample);
    };
    const auto by = [](const std::array<double, 3>& slope) {
      return Eigen::Map<const Eigen::Vector3d>(slope.data());
    };
    const double theta_weight = std::sqrt(weights_.length * motion_weight_[motion] * significance);
    const double range_weight = std::sqrt(weights_.length * motion_weight_[motion] * weights_.range);
    if (theta_weight > 0) {
      addResidual(theta_weight * at_longest).noalias() =
          slopes(found.longest).lazyProduct(theta_weight * by(found.longest.theta_slope));
      addResidual(theta_weight * at_shortest).noalias() =
          slopes(found.shortest).lazyProduct(theta_weight * by(found.shortest.theta_slope));
    }
    auto slope = addResidual(range_weight * range);
    slope.noalias() = slopes(found.longest).lazyProduct(range_weight * by(found.longest.value_slope));
    slope.noalias() -= slopes(found.shortest).lazyProduct(range_weight * by(found.shortest.value_slope));
  }
  return motion_weight_[motion] *
         (significance * (at_longest * at_longest + at_shortest * at_shortest) + weights_.range * range * range);
}

/// The curve itself, its mean apart; in the expansion with the given weight.
template <UnitProblem::Order kOrder>
double UnitProblem::addCurve(std::size_t motion, double weight) const {
  using Samples = Eigen::Matrix<double, kRoutingSamples, 1>;
  Samples off = Eigen::Map<const Samples>(lengths_.data()) -
                Eigen::Map<const Samples>(&reference_->lengths[motion * kRoutingSamples]);
  off.array() -= off.mean();
  const double share = motion_weight_[motion] / kRoutingSamples;
  if (kOrder != Order::Value && changesLength(motion)) {
    const double scale = std::sqrt(weight * share);
    mean_slope_.noalias() = length_slopes_.rowwise().sum() * (scale / kRoutingSamples);
    for (int s = 0; s < kRoutingSamples; ++s)
      addResidual(scale * off[s]) = scale * length_slopes_.col(s) - mean_slope_;
  }
  return share * off.squaredNorm();
}

/// Steps from sample to sample that go against a step that matters in the reference, or have nearly vanished.
template <UnitProblem::Order kOrder>
double UnitProblem::addReversals(std::size_t motion) const {
  const double* wanted = &reference_->lengths[motion * kRoutingSamples];
  const double matters = kReversalShare * reference_->features[motion].range();
  const double range = reference_->features[motion].range();
  const double weight =
      range > 0 ? weights_.reversal * motion_weight_[motion] * reference_->significance[motion] / (range * range) : 0;
  constexpr double kLeastStep = 0.1;  // of the reference's: a price that sets in at 0 would be met just beyond it
  double energy = 0;
  for (int s = 0; s + 1 < kRoutingSamples; ++s) {
    const double step = wanted[s + 1] - wanted[s];
    if (std::abs(step) < matters) continue;
    const double sign = step > 0 ? 1 : -1;
    const double against =
        sign * (lengths_[static_cast<std::size_t>(s) + 1] - lengths_[static_cast<std::size_t>(s)]) -
        kLeastStep * std::abs(step);
    if (against >= 0) continue;
    energy += weight * against * against;
    if (kOrder != Order::Value && changesLength(motion)) {
      const double scale = std::sqrt(weight);
      addResidual(scale * against) = scale * sign * (length_slopes_.col(s + 1) - length_slopes_.col(s));
    }
  }
  return energy;
}

/// Room for the slope of one more residual.
Eigen::MatrixXd::ColXpr UnitProblem::addResidual(double residual) const {
  residuals_[residual_count_] = residual;
  return residual_slopes_.col(residual_count_++);
}

/// Gradient and Gauss-Newton matrix of the sum of their squares.
template <UnitProblem::Order kOrder>
void UnitProblem::addResiduals(Expansion& e) const {
  if constexpr (kOrder == Order::Value) return;
  const auto slopes = residual_slopes_.leftCols(residual_count_);
  e.gradient.noalias() += 2 * (slopes * residuals_.head(residual_count_));
  if constexpr (kOrder == Order::Hessian) e.hessian.selfadjointView<Eigen::Lower>().rankUpdate(slopes, 2);
}

/// Displacements, and moves into the bone that a point glides on; `slide`: what sliding costs besides.
template <UnitProblem::Order kOrder>
double UnitProblem::addPrices(const Eigen::VectorXd& x, Objective objective, Expansion& e, double& slide) const {
  double energy = 0;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const auto at = static_cast<Eigen::Index>(3 * p);
    const double price = points_[p].price_1_m2, inside = weights_.inside_1_m2;
    const double slide_price = points_[p].slides ? objective.slide_1_m2 : objective.via_1_m2;
    const Eigen::Matrix3d& basis = points_[p].basis_B;
    const Eigen::Vector3d step = x.segment<3>(at), moved = points_[p].moved_B + basis * step;
    const double far = moved.squaredNorm() / (weights_.far_m * weights_.far_m), far2 = far * far;
    energy += price * moved.squaredNorm() * (1 + far2);
    slide += slide_price * step.squaredNorm();
    const Eigen::Vector3d slope = points_[p].basis_W.transpose() * points_[p].outward_W;
    const double beyond = slope.isZero(0) ? 0 : std::min(0.0, slope.dot(step) + points_[p].slack_m);
    energy += inside * beyond * beyond;
    if constexpr (kOrder != Order::Value)
      e.gradient.segment<3>(at) +=
          2 * (price * (1 + 3 * far2) * (basis.transpose() * moved) + slide_price * step + inside * beyond * slope);
    if constexpr (kOrder == Order::Hessian) {
      const Eigen::Vector3d along = basis.transpose() * moved;
      e.hessian.block<3, 3>(at, at) += 2 * price * (1 + 3 * far2) * (basis.transpose() * basis);
      e.hessian.block<3, 3>(at, at) +=
          24 * price * far / (weights_.far_m * weights_.far_m) * (along * along.transpose());
      e.hessian.block<3, 3>(at, at).diagonal().array() += 2 * slide_price;
      if (beyond < 0) e.hessian.block<3, 3>(at, at) += 2 * inside * slope * slope.transpose();
    }
  }
  return energy;
}

/// A piece that shrinks to nothing has any direction it likes: neighbouring points keep their distance.
template <UnitProblem::Order kOrder>
double UnitProblem::addCrowding(const Eigen::VectorXd& x, Expansion& e) const {
  constexpr double kLeast = 0.25;  // of a piece's length
  double energy = 0;
  for (std::size_t p = 0; p + 1 < points_.size(); ++p) {
    const auto a = static_cast<Eigen::Index>(3 * p), b = a + 3;
    const Eigen::Vector3d piece =
        (zero_[p + 1].c + zero_[p + 1].D * x.segment<3>(b)) - (zero_[p].c + zero_[p].D * x.segment<3>(a));
    const double length_m = std::max(piece.norm(), 1e-9), lacking = length_m / lengths_m_[p] - kLeast;
    if (lengths_m_[p] < kLeastPiece_m || lacking >= 0) continue;
    energy += weights_.crowding * lacking * lacking;
    if constexpr (kOrder != Order::Value) {
      const Eigen::Vector3d direction = piece / (length_m * lengths_m_[p]);
      const Eigen::Vector3d slope_a = -zero_[p].D.transpose() * direction,
                            slope_b = zero_[p + 1].D.transpose() * direction;
      e.gradient.segment<3>(a) += 2 * weights_.crowding * lacking * slope_a;
      e.gradient.segment<3>(b) += 2 * weights_.crowding * lacking * slope_b;
      if constexpr (kOrder == Order::Hessian) {
        e.hessian.block<3, 3>(a, a) += 2 * weights_.crowding * slope_a * slope_a.transpose();
        e.hessian.block<3, 3>(b, b) += 2 * weights_.crowding * slope_b * slope_b.transpose();
        e.hessian.block<3, 3>(b, a) += 2 * weights_.crowding * slope_b * slope_a.transpose();
      }
    }
  }
  return energy;
}

template <UnitProblem::Order kOrder>
double UnitProblem::evaluate(const Eigen::VectorXd& x, Objective objective, RoutingEnergy& parts,
                             Expansion& e) const {
  if constexpr (kOrder != Order::Value) e.gradient.setZero(unknowns());
  if constexpr (kOrder == Order::Hessian) e.hessian.setZero(unknowns(), unknowns());
  residual_count_ = 0;
  parts = {};
  const double curve_weight = weights_.length * weights_.range * weights_.curve;
  for (const RigidPiece& rigid : rigid_) {
    PieceSum sum;
    addSample<kOrder>(x, rigid.motion * kRoutingSamples, rigid.piece, rigid.weight, -1, sum);
    parts.direction += collect<kOrder>(sum, rigid.piece, e);
  }
  for (std::size_t m = 0; m < motion_weight_.size(); ++m) {
    std::ranges::fill(lengths_, 0.0);
    if (kOrder != Order::Value && changesLength(m)) length_slopes_.setZero();
    for (const MovingPiece& moving : moving_[m]) {
      PieceSum sum;
      for (int s = 0; s < kRoutingSamples; ++s)
        addSample<kOrder>(x, m * kRoutingSamples + static_cast<std::size_t>(s), moving.piece,
                          motion_weight_[m] * integrationWeight(s), moving.changes_length ? s : -1, sum);
      parts.direction += collect<kOrder>(sum, moving.piece, e);
    }
    parts.length += addFeatures<kOrder>(m);
    parts.curve += addCurve<kOrder>(m, curve_weight);
    parts.reversal += addReversals<kOrder>(m);
  }
  addResiduals<kOrder>(e);
  double slide = 0;
  parts.displacement = addPrices<kOrder>(x, objective, e, slide) + addCrowding<kOrder>(x, e);
  return e.energy = parts.total(weights_) + slide + addWatched(x, kOrder, e);
}

RoutingEnergy UnitProblem::parts(const Eigen::VectorXd& x) const {
  RoutingEnergy parts;
  Expansion unused;
  evaluate<Order::Value>(x, {}, parts, unused);
  return parts;
}

double UnitProblem::energy(const Eigen::VectorXd& x, Objective objective) const {
  RoutingEnergy unused;
  Expansion e;
  return evaluate<Order::Value>(x, objective, unused, e);
}

double UnitProblem::energy(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) const {
  RoutingEnergy unused;
  Expansion e;
  e.gradient.swap(gradient);
  evaluate<Order::Gradient>(x, {}, unused, e);
  e.gradient.swap(gradient);
  return e.energy;
}

void UnitProblem::expand(const Eigen::VectorXd& x, Objective objective, Expansion& expansion) const {
  RoutingEnergy unused;
  evaluate<Order::Hessian>(x, objective, unused, expansion);
}

}  // namespace sinew
