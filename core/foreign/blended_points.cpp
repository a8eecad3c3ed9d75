#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/foreign/blended_points_internal.h"
#include "core/foreign/foreign_from_model.h"
#include "core/foreign/foreign_kinematics_internal.h"
#include "core/muscle/muscle_path.h"
#include "core/rom/poses/pose_sampler.h"
#include "core/rom/poses/range_postures.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

constexpr int kKnots = 25;         // of a moving point's splines, over the range of its coordinate
constexpr double kMoves_m = 1e-5;  // a point that moves less with a coordinate does not move with it
constexpr int kRandomPostures = 80;
constexpr std::uint32_t kSeed = 77;  // other postures than those of the deviation report

/// A posture in both models.
struct PosedPair {
  std::vector<RigidTransform> ours, theirs;
  ForeignPosture q;
};

Eigen::Vector3d blended(const PathPoint& point, const std::vector<RigidTransform>& X_WB) {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  for (const Anchor& a : point.anchors) p_W += a.weight * (X_WB[static_cast<std::size_t>(a.segment)] * a.p_B);
  return p_W;
}

/// A stand-in for one blended point, and where it is in every judged posture.
struct Candidate {
  ForeignPathPoint point;
  std::vector<Eigen::Vector3d> p_W;
  double squared_error = 0;
};

class BlendedPoints {
 public:
  BlendedPoints(const Model& model, ForeignModel& foreign) : model_{model}, foreign_{foreign} {
    constexpr double kStep_deg = 30;
    auto postures = rangePostures(model.skeleton, kStep_deg, 0);
    for (auto& q : normalPostures(model.skeleton, kRandomPostures, kSeed)) postures.push_back(std::move(q));
    for (const Posture& q : postures) judged_.push_back(pair(q));
    sweeps_.resize(static_cast<std::size_t>(model.skeleton.coordinateCount()));
  }

  void fit(std::size_t unit) {
    const auto& points = model_.musculature.units[unit].path;
    std::vector<std::vector<Candidate>> candidates(points.size());
    bool any = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
      candidates[i] = candidatesFor(points[i], foreign_.paths[unit].points[i]);
      any = any || candidates[i].size() > 1;
    }
    if (!any) return;
    std::vector<std::size_t> chosen(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      chosen[i] = static_cast<std::size_t>(std::ranges::min_element(candidates[i], {}, &Candidate::squared_error) -
                                           candidates[i].begin());
    improve(unit, candidates, chosen);
    for (std::size_t i = 0; i < points.size(); ++i) foreign_.paths[unit].points[i] = candidates[i][chosen[i]].point;
  }

 private:
  PosedPair pair(const Posture& posture) const {
    PosedPair pair{segmentPoses(model_.skeleton, posture), {}, foreignPosture(foreign_, model_.skeleton, posture)};
    pair.theirs = bodyPoses(foreign_, pair.q);
    return pair;
  }

  /// One coordinate over its range, a little beyond either end, all others zero.
  const std::vector<PosedPair>& sweep(int coordinate) {
    auto& sweep = sweeps_[static_cast<std::size_t>(coordinate)];
    if (!sweep.empty()) return sweep;
    constexpr double kMargin = 0.05;
    const Coordinate& c = model_.skeleton.coordinates[static_cast<std::size_t>(coordinate)];
    const double margin_rad = kMargin * (c.athlete_max_rad - c.athlete_min_rad);
    const double low = std::min(0.0, c.athlete_min_rad) - margin_rad,
                 high = std::max(0.0, c.athlete_max_rad) + margin_rad;
    for (int k = 0; k < kKnots; ++k) {
      Eigen::VectorXd clinical = Eigen::VectorXd::Zero(model_.skeleton.coordinateCount());
      double x = low + (high - low) * k / (kKnots - 1);
      if (std::abs(x) <= (high - low) / (kKnots - 1) / 2) x = 0;  // a knot at zero: exact there
      clinical[coordinate] = x;
      sweep.push_back(pair(postureFromClinical(model_.skeleton, clinical)));
      sweep.back().q[coordinate] = x;  // also beyond 90 deg, where the clinical reading is another
    }
    return sweep;
  }

