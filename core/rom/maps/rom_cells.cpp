#include <algorithm>

#include "core/kernel/joint_grid.h"
#include "core/muscle/hill.h"
#include "core/muscle/muscle_path.h"
#include "core/posture/muscle_role.h"
#include "core/rom/maps/rom_cells_internal.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {

std::vector<int> unitsSpanning(const Skeleton& skeleton, const Musculature& musculature, int joint) {
  const auto motions = motionsWithJoint(skeleton, joint);
  std::vector<int> spanning;
  for (std::size_t u = 0; u < musculature.units.size(); ++u) {
    const auto& path = musculature.units[u].path;
    const auto first = motions[path.front().anchors.front().segment];
    const bool rigid = std::ranges::all_of(path, [&](const PathPoint& point) {
      return std::ranges::all_of(point.anchors, [&](const Anchor& a) { return motions[a.segment] == first; });
    });
    if (!rigid) spanning.push_back(static_cast<int>(u));
  }
  return spanning;
}

std::vector<int> unitsOverJoint(const Model& model, int joint) {
  if (model.skeleton.joints[joint].type == JointType::Ball)
    return unitsSpanning(model.skeleton, model.musculature, joint);
  const Kinematics k = clinicalKinematics(model.skeleton, zeroPosture(model.skeleton));
  std::vector<int> units;
  for (std::size_t u = 0; u < model.musculature.units.size(); ++u)
    if (std::ranges::count(spannedCoordinates(model.musculature.units[u], k),
                           model.skeleton.joints[joint].first_coordinate))
      units.push_back(static_cast<int>(u));
  return units;
}

CellJudge::CellJudge(const Model& model, int joint, const Posture& held)
    : model_{model},
      units_{unitsSpanning(model.skeleton, model.musculature, joint)},
      posture_{held},
      first_coordinate_{model.skeleton.joints[joint].first_coordinate} {}

bool CellJudge::allows(const Eigen::Matrix3d& R_JB) {
  posture_.segment<3>(first_coordinate_) = vectorFromRotation(R_JB);
  const auto X_WB = segmentPoses(model_.skeleton, posture_);
  return std::ranges::all_of(units_, [&](int u) {
    const MusculotendonUnit& unit = model_.musculature.units[u];
    return pathLength(unit, X_WB) <= longestLength_m(unit);
  });
}

std::vector<std::uint8_t> cellsWithinMuscles(const Model& model, int joint, const Posture& held, const RomMap& map) {
  std::vector<Eigen::Matrix3d> twists, swings;
  for (int t = 0; t < RomMap::kTwists; ++t)
    twists.push_back(rotationAbout<double>(map.frame.shaft_J, RomMap::twist_rad(t)));
  for (int p = 0; p < RomMap::kPolars; ++p)
    for (int a = 0; a < RomMap::kAzimuths; ++a) swings.push_back(map.swing_J(p, a));
  CellJudge judge{model, joint, held};
  const auto verdicts = judgeGrid(model.skeleton, model.musculature, judge.units(), joint, held, {twists, swings});
  std::vector<std::uint8_t> valid(RomMap::kCells);
  for (int i = 0; i < RomMap::kCells; ++i)
    valid[i] = verdicts[i] == GridVerdict::Close ? judge.allows(swings[i % swings.size()] * twists[i / swings.size()])
                                                 : verdicts[i] == GridVerdict::Allowed;
  return valid;
}

}  // namespace sinew
