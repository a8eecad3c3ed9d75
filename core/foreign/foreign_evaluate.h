#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/foreign/foreign_kinematics.h"
#include "core/posture/evaluate.h"

namespace sinew {

// What `sinew evaluate` and `sinew curve` show, for a foreign model. Forces by our Hill curves (core/muscle/hill.h)
// with the file's parameters. Vectors by coordinate follow ForeignModel::coordinates.

/// Lengths, moment arms, fibres, passive forces and torques; structure torques are those of the coordinates' forces.
/// The fields about validity, margins and envelope are not filled: a foreign model has no such limits.
PostureEvaluation evaluatePosture(const ForeignModel& model, const ForeignPosture& posture);

struct NamedForeignPosture {
  std::string name;
  ForeignPosture posture;
};
/// The postures file of loadPostures() (core/skeleton/posture_file.h) for a foreign model: degrees, metres; what is
/// not named is at its default.
/// @throws InputError naming file, entry, expected and found; also for a coordinate that follows others.
std::vector<NamedForeignPosture> loadForeignPostures(const std::filesystem::path& file, const ForeignModel& model);

/// One turning coordinate from end to end of its range, or "COORDINATE=FROM:TO" in degrees; the others at their
/// defaults. JointMotion::other_posture_deg is empty, `joint` the joint that owns the coordinate.
/// @throws InputError for an unknown or shifting coordinate, one that follows others, an empty range.
JointMotion foreignMotion(const ForeignModel& model, const std::string& text);

/// @param samples at least 2 (a bug of the caller otherwise).
MotionCurve motionCurve(const ForeignModel& model, int unit, const JointMotion& motion, int samples = 101);

}  // namespace sinew