  /// Coordinates of the joints between the anchors.
  std::vector<int> coordinatesBetween(const PathPoint& point) const {
    const Skeleton& s = model_.skeleton;
    std::vector<int> count(s.coordinates.size(), 0);
    for (const Anchor& a : point.anchors) {
      int segment = a.segment;
      for (const PatellaDriver& d : s.patellae)
        if (segment == d.segment) ++count[static_cast<std::size_t>(d.knee_coordinate)], segment = d.femur;
      for (const RadiusDriver& d : s.radii)
        if (segment == d.segment) {
          ++count[static_cast<std::size_t>(s.joints[static_cast<std::size_t>(d.wrist_joint)].first_coordinate)];
          segment = d.ulna;
        }
      for (; segment >= 0; segment = s.joints[static_cast<std::size_t>(segment)].parent) {
        const Joint& joint = s.joints[static_cast<std::size_t>(segment)];
        for (int k = 0; k < joint.coordinate_count; ++k)
          ++count[static_cast<std::size_t>(joint.first_coordinate + k)];
      }
    }
    std::vector<int> between;
    for (std::size_t i = 0; i < count.size(); ++i)
      if (count[i] > 0 && count[i] < static_cast<int>(point.anchors.size())) between.push_back(static_cast<int>(i));
    return between;
  }

  /// `fixed` first; the only one of a point that is not blended.
  std::vector<Candidate> candidatesFor(const PathPoint& point, const ForeignPathPoint& fixed) {
    std::vector<Candidate> list{judged(fixed, point)};
    if (point.anchors.size() < 2) return list;
    const std::vector<int> coordinates = coordinatesBetween(point);
    for (const Anchor& a : point.anchors) {
      ForeignPathPoint still = fixed;
      still.body = a.segment;
      for (int axis = 0; axis < 3; ++axis) still.p_F[static_cast<std::size_t>(axis)] = {a.p_B[axis], {}};
      if (still.body != fixed.body) list.push_back(judged(still, point));
      std::vector<ForeignPathPoint> moving;
      for (const int c : coordinates)
        if (const auto m = movingPoint(point, still, c)) {
          moving.push_back(*m);
          list.push_back(judged(*m, point));
        }
      if (moving.size() > 1) list.push_back(judged(mixedPoint(point, still, moving), point));
    }
    return list;
  }

  std::optional<ForeignPathPoint> movingPoint(const PathPoint& point, ForeignPathPoint still, int coordinate) {
    std::vector<double> x;
    std::array<std::vector<double>, 3> y;
    double farthest_m = 0;
    const Eigen::Vector3d rest{still.p_F[0].constant, still.p_F[1].constant, still.p_F[2].constant};
    for (const PosedPair& pair : sweep(coordinate)) {
      const Eigen::Vector3d p_B =
          pair.theirs[static_cast<std::size_t>(still.body)].inverse() * blended(point, pair.ours);
      x.push_back(pair.q[coordinate]);
      for (int axis = 0; axis < 3; ++axis) y[static_cast<std::size_t>(axis)].push_back(p_B[axis]);
      farthest_m = std::max(farthest_m, (p_B - rest).norm());
    }
    if (farthest_m < kMoves_m) return std::nullopt;
    for (std::size_t axis = 0; axis < 3; ++axis)
      still.p_F[axis] = CoordinateFunction::of(coordinate, ScalarFunction::simmSpline(x, y[axis]));
    return still;
  }

