#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace sinew {

/// A landmark that a reader is asked to pick, and how.
struct ProtocolLandmark {
  std::string name;        ///< of the skeleton: "femoral_head_center_r"
  std::string title;       ///< "Right femoral head, centre"
  std::string group;       ///< "Pelvis", "Right femur", ...
  std::vector<int> views;  ///< where it can be seen: 0 = frontal, 1 = lateral
  std::string hint;        ///< how to place it
};

/// The landmarks that make every figure of the lower limbs and the pelvis determined, in the order of picking:
/// pelvis, right leg from hip to foot, left leg. Reads clinical/landmark_protocol.json (views 1 and 2 there).
/// @throws InputError naming file and entry.
std::vector<ProtocolLandmark> loadLandmarkProtocol(const std::filesystem::path& resource_dir);

}  // namespace sinew
