#include "core/skeleton/fit/triangulated_figures_internal.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/skeleton/fit/bone_figures_internal.h"
#include "core/skeleton/fit/fit_start_internal.h"

namespace sinew {
namespace {

using Eigen::Vector3d;

/// A point that nobody picks, and the landmarks around it on the same piece of bone, at their places in its frame.
struct Surrounded {
  std::string point;
  std::vector<std::string> neighbours;
};
const std::vector<Surrounded>& surroundedPoints() {
  static const std::vector<Surrounded> list = {
      {"knee_center", {"medial_epicondyle", "lateral_epicondyle", "medial_condyle_center", "lateral_condyle_center"}},
      // The talar dome's centre is the ankle's.
      {"ankle_center", {"tibial_plafond_center", "medial_malleolus", "lateral_malleolus", "talar_dome_center"}}};
  return list;
}

/// Place of a landmark at the zero posture of the reference, in the frame of `segment`.
Vector3d placeInFrame(const Skeleton& reference, const std::vector<RigidTransform>& X_WB, int segment,
                      const std::string& name) {
  const Landmark& landmark = reference.landmark(name);
  return X_WB[std::size_t(segment)].inverse() * (X_WB[std::size_t(landmark.segment)] * landmark.p_BL);
}

/// Figures from points of the world: what is computed once for many evaluations.
class FiguresOfPicks {
 public:
  FiguresOfPicks(const Skeleton& reference, std::span<const PickedPoint> points) {
    const auto pickOf = [&](const std::string& name) {
      const int index = reference.landmarkIndex(name);
      const auto at = std::ranges::find(points, index, &PickedPoint::landmark);
      return at == points.end() ? -1 : int(at - points.begin());
    };
    for (const auto& name : figureLandmarkNames()) pick_.push_back(pickOf(name));
    const auto X_WB = segmentPoses(reference, zeroPosture(reference));
    for (const auto& around : surroundedPoints())
      for (const std::string side : {"_r", "_l"}) {
        Cluster cluster;
        cluster.target =
            int(std::ranges::find(figureLandmarkNames(), around.point + side) - figureLandmarkNames().begin());
        if (pick_[std::size_t(cluster.target)] >= 0) continue;  // somebody did pick it
        const Landmark& target = reference.landmark(around.point + side);
        cluster.p_B = target.p_BL;
        for (const auto& name : around.neighbours) {
          const int pick = pickOf(name + side);
          if (pick < 0) continue;
          cluster.picks.push_back(pick);
          cluster.neighbours_B.push_back(placeInFrame(reference, X_WB, target.segment, name + side));
        }
        clusters_.push_back(cluster);
      }
  }

  std::vector<double> at(const std::vector<Vector3d>& picked) const {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    std::vector<Vector3d> points;
    for (const int pick : pick_) points.push_back(pick < 0 ? Vector3d::Constant(kNaN) : picked[std::size_t(pick)]);
    for (const Cluster& cluster : clusters_) {
      std::vector<Vector3d> around;
      for (const int pick : cluster.picks) around.push_back(picked[std::size_t(pick)]);
      if (const auto X = similarityOf(cluster.neighbours_B, around))
        points[std::size_t(cluster.target)] = X->scale * X->R * cluster.p_B + X->t;
    }
    return figureValues<double>(points);
  }

 private:
  struct Cluster {
    int target = 0;  ///< place in figureLandmarkNames()
    Vector3d p_B;
    std::vector<int> picks;
    std::vector<Vector3d> neighbours_B;
  };
  std::vector<int> pick_;  ///< by figure landmark: index of its point, or -1
  std::vector<Cluster> clusters_;
};

}  // namespace

std::optional<PickedPoint> pickedPoint(const LandmarkPicks& picks, const ImageOfPoint& image,
                                       const Eigen::Vector3d& start_W) {
  const Eigen::Index rows = picks.uv_px.size();
  if (picks.views.size() < 2) return std::nullopt;
  const Eigen::MatrixXd weight = picks.covariance_px2.inverse();
  PickedPoint point{picks.landmark, start_W, {}, 0, {}};
  Eigen::VectorXd residual_px(rows);
  Eigen::MatrixXd by_point(rows, 3), by_nuisance;
  constexpr int kSteps = 12;
  constexpr double kStill_m = 1e-10, kOpen_m = 0.1;
  for (int i = 0; i < kSteps; ++i) {
    for (Eigen::Index k = 0; k < rows / 2; ++k) {
      SeenImage seen;
      if (!image(picks.landmark, picks.views[std::size_t(k)], point.p_W, seen)) return std::nullopt;
      residual_px.segment<2>(2 * k) = picks.uv_px.segment<2>(2 * k) - seen.uv_px;
      by_point.middleRows<2>(2 * k) = seen.by_point;
      if (k == 0) by_nuisance = Eigen::MatrixXd::Zero(rows, seen.by_nuisance.cols());
      by_nuisance.middleRows<2>(2 * k) = seen.by_nuisance;
    }
    const Eigen::Matrix3d normal = by_point.transpose() * weight * by_point;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes{normal, Eigen::EigenvaluesOnly};
    if (!(axes.eigenvalues()[0] > 1 / (kOpen_m * kOpen_m))) return std::nullopt;
    point.covariance_W_m2 = normal.inverse();
    const Eigen::MatrixXd by_picks = point.covariance_W_m2 * by_point.transpose() * weight;
    point.by_nuisance = -by_picks * by_nuisance;
    const Vector3d step = by_picks * residual_px;
    point.p_W += step;
    if (step.norm() < kStill_m) break;
  }
  const Eigen::Index degrees = rows - 3;
  point.disagreement = std::sqrt(residual_px.dot(weight * residual_px) / double(degrees));
  return point;
}

TriangulatedFigures triangulatedFigures(const Skeleton& reference, std::span<const PickedPoint> points,
                                        const Eigen::MatrixXd& nuisance_covariance) {
  const FiguresOfPicks figures{reference, points};
  std::vector<Vector3d> p_W;
  for (const PickedPoint& point : points) p_W.push_back(point.p_W);
  TriangulatedFigures result;
  result.value = figures.at(p_W);
  const Eigen::Index count = Eigen::Index(result.value.size());
  Eigen::MatrixXd by_points = Eigen::MatrixXd::Zero(count, 3 * Eigen::Index(p_W.size()));
  constexpr double kStep_m = 1e-5;  // against distances of 50 mm: truncation below 1e-7 of the derivative
  for (std::size_t i = 0; i < p_W.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      auto more = p_W, less = p_W;
      more[i][axis] += kStep_m, less[i][axis] -= kStep_m;
      const auto high = figures.at(more), low = figures.at(less);
      for (Eigen::Index f = 0; f < count; ++f)
        by_points(f, 3 * Eigen::Index(i) + axis) = (high[std::size_t(f)] - low[std::size_t(f)]) / (2 * kStep_m);
    }
  for (Eigen::Index f = 0; f < count; ++f) {
    double variance = 0;
    Eigen::VectorXd by_nuisance = Eigen::VectorXd::Zero(nuisance_covariance.rows());
    for (std::size_t i = 0; i < p_W.size(); ++i) {
      const Vector3d g = by_points.row(f).segment<3>(3 * Eigen::Index(i));
      variance += g.dot(points[i].covariance_W_m2 * g);
      if (by_nuisance.size() > 0) by_nuisance += points[i].by_nuisance.transpose() * g;
    }
    if (by_nuisance.size() > 0) variance += by_nuisance.dot(nuisance_covariance * by_nuisance);
    result.sd.push_back(std::sqrt(variance));
  }
  return result;
}

}  // namespace sinew
