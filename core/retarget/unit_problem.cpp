#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/retarget/unit_problem_internal.h"

namespace sinew {
namespace {

/// Trapezoidal rule over theta in [0, 1].
double integrationWeight(int sample) {
  const bool end = sample == 0 || sample == kRoutingSamples - 1;
  return (end ? 0.5 : 1.0) / (kRoutingSamples - 1);
}

/// Adds r^2 of one residual r with slope `slope`.
template <bool kHessian>
void addResidual(double residual, const Eigen::VectorXd& slope, UnitProblem::Expansion& e) {
  e.gradient.noalias() += 2 * residual * slope;
  if constexpr (kHessian) e.hessian.selfadjointView<Eigen::Lower>().rankUpdate(slope, 2);
}

}  // namespace

UnitProblem::UnitProblem(const MusculotendonUnit& unit, const ReferenceCurves& reference,
                         const MotionPoses& reference_poses, const MotionPoses& poses,
                         const std::vector<Point>& points, double zero_length_m,
                         const std::vector<RoutingMotion>& motions, const RoutingWeights& weights)
    : reference_{&reference},
      poses_{&poses},
      weights_{weights},
      zero_length_m_{zero_length_m},
      lengths_(kRoutingSamples) {
  for (const int motion : reference.motions)
    motion_weight_.push_back(motions[static_cast<std::size_t>(motion)].weight);
  moveTo(unit, points);
  length_slopes_.resize(unknowns(), kRoutingSamples);
  sortPieces(unit, reference_poses);
}

void UnitProblem::moveTo(const MusculotendonUnit& unit, const std::vector<Point>& points) {
  points_ = points;
  places_.clear();
  places_.reserve(reference_->motions.size() * kRoutingSamples * points_.size());
  for (const int motion : reference_->motions)
    for (int s = 0; s < kRoutingSamples; ++s) {
      const auto& X_WB = poses_->at(motion, s);
      for (std::size_t p = 0; p < points_.size(); ++p) {
        Place& place = places_.emplace_back(Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero());
        for (const Anchor& anchor : unit.path[p].anchors) {
          const auto segment = static_cast<std::size_t>(anchor.segment);
          place.c += anchor.weight * (X_WB[segment] * anchor.p_B);
          place.D += anchor.weight * X_WB[segment].linear() *
                     (poses_->atZero()[segment].linear().transpose() * points_[p].basis_W);
        }
        place.DtD = place.D.transpose() * place.D;
      }
    }
}

void UnitProblem::sortPieces(const MusculotendonUnit& unit, const MotionPoses& reference_poses) {
  const MotionPoses& poses = *poses_;
  constexpr double kRounding = 1e-12;
  const auto baseOf = [&](std::size_t piece) {
    return static_cast<std::size_t>(unit.path[piece].anchors.front().segment);
  };
  // Whether the segments that both ends hang on lie to each other as in `X_WB`, over a whole motion.
  const auto lieAs = [&](const std::vector<RigidTransform>& X_WB, int motion, std::size_t piece) {
    const std::size_t base = baseOf(piece);
    for (const std::size_t end : {piece, piece + 1})
      for (const Anchor& anchor : unit.path[end].anchors) {
        const auto segment = static_cast<std::size_t>(anchor.segment);
        if (segment == base) continue;
        const RigidTransform wanted = X_WB[base].inverse() * X_WB[segment];
        for (int s = 0; s < kRoutingSamples; ++s) {
          const auto& now = poses.at(motion, s);
          if (!wanted.matrix().isApprox((now[base].inverse() * now[segment]).matrix(), kRounding)) return false;
        }
      }
    return true;
  };
  const auto turnsAsBefore = [&](int motion, std::size_t piece) {
    const std::size_t base = baseOf(piece);
    const auto& zero = reference_poses.atZero();
    const Eigen::Matrix3d wanted = zero[base].linear().transpose() * poses.atZero()[base].linear();
    for (int s = 0; s < kRoutingSamples; ++s)
      if (!wanted.isApprox(
              reference_poses.at(motion, s)[base].linear().transpose() * poses.at(motion, s)[base].linear(),
              kRounding))
        return false;
    return true;
  };
  std::vector<int> rigid_at(points_.size() - 1, -1);
  for (std::size_t m = 0; m < motion_weight_.size(); ++m) {
    auto& moving = moving_.emplace_back();
    for (std::size_t piece = 0; piece < rigid_at.size(); ++piece) {
      const int motion = reference_->motions[m];
      if (!lieAs(poses.atZero(), motion, piece) || !turnsAsBefore(motion, piece)) {
        moving.push_back({piece, !lieAs(poses.at(motion, 0), motion, piece)});
        continue;
      }
      if (rigid_at[piece] < 0) {
        rigid_at[piece] = static_cast<int>(rigid_.size());
        rigid_.push_back({m, piece, 0});
      }
      rigid_[static_cast<std::size_t>(rigid_at[piece])].weight += motion_weight_[m];
    }
  }
}

bool UnitProblem::isFree() const {
  if (reference_->motions.empty()) return false;
  return std::ranges::any_of(points_, [](const Point& point) { return !point.basis_W.isZero(0); });
}

/// What the directions of one piece add up to; kept apart so that the large matrix is touched once a piece.
struct UnitProblem::PieceSum {
  double energy = 0;
  Eigen::Vector3d gradient_a = Eigen::Vector3d::Zero(), gradient_b = Eigen::Vector3d::Zero();
  Eigen::Matrix3d hessian_aa = Eigen::Matrix3d::Zero(), hessian_bb = Eigen::Matrix3d::Zero(),
                  hessian_ba = Eigen::Matrix3d::Zero();
};

/// Direction of the piece from point a to b at one sample: |u x d|^2 with u the reference's. Its length joins sample
/// `length_of` (-1: it does not matter).
///
/// With n the distance and p = u - (u.d) d: the slope is -2 (u.d) p / n along b - a, and the Gauss-Newton matrix of
/// the residual u x d is (1 - d d^T - p p^T) / n^2.
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
  sum.energy += weight * u.cross(d).squaredNorm();
  if (length_of >= 0) lengths_[static_cast<std::size_t>(length_of)] += norm / zero_length_m_;
  if constexpr (kOrder != Order::Value) {
    const Eigen::Vector3d d_a = from.D.transpose() * d, d_b = to.D.transpose() * d;
    if (length_of >= 0) {
      length_slopes_.col(length_of).segment<3>(a) -= d_a / zero_length_m_;
      length_slopes_.col(length_of).segment<3>(b) += d_b / zero_length_m_;
    }
    const double along = u.dot(d);
    const Eigen::Vector3d p = u - along * d;
    const Eigen::Vector3d p_a = from.D.transpose() * p, p_b = to.D.transpose() * p;
    const double slope = -2 * weight * along / norm;
    sum.gradient_a -= slope * p_a;
    sum.gradient_b += slope * p_b;
    if constexpr (kOrder == Order::Hessian) {
      const double bend = 2 * weight / (norm * norm);
      sum.hessian_aa += bend * (from.DtD - d_a * d_a.transpose() - p_a * p_a.transpose());
      sum.hessian_bb += bend * (to.DtD - d_b * d_b.transpose() - p_b * p_b.transpose());
      sum.hessian_ba -=
          bend * (Eigen::Matrix3d{to.D.transpose() * from.D} - d_b * d_a.transpose() - p_b * p_a.transpose());
    }
  }
}

