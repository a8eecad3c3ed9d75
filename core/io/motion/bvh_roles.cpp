#include "core/io/motion/bvh_roles_internal.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {

const std::vector<BvhRole>& bvhRoles() {
  static const std::vector<BvhRole> all = [] {
    std::vector<BvhRole> list{{"pelvis", {"Hips", "Hip", "Pelvis"}, 1, true},
                              {"lumbar", {"LowerBack", "Spine", "Abdomen"}, 0.4, false},
                              {"thorax", {"Spine3", "Spine2", "Spine1", "Chest", "Thorax", "Spine"}, 1, true},
                              {"neck", {"Neck", "Neck1"}, 0.3, false},
                              {"head", {"Head"}, 0.7, false}};
    for (const bool left : {false, true}) {
      const auto named = [&](std::initializer_list<const char*> names) {
        std::vector<std::string> result;
        for (const char* name : names) result.push_back((left ? "Left" : "Right") + std::string{name});
        return result;
      };
      const auto segment = [&](const char* right, const char* l) { return left ? l : right; };
      list.push_back({segment("scapula_r", "scapula_l"), named({"Shoulder", "Collar"}), 0.5, false});
      list.push_back({segment("humerus_r", "humerus_l"), named({"Arm", "UpArm", "UpperArm"}), 0.1, true});
      list.push_back({segment("ulna_r", "ulna_l"), named({"ForeArm", "LowArm", "Elbow"}), 0.05, true});
      list.push_back({segment("hand_r", "hand_l"), named({"Hand", "Wrist"}), 0.5, true});
      list.push_back({segment("femur_r", "femur_l"), named({"UpLeg", "Thigh"}), 0.1, true});
      list.push_back({segment("tibia_r", "tibia_l"), named({"Leg", "LowLeg", "Shin", "Knee"}), 0.1, true});
      list.push_back({segment("foot_r", "foot_l"), named({"Foot", "Ankle"}), 0.7, true});
    }
    return list;
  }();
  return all;
}

Posture restOfRigs(const Skeleton& skeleton) {
  return postureFromDegrees(skeleton, {{"shoulder_adduction_r", -90}, {"shoulder_adduction_l", -90}});
}

}  // namespace sinew