  /// Every component follows the coordinate, of those of `moving`, that suits it best.
  ForeignPathPoint mixedPoint(const PathPoint& point, const ForeignPathPoint& still,
                              const std::vector<ForeignPathPoint>& moving) const {
    ForeignPathPoint mixed = still;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double least = std::numeric_limits<double>::infinity();
      const auto offer = [&](const CoordinateFunction& f) {
        double sum = 0;
        for (const PosedPair& pair : judged_) {
          const std::span<const double> q{pair.q.data(), static_cast<std::size_t>(pair.q.size())};
          const Eigen::Vector3d p_B =
              pair.theirs[static_cast<std::size_t>(still.body)].inverse() * blended(point, pair.ours);
          const double off = evaluated(f, q) - p_B[static_cast<Eigen::Index>(axis)];
          sum += off * off;
        }
        if (sum < least) {
          least = sum;
          mixed.p_F[axis] = f;
        }
      };
      offer(still.p_F[axis]);
      for (const auto& m : moving) offer(m.p_F[axis]);
    }
    return mixed;
  }

  Candidate judged(const ForeignPathPoint& stand_in, const PathPoint& point) const {
    Candidate candidate{stand_in, {}, 0};
    for (const PosedPair& pair : judged_) {
      const std::span<const double> q{pair.q.data(), static_cast<std::size_t>(pair.q.size())};
      candidate.p_W.push_back(pair.theirs[static_cast<std::size_t>(stand_in.body)] *
                              (stand_in.X_BF * evaluated(stand_in.p_F, q)));
      candidate.squared_error += (candidate.p_W.back() - blended(point, pair.ours)).squaredNorm();
    }
    return candidate;
  }

  /// One point after the other takes the candidate with which the unit's length deviates least (mean square).
  void improve(std::size_t unit, const std::vector<std::vector<Candidate>>& candidates,
               std::vector<std::size_t>& chosen) const {
    std::vector<double> truth_m;
    for (const PosedPair& pair : judged_) truth_m.push_back(pathLength(model_.musculature.units[unit], pair.ours));
    const auto meanSquare = [&] {
      double sum = 0;
      for (std::size_t k = 0; k < judged_.size(); ++k) {
        double length_m = 0;
        for (std::size_t i = 1; i < chosen.size(); ++i)
          length_m += (candidates[i][chosen[i]].p_W[k] - candidates[i - 1][chosen[i - 1]].p_W[k]).norm();
        sum += (length_m - truth_m[k]) * (length_m - truth_m[k]);
      }
      return sum;
    };
    double best = meanSquare();
    constexpr int kRounds = 3;
    for (int round = 0; round < kRounds; ++round) {
      const double before = best;
      for (std::size_t i = 0; i < chosen.size(); ++i)
        for (std::size_t c = 0, kept = chosen[i]; c < candidates[i].size(); ++c) {
          chosen[i] = c;
          if (const double sum = meanSquare(); sum < best) {
            best = sum;
            kept = c;
          }
          chosen[i] = kept;
        }
      if (!(best < before)) return;
    }
  }

  const Model& model_;
  ForeignModel& foreign_;
  std::vector<PosedPair> judged_;
  std::vector<std::vector<PosedPair>> sweeps_;
};

}  // namespace

ForeignPath anchoredPath(const MusculotendonUnit& unit) {
  ForeignPath path;
  for (std::size_t i = 0; i < unit.path.size(); ++i) {
    const Anchor& a = *std::ranges::max_element(unit.path[i].anchors, {}, &Anchor::weight);
    ForeignPathPoint point;
    point.name = unit.name + "-P" + std::to_string(i + 1);
    point.body = a.segment;
    for (int axis = 0; axis < 3; ++axis) point.p_F[static_cast<std::size_t>(axis)].constant = a.p_B[axis];
    path.points.push_back(std::move(point));
  }
  return path;
}

void fitBlendedPoints(const Model& model, ForeignModel& foreign) {
  BlendedPoints points{model, foreign};
  for (std::size_t unit = 0; unit < model.musculature.units.size(); ++unit) points.fit(unit);
}

}  // namespace sinew