template <UnitProblem::Order kOrder>
double UnitProblem::collect(const PieceSum& sum, std::size_t piece, Expansion& e) {
  const auto a = static_cast<Eigen::Index>(3 * piece), b = a + 3;
  if constexpr (kOrder != Order::Value) {
    e.gradient.segment<3>(a) += sum.gradient_a;
    e.gradient.segment<3>(b) += sum.gradient_b;
  }
  if constexpr (kOrder == Order::Hessian) {
    e.hessian.block<3, 3>(a, a) += sum.hessian_aa;
    e.hessian.block<3, 3>(b, b) += sum.hessian_bb;
    e.hessian.block<3, 3>(b, a) += sum.hessian_ba;
  }
  return sum.energy;
}

/// E_length of one motion: theta_max, theta_min, Delta.
template <UnitProblem::Order kOrder>
double UnitProblem::addFeatures(std::size_t motion, Expansion& e) const {
  const CurveFeatures& wanted = reference_->features[motion];
  const CurveFeatures found = curveFeatures(lengths_);
  const double significance = reference_->significance[motion];
  const double at_longest = found.longest.theta - wanted.longest.theta;
  const double at_shortest = found.shortest.theta - wanted.shortest.theta;
  const double range = found.range() - wanted.range();
  if constexpr (kOrder != Order::Value) {
    const auto slopeOf = [&](const CurveExtremum& extremum, const std::array<double, 3>& slope) -> Eigen::VectorXd {
      return length_slopes_.middleCols<3>(extremum.first_sample) * Eigen::Map<const Eigen::Vector3d>(slope.data());
    };
    const double theta_weight = std::sqrt(weights_.length * motion_weight_[motion] * significance);
    const double range_weight = std::sqrt(weights_.length * motion_weight_[motion] * weights_.range);
    for (const auto& [extremum, off] :
         {std::pair{&found.longest, at_longest}, std::pair{&found.shortest, at_shortest}})
      addResidual<kOrder == Order::Hessian>(theta_weight * off,
                                            theta_weight * slopeOf(*extremum, extremum->theta_slope), e);
    addResidual<kOrder == Order::Hessian>(range_weight * range,
                                          range_weight * (slopeOf(found.longest, found.longest.value_slope) -
                                                          slopeOf(found.shortest, found.shortest.value_slope)),
                                          e);
  }
  return motion_weight_[motion] *
         (significance * (at_longest * at_longest + at_shortest * at_shortest) + weights_.range * range * range);
}

