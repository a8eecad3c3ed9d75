#include "core/skeleton/joint_motion.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/file.h"
#include "core/skeleton/clinical_angles.h"
#include "core/skeleton/mirrored_posture.h"
#include "core/strict_json.h"
#include "core/text.h"

namespace sinew {
namespace {

std::string ofSide(const std::string& name, char side) {
  std::string result = name;
  if (side == 'l' && name.ends_with("_r")) result.back() = 'l';
  return result;
}

JointMotion readMotion(const JsonReader& json, const Skeleton& skeleton, char side) {
  json.allowOnly({"name", "title", "joint", "coordinate", "start_deg", "end_deg", "other_posture_deg"});
  JointMotion motion{.name = ofSide(json["name"].text(), side),
                     .title = json["title"].text(),
                     .joint = ofSide(json["joint"].text(), side),
                     .coordinate = ofSide(json["coordinate"].text(), side),
                     .start_deg = json["start_deg"].numberIn(-180, 180),
                     .end_deg = json["end_deg"].numberIn(-180, 180),
                     .other_posture_deg = {}};
  if (const auto others = json.find("other_posture_deg"))
    for (const auto& [name, value] : others->members())
      motion.other_posture_deg[ofSide(name, side)] = value.numberIn(-180, 180);
  if (motion.start_deg == motion.end_deg) json["end_deg"].fail("another angle than start_deg");
  try {
    skeleton.coordinateIndex(motion.coordinate);
    for (const auto& [name, value] : motion.other_posture_deg) skeleton.coordinateIndex(name);
    skeleton.jointIndex(motion.joint);
  } catch (const InputError& error) {
    throw InputError{json.where() + ": " + json.path() + ": " + error.what()};
  }
  return motion;
}

}  // namespace

std::vector<JointMotion> loadJointMotions(const std::filesystem::path& resource_dir, const Skeleton& skeleton) {
  const auto file = resource_dir / "skeleton" / "joint_motions.json";
  const Json root = parseJson(readFile(file), file.filename().string());
  const JsonReader reader{root, file.filename().string()};
  reader.expectFormat("sinew.joint_motions", 1);
  std::vector<JointMotion> motions;
  for (const JsonReader& json : reader["motions"].items()) {
    for (const char side : {'r', 'l'}) {
      JointMotion motion = readMotion(json, skeleton, side);
      if (side == 'l' && !motion.name.ends_with("_l")) continue;  // midline
      for (const auto& other : motions)
        if (other.name == motion.name) json["name"].fail("a name of its own", "'" + motion.name + "' twice");
      motions.push_back(std::move(motion));
    }
  }
  return motions;
}

const JointMotion& findMotion(const std::vector<JointMotion>& motions, std::string_view name, char side) {
  std::vector<std::string> known;
  const JointMotion* without_side = nullptr;
  for (const JointMotion& motion : motions) {
    if (motion.name == name) return motion;
    const bool same = withoutSide(motion.name) == name || motion.title == name;
    const bool of_side = !motion.name.ends_with(side == 'l' ? "_r" : "_l");
    if (same && of_side && !without_side) without_side = &motion;
    known.push_back(motion.name);
  }
  if (without_side) return *without_side;
  throw InputError{"joint motion '" + std::string{name} + "' does not exist" + didYouMean(name, known)};
}

std::vector<int> mirrorMotions(const Skeleton& skeleton, const std::vector<JointMotion>& motions) {
  constexpr double kSame_rad = 1e-9;
  std::vector<std::array<Eigen::VectorXd, 2>> ends;
  for (const JointMotion& motion : motions)
    ends.push_back({clinicalFromPosture(skeleton, motionPosture(skeleton, motion, 0)),
                    clinicalFromPosture(skeleton, motionPosture(skeleton, motion, 1))});
  std::vector<int> mirror_of;
  for (const auto& [start, end] : ends) {
    const Eigen::VectorXd start_image = mirroredClinical(skeleton, start),
                          end_image = mirroredClinical(skeleton, end);
    const auto found = std::ranges::find_if(ends, [&](const auto& other) {
      return (other[0] - start_image).cwiseAbs().maxCoeff() < kSame_rad &&
             (other[1] - end_image).cwiseAbs().maxCoeff() < kSame_rad;
    });
    mirror_of.push_back(found == ends.end() ? -1 : static_cast<int>(found - ends.begin()));
  }
  return mirror_of;
}

Posture motionPosture(const Skeleton& skeleton, const JointMotion& motion, double theta) {
  auto coordinates_deg = motion.other_posture_deg;
  coordinates_deg[motion.coordinate] = motion.angle_deg(theta);
  return postureFromDegrees(skeleton, coordinates_deg);
}

}  // namespace sinew
