#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/model/model.h"

namespace sinew {

// Which orientations of one ball joint a body can take: the map of Ryu et al. (ROM Construction), 18 x 36 x 36 cells.
// An orientation is a twist about the bone's shaft followed by the shortest turn (swing) that takes the shaft to a
// direction: R_JB = R_swing R_twist. A cell stands for the orientation at its middle.

/// Axes of the map of one joint, in the joint frame J of the zero posture.
struct RomMapFrame {
  Eigen::Vector3d shaft_J;    ///< unit; from the joint centre along the child's bone, in the zero posture: the pole
  Eigen::Vector3d forward_J;  ///< unit, normal to the shaft: azimuth 0
};

/// Cells in the order [twist][polar][azimuth]: polar angle from the resting shaft 0..180 deg, azimuth 0..360 deg
/// about it from `forward_J`, twist -180..180 deg.
struct RomMap {
  static constexpr int kTwists = 18, kPolars = 36, kAzimuths = 36;
  static constexpr int kCells = kTwists * kPolars * kAzimuths;

  std::string joint;  ///< "hip_r"
  RomMapFrame frame;
  std::vector<std::uint8_t> valid;  ///< kCells zeros and ones

  static constexpr int cell(int twist, int polar, int azimuth) {
    return (twist * kPolars + polar) * kAzimuths + azimuth;
  }
  static double twist_rad(int twist);
  Eigen::Vector3d direction_J(int polar, int azimuth) const;  ///< of the shaft, unit
  Eigen::Matrix3d swing_J(int polar, int azimuth) const;      ///< shortest turn that takes the shaft there
  Eigen::Matrix3d R_JB(int twist, int polar, int azimuth) const;

  int validCount() const;
  /// Valid twists in one direction: width of the coloured band in the paper's figure [rad], 0 if none.
  double twistWidth_rad(int polar, int azimuth) const;
};

/// Axes of the map of a ball joint.
RomMapFrame romMapFrame(const Skeleton& skeleton, int joint);

struct RomMapOptions {
  bool joint_limits = true;  ///< the joint's bony and ligament envelope counts too, not only the muscles
};

/// The map of a ball joint; all other coordinates stay as in `held`.
/// @throws InputError if the joint does not exist or is no ball joint.
RomMap romMap(const Model& model, const std::string& joint, const Posture& held, const RomMapOptions& options = {});

/// Cells that differ between two maps of one joint (Ryu et al.: error rate).
struct RomDifference {
  int only_first = 0, only_second = 0;  ///< valid in one map alone
  int either = 0;                       ///< valid in at least one
  int differing() const { return only_first + only_second; }
  double ofAll() const { return double(differing()) / RomMap::kCells; }
  double ofUnion() const { return either ? double(differing()) / either : 0; }
};
/// @throws InputError if the joints differ.
RomDifference compare(const RomMap& first, const RomMap& second);

}  // namespace sinew
