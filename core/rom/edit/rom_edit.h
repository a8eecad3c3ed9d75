#pragma once
#include <array>
#include <string>
#include <vector>

#include "core/skeleton/skeleton.h"

namespace sinew {

// What a person changes about the range of motion of one joint (Ryu et al., ROM Editing). Factors and shifts say what
// happens to the *range*: 0.63 is narrower, 10 degrees moves it up by ten. The transformation T of the paper acts on
// postures, V~(q) = V(T(q)), and so the other way round: T(theta) = s (theta - phi) + phi + t with s = 1 / factor and
// t = -shift / factor. Edits are values: a list of them composes, one after the other, each about the centre to which
// those before it have moved the range; they are compared and undone as values.

/// Turns the cone of a ball joint: where its middle goes.
struct RomTilt {
  /// "forward", "backward", "up", "down", "inward", "outward" (a midline joint: "right", "left"): the resting shaft
  /// turned that way. Or a coordinate of the joint without its side, "hip_flexion": about its axis, sign included.
  /// Names mean the same on either side of the body. Empty: about `axis_J`.
  std::string towards;
  std::array<double, 3> axis_J = {0, 0, 0};  ///< joint frame of the zero posture
  double angle_rad = 0;
  friend bool operator==(const RomTilt&, const RomTilt&) = default;
};

struct RomEdit {
  std::string joint;  ///< "hip_r", "knee_l"
  // Of a hinge.
  double range_factor = 1;  ///< width of the interval
  double shift_rad = 0;     ///< of the interval
  // Of a ball joint.
  double cone_factor = 1;      ///< angle between the directions of the shaft and the middle of their cone
  RomTilt tilt;                ///< of the cone, after it was scaled
  double twist_factor = 1;     ///< width of the twist's interval
  double twist_shift_rad = 0;  ///< positive: towards larger values of the coordinate about the shaft

  bool isIdentity() const;
  friend bool operator==(const RomEdit&, const RomEdit&) = default;
};
using RomEdits = std::vector<RomEdit>;

bool isIdentity(const RomEdits& edits);

inline constexpr double kLeastRomFactor = 0.05, kMostRomFactor = 5;

/// @throws InputError: an unknown joint (with the nearest names), a field of the other type of joint, a factor
/// outside kLeastRomFactor..kMostRomFactor, a shift or tilt beyond 180 degrees, a tilt that names nothing or turns
/// about the shaft. `where` starts the message: a file, a command.
void checkRomEdits(const Skeleton& skeleton, const RomEdits& edits, const std::string& where);

/// Rotation vector of a tilt in the joint frame. @throws InputError as checkRomEdits().
Eigen::Vector3d tiltVector_J(const Skeleton& skeleton, int joint, const RomTilt& tilt, const std::string& where);

/// +1 or -1: whether the coordinate that turns about the shaft grows with the twist (right-hand about the shaft).
int twistSign(const Skeleton& skeleton, int joint);

/// "hip_r: cone x 0.63, tilted 30 deg forward"
std::string inWords(const RomEdit& edit);

}  // namespace sinew
