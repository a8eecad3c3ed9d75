#include "core/kernel/joint_grid.h"

#include <algorithm>
#include <numbers>

#include "core/error.h"
#include "core/kernel/compiled_arrays_internal.h"
#include "core/muscle/hill.h"

namespace sinew {
namespace {

static_assert(static_cast<int>(GridVerdict::Forbidden) == static_cast<int>(CellState::Forbidden) &&
              static_cast<int>(GridVerdict::Allowed) == static_cast<int>(CellState::Allowed) &&
              static_cast<int>(GridVerdict::Close) == static_cast<int>(CellState::Close));

using FloatTable = std::vector<float, LaneAllocator<float>>;

/// A path point in the joint frame J: p = f + R m + Q n; see grid_view_internal.h.
struct SplitPoint {
  Eigen::Vector3d f = Eigen::Vector3d::Zero(), m = f, n = f;
  Eigen::Vector3d p_W = f;  ///< at the held posture, the joint at zero
  bool has_fixed = false, has_moving = false, has_radius = false;

  bool pure() const { return has_fixed + has_moving + has_radius == 1; }
  bool movesLike(const SplitPoint& o) const {
    return pure() && o.pure() && has_fixed == o.has_fixed && has_moving == o.has_moving;
  }
};

/// Splits path points by how their anchors move with the joint.
class PointSplitter {
 public:
  PointSplitter(const Skeleton& skeleton, int joint, const Posture& held)
      : motions_{motionsWithJoint(skeleton, joint)} {
    const Joint& j = skeleton.joints[joint];
    Posture q = held;
    q.segment<3>(j.first_coordinate).setZero();
    X_WB_ = segmentPoses(skeleton, q);
    X_JW_ = (j.parent < 0 ? j.X_PJ : X_WB_[j.parent] * j.X_PJ).inverse();
  }

  SplitPoint split(const PathPoint& point) const {
    SplitPoint split;
    for (const Anchor& a : point.anchors) {
      const Eigen::Vector3d p_W = X_WB_[a.segment] * a.p_B;
      split.p_W += a.weight * p_W;
      switch (motions_[a.segment]) {
        case JointMotionKind::Fixed:
          split.has_fixed = true;
          split.f += a.weight * (X_JW_ * p_W);
          break;
        case JointMotionKind::WithChild:
          split.has_moving = true;
          split.m += a.weight * (X_JW_ * p_W);
          break;
        case JointMotionKind::WithRadius:
          split.has_radius = true;
          split.f += a.weight * (X_JW_ * X_WB_[a.segment].translation());
          split.n += a.weight * a.p_B;
      }
    }
    return split;
  }

  Eigen::Matrix3d R_JS(int segment) const { return X_JW_.linear() * X_WB_[segment].linear(); }

