#include <algorithm>

#include "core/error.h"
#include "core/retarget/routing/unit_problem_internal.h"

namespace sinew {
UnitProblem::UnitProblem(const std::vector<std::vector<Anchor>>& anchors, const ReferenceCurves& reference,
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
  moveTo(anchors, points);
  for (std::size_t p = 0; p + 1 < zero_.size(); ++p) lengths_m_.push_back((zero_[p + 1].c - zero_[p].c).norm());
  length_slopes_.resize(unknowns(), kRoutingSamples);
  constexpr int kMostResiduals = 3 + 2 * kRoutingSamples;  // of a motion
  const auto most = static_cast<Eigen::Index>(motion_weight_.size()) * kMostResiduals;
  residual_slopes_.resize(unknowns(), most);
  residuals_.resize(most);
  sortPieces(anchors, reference_poses);
}

void UnitProblem::moveTo(const std::vector<std::vector<Anchor>>& anchors, const std::vector<Point>& points) {
  points_ = points;
  zero_.resize(points_.size());
  places_.resize(reference_->motions.size() * kRoutingSamples * points_.size());
  for (std::size_t p = 0; p < points_.size(); ++p) placePoint(p, anchors[p]);
}

void UnitProblem::movePoint(std::size_t p, const std::vector<Anchor>& anchors, const Point& point) {
  points_[p] = point;
  placePoint(p, anchors);
}

/// The unknowns of a point in the segment of each of its anchors, weighted.
UnitProblem::Bases UnitProblem::basesOf(std::size_t p, const std::vector<Anchor>& anchors) const {
  Bases bases_B;
  require(anchors.size() <= bases_B.size(), "UnitProblem: a point hangs on few segments");
  for (std::size_t k = 0; k < anchors.size(); ++k)
    bases_B[k] =
        anchors[k].weight *
        (poses_->atZero()[static_cast<std::size_t>(anchors[k].segment)].linear().transpose() * points_[p].basis_W);
  return bases_B;
}

UnitProblem::Place UnitProblem::placed(const std::vector<Anchor>& anchors, const Bases& bases_B,
                                       const MotionPoses::Poses& X_WB) {
  Place place{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
  for (std::size_t k = 0; k < anchors.size(); ++k) {
    const RigidTransform& X = X_WB[static_cast<std::size_t>(anchors[k].segment)];
    place.c += anchors[k].weight * (X * anchors[k].p_B);
    place.D.noalias() += X.linear() * bases_B[k];
  }
  return place;
}

void UnitProblem::placePoint(std::size_t p, const std::vector<Anchor>& anchors) {
  const Bases bases_B = basesOf(p, anchors);
  zero_[p] = {placed(anchors, bases_B, poses_->atZero()).c, points_[p].basis_W};
  Place* place = &places_[p];
  for (const int motion : reference_->motions)
    for (int s = 0; s < kRoutingSamples; ++s, place += points_.size())
      *place = placed(anchors, bases_B, poses_->at(motion, s));
  placeWatched(p, anchors);
}

void UnitProblem::sortPieces(const std::vector<std::vector<Anchor>>& anchors, const MotionPoses& reference_poses) {
  const MotionPoses& poses = *poses_;
  constexpr double kRounding = 1e-12;
  const auto baseOf = [&](std::size_t piece) { return static_cast<std::size_t>(anchors[piece].front().segment); };
  // Whether the segments that both ends hang on lie to each other as in `X_WB`, over a whole motion.
  const auto lieAs = [&](const std::vector<RigidTransform>& X_WB, int motion, std::size_t piece) {
    const std::size_t base = baseOf(piece);
    for (const std::size_t end : {piece, piece + 1})
      for (const Anchor& anchor : anchors[end]) {
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
    changes_length_.push_back(std::ranges::any_of(moving, &MovingPiece::changes_length));
  }
}

bool UnitProblem::turnsAround(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const {
  const auto at = [&](std::size_t p, const Eigen::VectorXd& x) -> Eigen::Vector3d {
    return zero_[p].c + zero_[p].D * x.segment<3>(static_cast<Eigen::Index>(3 * p));
  };
  for (std::size_t p = 0; p + 1 < points_.size(); ++p)
    if (lengths_m_[p] >= kLeastPiece_m && (at(p + 1, from) - at(p, from)).dot(at(p + 1, to) - at(p, to)) < 0)
      return true;
  return false;
}

bool UnitProblem::isFree() const {
  if (reference_->motions.empty()) return false;
  return std::ranges::any_of(points_, [](const Point& point) { return !point.basis_W.isZero(0); });
}

}  // namespace sinew
