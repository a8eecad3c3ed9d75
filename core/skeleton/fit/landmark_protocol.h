#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "core/skeleton/fit/fit_skeleton.h"

namespace sinew {

/// A landmark that a reader is asked to pick, and how.
struct ProtocolLandmark {
  std::string name;        ///< of the skeleton: "femoral_head_center_r"
  std::string title;       ///< "Right femoral head, centre"
  std::string group;       ///< "Pelvis", "Right femur", ...
  std::vector<int> views;  ///< where it can be seen: 0 = frontal, 1 = lateral
  std::string hint;        ///< how to place it
  double pick_sd_mm = 1;   ///< noise of a pick at the body, along u and along v, independent in every view
  Eigen::Vector3d definition_sd_mm =
      Eigen::Vector3d::Zero();  ///< how readers differ in what it is, in its bone's axes
  std::string definition_source;
};

/// The landmarks that make every figure of the lower limbs and the pelvis determined, in the order of picking:
/// pelvis, right leg from hip to foot, left leg. Reads clinical/landmark_protocol.json (views 1 and 2 there).
/// @throws InputError naming file and entry.
std::vector<ProtocolLandmark> loadLandmarkProtocol(const std::filesystem::path& resource_dir);

/// What the fit must know of the protocol: how sharply its landmarks are defined.
std::vector<DefinitionError> definitionErrors(std::span<const ProtocolLandmark> protocol);

}  // namespace sinew
