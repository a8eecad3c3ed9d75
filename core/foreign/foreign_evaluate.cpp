#include "core/foreign/foreign_evaluate.h"

#include <algorithm>

#include "core/angle.h"
#include "core/muscle/hill.h"
#include "core/skeleton/posture_file.h"
#include "core/text.h"

namespace sinew {
namespace {

void refuseFollower(const ForeignModel& model, int coordinate) {
  const ForeignCoupling* coupling = model.couplingOf(coordinate);
  if (!coupling) return;
  throw InputError{{"model " + model.name, model.coordinates[static_cast<std::size_t>(coordinate)].name,
                    "a coordinate that moves by itself", "one that follows others ('" + coupling->name + "')"}};
}

}  // namespace

PostureEvaluation evaluatePosture(const ForeignModel& model, const ForeignPosture& posture) {
  PostureEvaluation e;
  e.length_m = foreignLengths(model, posture);
  e.moment_arm_m = foreignMomentArms(model, posture);
  e.structure_torque = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.coordinates.size()));
  for (const ForeignCoordinateForce& force : model.coordinate_forces)
    e.structure_torque[force.coordinate] += coordinateForce(force, posture[force.coordinate]);
  fillPassive(model.musculature, e);
  return e;
}

std::vector<NamedForeignPosture> loadForeignPostures(const std::filesystem::path& file, const ForeignModel& model) {
  std::vector<NamedForeignPosture> postures;
  readPostures(file, [&](const std::string& name, const std::map<std::string, double>& coordinates_deg) {
    ForeignPosture q = defaultPosture(model);
    for (const auto& [coordinate, value] : coordinates_deg) {
      const int i = model.coordinateIndex(coordinate);
      refuseFollower(model, i);
      q[i] = model.coordinates[static_cast<std::size_t>(i)].translational ? value : value * kRadPerDeg;
    }
    postures.push_back({name, coupledPosture(model, std::move(q))});
  });
  return postures;
}

JointMotion foreignMotion(const ForeignModel& model, const std::string& text) {
  const auto equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const int i = model.coordinateIndex(name);
  const ForeignCoordinate& c = model.coordinates[static_cast<std::size_t>(i)];
  refuseFollower(model, i);
  if (c.translational) throw InputError{{"model " + model.name, name, "a coordinate that turns", "one that shifts"}};
  JointMotion motion{.name = name, .title = name, .coordinate = name};
  motion.start_deg = c.min / kRadPerDeg;
  motion.end_deg = c.max / kRadPerDeg;
  for (const auto& joint : model.joints)
    if (std::ranges::find(joint.coordinates, i) != joint.coordinates.end()) motion.joint = joint.name;
  if (equals != std::string::npos) {
    const std::string range = text.substr(equals + 1);
    const auto colon = range.find(':');
    if (colon == std::string::npos)
      throw InputError{{"motion", name, "COORDINATE=FROM:TO in degrees", "'" + range + "'"}};
    motion.start_deg = parseNumber(range.substr(0, colon), "motion", name);
    motion.end_deg = parseNumber(range.substr(colon + 1), "motion", name);
  }
  if (motion.start_deg == motion.end_deg)
    throw InputError{
        {"model " + model.name, name, "a range of motion (COORDINATE=FROM:TO gives one)", "an empty one"}};
  return motion;
}

MotionCurve motionCurve(const ForeignModel& model, int unit, const JointMotion& motion, int samples) {
  require(samples >= 2, "motionCurve: at least two samples");
  const int coordinate = model.coordinateIndex(motion.coordinate);
  MotionCurve curve;
  for (int i = 0; i < samples; ++i) {
    const double theta = static_cast<double>(i) / (samples - 1);
    ForeignPosture q = defaultPosture(model);
    q[coordinate] = motion.angle_deg(theta) * kRadPerDeg;
    appendSample(model.musculature.units[static_cast<std::size_t>(unit)], theta, motion.angle_deg(theta),
                 foreignLength(model, unit, q), foreignMomentArm(model, unit, coordinate, q), curve);
  }
  return curve;
}

}  // namespace sinew