 private:
  std::vector<JointMotionKind> motions_;
  std::vector<RigidTransform> X_WB_;
  RigidTransform X_JW_;
};

/// All that the grid kernel reads, in double where a twist still has to turn it.
struct GridProgram {
  std::vector<GridMuscle> muscles;
  std::vector<int> run_points{0};
  std::vector<SplitPoint> points;
  bool has_radius = false;
};

void addUnit(const PointSplitter& splitter, const MusculotendonUnit& unit, GridProgram& program) {
  GridMuscle muscle{static_cast<int>(program.run_points.size()) - 1, 0, 0, 0};
  double constant_m = -longestLength_m(unit);
  bool in_run = false;
  const auto endRun = [&] {
    if (in_run) program.run_points.push_back(static_cast<int>(program.points.size()));
    in_run = false;
  };
  SplitPoint a = splitter.split(unit.path.front());
  for (std::size_t i = 1; i < unit.path.size(); ++i) {
    const SplitPoint b = splitter.split(unit.path[i]);
    if (a.movesLike(b)) {
      constant_m += (b.p_W - a.p_W).norm();
      endRun();
    } else {
      if (!in_run) program.points.push_back(a);
      program.points.push_back(b);
      in_run = true;
    }
    a = b;
  }
  endRun();
  muscle.end_run = static_cast<int>(program.run_points.size()) - 1;
  muscle.constant_m = static_cast<float>(constant_m);
  program.muscles.push_back(muscle);
}

GridPoint atTwist(const SplitPoint& point, const Eigen::Matrix3d& twist) {
  GridPoint g{};
  g.kind = point.has_radius                      ? GridPoint::WithRadius
           : point.has_fixed && point.has_moving ? GridPoint::Mixed
           : point.has_moving                    ? GridPoint::Moving
                                                 : GridPoint::Fixed;
  const Eigen::Vector3d m = twist * point.m;
  for (int i = 0; i < 3; ++i) {
    g.f[i] = static_cast<float>(point.f[i]);
    g.m[i] = static_cast<float>(m[i]);
    g.n[i] = static_cast<float>(point.n[i]);
  }
  return g;
}

/// Entry of one direction in a table of blocks.
void setDirection(FloatTable& table, std::size_t direction, const Eigen::Matrix3d& R) {
  constexpr std::size_t kBlock = GridView::kBlock;
  float* first = table.data() + direction / kBlock * 9 * kBlock + direction % kBlock;
  for (int i = 0; i < 9; ++i) first[static_cast<std::size_t>(i) * kBlock] = static_cast<float>(R(i / 3, i % 3));
}

/// Rotation of the radius in J while the wrist has the rotation R: 90 degrees and the twist of R about the axis. With
/// quaternion (w, v), s = v . axis: tan(twist / 2) = s / w, and w^2 + s^2 = (1 + axis . R axis) / 2.
Eigen::Matrix3d radiusRotation(const Eigen::Matrix3d& R_JU, const Eigen::Vector3d& axis, const Eigen::Matrix3d& R) {
  const Eigen::Vector3d axial{R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1)};
  const double twist = std::atan2(axis.dot(axial), R.trace() - axis.dot(R * axis));
  return R_JU * rotationAbout<double>(axis, std::numbers::pi / 2 + twist);
}

void setRadius(const Skeleton& skeleton, int joint, const PointSplitter& splitter, const Eigen::Matrix3d& twist,
               const JointGrid& grid, FloatTable& table) {
  const auto driver = std::ranges::find(skeleton.radii, joint, &RadiusDriver::wrist_joint);
  require(driver != skeleton.radii.end(), "a radius turns with this joint");
  for (std::size_t d = 0; d < grid.swings.size(); ++d)
    setDirection(table, d, radiusRotation(splitter.R_JS(driver->ulna), driver->axis_U, grid.swings[d] * twist));
}

}  // namespace

std::vector<JointMotionKind> motionsWithJoint(const Skeleton& skeleton, int joint) {
  std::vector<JointMotionKind> motions(skeleton.segments.size(), JointMotionKind::Fixed);
  motions[skeleton.joints[joint].child] = JointMotionKind::WithChild;
  for (const Joint& next : skeleton.joints)
    if (next.parent >= 0 && motions[next.parent] != JointMotionKind::Fixed)
      motions[next.child] = motions[next.parent];
  for (const auto& d : skeleton.patellae) motions[d.segment] = motions[d.femur];
  for (const auto& d : skeleton.radii)
    motions[d.segment] = d.wrist_joint == joint ? JointMotionKind::WithRadius : motions[d.ulna];
  return motions;
}

std::vector<GridVerdict> judgeGrid(const Skeleton& skeleton, const Musculature& musculature,
                                   std::span<const int> units, int joint, const Posture& held, const JointGrid& grid,
                                   Isa isa) {
  const std::size_t directions = grid.swings.size();
  require(directions % GridView::kBlock == 0, "judgeGrid: swings in blocks of 16");
  const PointSplitter splitter{skeleton, joint, held};
  GridProgram program;
  for (const int u : units) addUnit(splitter, musculature.units[u], program);
  program.has_radius = std::ranges::any_of(program.points, &SplitPoint::has_radius);
  FloatTable R(9 * directions), Q(program.has_radius ? 9 * directions : 0);
  for (std::size_t d = 0; d < directions; ++d) setDirection(R, d, grid.swings[d]);
  std::vector<GridPoint> points(program.points.size());
  std::vector<GridVerdict> verdicts(grid.twists.size() * directions);
  for (std::size_t t = 0; t < grid.twists.size(); ++t) {
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = atTwist(program.points[i], grid.twists[t]);
    if (program.has_radius) setRadius(skeleton, joint, splitter, grid.twists[t], grid, Q);
    const GridView view{static_cast<int>(directions),
                        R.data(),
                        program.has_radius ? Q.data() : nullptr,
                        program.run_points.data(),
                        points.data(),
                        program.muscles.data(),
                        static_cast<int>(program.muscles.size())};
    kernels(isa).grid(view, reinterpret_cast<std::uint8_t*>(verdicts.data() + t * directions));
    // Who forbade most so far is asked first at the next twist.
    std::ranges::stable_sort(program.muscles, std::greater{}, &GridMuscle::failures);
  }
  return verdicts;
}

}  // namespace sinew