/// The curve itself, its mean apart; in the expansion with the given weight.
template <UnitProblem::Order kOrder>
double UnitProblem::addCurve(std::size_t motion, double weight, Expansion& e) const {
  using Samples = Eigen::Matrix<double, kRoutingSamples, 1>;
  Samples off = Eigen::Map<const Samples>(lengths_.data()) -
                Eigen::Map<const Samples>(&reference_->lengths[motion * kRoutingSamples]);
  off.array() -= off.mean();
  const double share = motion_weight_[motion] / kRoutingSamples;
  if constexpr (kOrder != Order::Value) {
    const Eigen::MatrixXd slopes = length_slopes_.colwise() - length_slopes_.rowwise().mean();
    const double scale = 2 * weight * share;
    e.gradient.noalias() += scale * (slopes * off);
    if constexpr (kOrder == Order::Hessian) e.hessian.selfadjointView<Eigen::Lower>().rankUpdate(slopes, scale);
  }
  return share * off.squaredNorm();
}

/// Steps from sample to sample that go against a step that matters in the reference.
template <UnitProblem::Order kOrder>
double UnitProblem::addReversals(std::size_t motion, Expansion& e) const {
  const double* wanted = &reference_->lengths[motion * kRoutingSamples];
  const double matters = kReversalShare * reference_->features[motion].range();
  const double weight = weights_.reversal * motion_weight_[motion] * reference_->significance[motion];
  double energy = 0;
  for (int s = 0; s + 1 < kRoutingSamples; ++s) {
    const double step = wanted[s + 1] - wanted[s];
    if (std::abs(step) < matters) continue;
    const double sign = step > 0 ? 1 : -1;
    const double against = sign * (lengths_[static_cast<std::size_t>(s) + 1] - lengths_[static_cast<std::size_t>(s)]);
    if (against >= 0) continue;
    energy += weight * against * against;
    if constexpr (kOrder != Order::Value) {
      const double scale = std::sqrt(weight);
      addResidual<kOrder == Order::Hessian>(scale * against,
                                            scale * sign * (length_slopes_.col(s + 1) - length_slopes_.col(s)), e);
    }
  }
  return energy;
}

/// Displacements, and moves into the bone that a point glides on.
template <UnitProblem::Order kOrder>
double UnitProblem::addPrices(const Eigen::VectorXd& x, Expansion& e) const {
  double energy = 0;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const auto at = static_cast<Eigen::Index>(3 * p);
    const double price = points_[p].price_1_m2, inside = weights_.inside_1_m2;
    const Eigen::Matrix3d& basis = points_[p].basis_B;
    const Eigen::Vector3d step = x.segment<3>(at), moved = points_[p].moved_B + basis * step;
    energy += price * moved.squaredNorm();
    const Eigen::Vector3d slope = points_[p].basis_W.transpose() * points_[p].outward_W;
    const double beyond = slope.isZero(0) ? 0 : std::min(0.0, slope.dot(step) + points_[p].slack_m);
    energy += inside * beyond * beyond;
    if constexpr (kOrder != Order::Value)
      e.gradient.segment<3>(at) += 2 * (price * (basis.transpose() * moved) + inside * beyond * slope);
    if constexpr (kOrder == Order::Hessian) {
      e.hessian.block<3, 3>(at, at) += 2 * price * (basis.transpose() * basis);
      if (beyond < 0) e.hessian.block<3, 3>(at, at) += 2 * inside * slope * slope.transpose();
    }
  }
  return energy;
}

template <UnitProblem::Order kOrder>
double UnitProblem::evaluate(const Eigen::VectorXd& x, Objective objective, RoutingEnergy& parts,
                             Expansion& e) const {
  if constexpr (kOrder != Order::Value) e.gradient.setZero(unknowns());
  if constexpr (kOrder == Order::Hessian) e.hessian.setZero(unknowns(), unknowns());
  parts = {};
  const double curve_weight = weights_.length * weights_.range * (objective.features ? weights_.curve : 1);
  for (const RigidPiece& rigid : rigid_) {
    PieceSum sum;
    addSample<kOrder>(x, rigid.motion * kRoutingSamples, rigid.piece, rigid.weight, -1, sum);
    parts.direction += collect<kOrder>(sum, rigid.piece, e);
  }
  for (std::size_t m = 0; m < motion_weight_.size(); ++m) {
    std::ranges::fill(lengths_, 0.0);
    if constexpr (kOrder != Order::Value) length_slopes_.setZero();
    for (const MovingPiece& moving : moving_[m]) {
      PieceSum sum;
      for (int s = 0; s < kRoutingSamples; ++s)
        addSample<kOrder>(x, m * kRoutingSamples + static_cast<std::size_t>(s), moving.piece,
                          motion_weight_[m] * integrationWeight(s), moving.changes_length ? s : -1, sum);
      parts.direction += collect<kOrder>(sum, moving.piece, e);
    }
    if (objective.features) parts.length += addFeatures<kOrder>(m, e);
    parts.curve += addCurve<kOrder>(m, curve_weight, e);
    parts.reversal += addReversals<kOrder>(m, e);
  }
  parts.displacement = addPrices<kOrder>(x, e);
  RoutingWeights weights = weights_;
  if (!objective.features) weights.curve = 1;
  return e.energy = parts.total(weights);
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
