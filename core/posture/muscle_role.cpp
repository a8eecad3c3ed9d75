#include "core/posture/muscle_role.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/muscle/muscle_path.h"

namespace sinew {
namespace {

/// Motion of a segment with every coordinate that moves it.
std::map<int, Twist> motionsOf(const Kinematics& k, int segment) {
  std::map<int, Twist> by_coordinate;
  for (const auto& [coordinate, twist] : k.motions[std::size_t(segment)]) {
    Twist& sum = by_coordinate[coordinate];
    sum.w += twist.w;
    sum.v += twist.v;
  }
  return by_coordinate;
}

bool same(const Twist& a, const Twist& b) {
  constexpr double kRounding = 1e-12;
  return (a.w - b.w).norm() < kRounding && (a.v - b.v).norm() < kRounding;
}

}  // namespace

std::vector<int> spannedCoordinates(const MusculotendonUnit& unit, const Kinematics& clinical) {
  std::vector<int> segments;
  for (const auto& point : unit.path)
    for (const auto& anchor : point.anchors)
      if (anchor.weight > 0) segments.push_back(anchor.segment);
  std::ranges::sort(segments);
  segments.erase(std::unique(segments.begin(), segments.end()), segments.end());

  std::vector<int> spanned;
  std::vector<std::map<int, Twist>> motions;
  for (const int segment : segments) motions.push_back(motionsOf(clinical, segment));
  for (const auto& one : motions)
    for (const auto& [coordinate, twist] : one)
      for (const auto& other : motions) {
        const auto found = other.find(coordinate);
        if (found == other.end() || !same(found->second, twist)) {
          spanned.push_back(coordinate);
          break;
        }
      }
  std::ranges::sort(spanned);
  spanned.erase(std::unique(spanned.begin(), spanned.end()), spanned.end());
  return spanned;
}

std::vector<int> crossedJoints(const Skeleton& skeleton, const std::vector<int>& spanned) {
  std::vector<int> joints;
  for (const int coordinate : spanned) joints.push_back(skeleton.coordinates[std::size_t(coordinate)].joint);
  std::ranges::sort(joints);
  joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
  return joints;
}

std::vector<MuscleAction> muscleActions(const PostureEvaluation& evaluation, int unit, double least_arm_m) {
  std::vector<MuscleAction> actions;
  for (Eigen::Index c = 0; c < evaluation.moment_arm_m.cols(); ++c)
    if (const double arm_m = evaluation.moment_arm_m(unit, c); std::abs(arm_m) >= least_arm_m)
      actions.push_back({int(c), arm_m});
  std::ranges::stable_sort(actions, std::ranges::greater{}, [](const auto& a) { return std::abs(a.moment_arm_m); });
  return actions;
}

std::vector<MuscleFunction> muscleFunctions(const Skeleton& skeleton, const MusculotendonUnit& unit,
                                            const std::vector<JointMotion>& motions, double least_m) {
  const auto lengthAt = [&](const JointMotion& motion, double theta) {
    return pathLength(unit, segmentPoses(skeleton, motionPosture(skeleton, motion, theta)));
  };
  std::vector<MuscleFunction> functions;
  for (const auto& motion : motions)
    if (const double shortening_m = lengthAt(motion, 0) - lengthAt(motion, 1); shortening_m >= least_m)
      functions.push_back({&motion, shortening_m});
  std::ranges::stable_sort(functions, std::ranges::greater{}, &MuscleFunction::shortening_m);
  return functions;
}

std::vector<int> agonists(const PostureEvaluation& evaluation, int coordinate, bool increase, double least_arm_m) {
  std::vector<int> units;
  for (Eigen::Index i = 0; i < evaluation.moment_arm_m.rows(); ++i)
    if ((increase ? 1 : -1) * evaluation.moment_arm_m(i, coordinate) >= least_arm_m) units.push_back(int(i));
  return units;
}

}  // namespace sinew
