#include "clinical/synthetic/synthetic_patient.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/angle.h"
#include "core/skeleton/clinical_angles.h"
#include "core/skeleton/fit/landmark_protocol.h"
#include "core/skeleton/shape/population.h"

namespace sinew {
namespace {

constexpr double kCommonVariance = 0.9;  ///< share of a parameter's variance that both sides have in common
constexpr double kSoleThickness_m = 0.008;

/// "femur_r.torsion" and "femur_l.torsion" -> "femur.torsion".
std::string withoutSideOf(const std::string& parameter) {
  const auto dot = parameter.find('.');
  return std::string{withoutSide(std::string_view{parameter}.substr(0, dot))} + parameter.substr(dot);
}

using Degrees = std::map<std::string, double>;

/// Where a person puts his feet.
struct Stance {
  double half_width_m = 0;                    ///< of each ankle from the middle of the pelvis
  std::map<std::string, double> toe_out_deg;  ///< by side
};

/// Turns hips and ankles so that the feet stand where `stance` says, flat: a few steps of a fixed-point iteration,
/// each correcting every angle by what it alone would have to.
Posture withFeetPlaced(const Skeleton& skeleton, const Stance& stance, Degrees& degrees) {
  for (int pass = 0;; ++pass) {
    const Posture q = postureFromDegrees(skeleton, degrees);
    if (pass == 6) return q;
    const auto X_WB = segmentPoses(skeleton, q);
    for (const std::string side : {"r", "l"}) {
      const double out = side == "l" ? -1 : 1;  // away from the midline, along Z
      const RigidTransform& X_WF = X_WB[std::size_t(skeleton.segmentIndex("foot_" + side))];
      const Eigen::Vector3d p_WH = X_WB[std::size_t(skeleton.segmentIndex("femur_" + side))].translation();
      const double leg_m = (p_WH - X_WF.translation()).norm();
      const Eigen::Matrix3d R = X_WF.linear();
      const double aside_m = out * (X_WF.translation().z() - X_WB[0].translation().z()) - stance.half_width_m;
      degrees["hip_adduction_" + side] += aside_m / leg_m / kRadPerDeg;
      degrees["hip_internal_rotation_" + side] +=
          out * std::atan2(R(2, 0), R(0, 0)) / kRadPerDeg - stance.toe_out_deg.at(side);
      degrees["ankle_dorsiflexion_" + side] -= std::asin(R(1, 0)) / kRadPerDeg;
      degrees["ankle_inversion_" + side] += out * std::asin(R(1, 2)) / kRadPerDeg;
    }
  }
}

/// What moves the feet, heel to toe, to the middle of the lateral film without taking the pelvis to its edge.
double centringShift_m(const Skeleton& skeleton, const Posture& q) {
  constexpr double kMost_m = 0.055, kToesBeyondJoints_m = 0.03;
  const auto X_WB = segmentPoses(skeleton, q);
  double rear = 1e9, front = -1e9;
  for (const auto& landmark : skeleton.landmarks)
    if (skeleton.segments[std::size_t(landmark.segment)].name.starts_with("foot")) {
      const double x = (X_WB[std::size_t(landmark.segment)] * landmark.p_BL).x();
      rear = std::min(rear, x);
      front = std::max(front, x);
    }
  return std::clamp(-(rear + front + kToesBeyondJoints_m) / 2, -kMost_m, kMost_m);
}

double lowestPoint_m(const Skeleton& skeleton, const Posture& q, const std::string& foot) {
  const int segment = skeleton.segmentIndex(foot);
  const RigidTransform X_WB = segmentPoses(skeleton, q)[std::size_t(segment)];
  double lowest = X_WB.translation().y();
  for (const auto& landmark : skeleton.landmarks)
    if (landmark.segment == segment) lowest = std::min(lowest, (X_WB * landmark.p_BL).y());
  return lowest;
}

/// Sets the obliquity of the pelvis to what brings both soles to one height, by bisection.
Posture withSolesLevel(const Skeleton& skeleton, const Stance& stance, Degrees& degrees) {
  double low = -20, high = 20;  // the right side drops as the list grows
  for (int i = 0; i < 22; ++i) {
    degrees["pelvis_list"] = (low + high) / 2;
    const Posture q = withFeetPlaced(skeleton, stance, degrees);
    const bool right_is_lower = lowestPoint_m(skeleton, q, "foot_r") < lowestPoint_m(skeleton, q, "foot_l");
    (right_is_lower ? high : low) = degrees["pelvis_list"];
  }
  return postureFromDegrees(skeleton, degrees);
}

/// Whether the protocol asks for the landmark in a view of this role: what lies half way between shows both.
bool isAskedFor(const ProtocolLandmark& wanted, ViewRole role) {
  constexpr int kFrontal = 0, kLateral = 1;
  if (!isFrontal(role) && !isLateral(role)) return !wanted.views.empty();
  return std::ranges::find(wanted.views, isFrontal(role) ? kFrontal : kLateral) != wanted.views.end();
}

/// Pixels per metre at `p_W`, in the plane across the beam: the mean over both image axes.
double magnification_px_per_m(const View& view, const Eigen::Vector3d& p_W) {
  constexpr double kStep_m = 1e-3;
  double sum = 0;
  for (const int axis : {0, 1}) {
    const Eigen::Vector3d across = view.R_CW.row(axis);
    sum += (*project(view, Eigen::Vector3d{p_W + kStep_m * across}) - *project(view, p_W)).norm() / kStep_m;
  }
  return sum / 2;
}

}  // namespace

ShapeParameters drawPatientShape(const std::vector<ShapePrior>& priors, RandomSource& random) {
  const auto& names = shapeParameterNames();
  std::vector<double> values = toVector(ShapeParameters{});
  std::map<std::string, double> common;
  for (const auto& prior : priors) {
    const auto at = std::find(names.begin(), names.end(), prior.parameter);
    if (at == names.end() || prior.deformity) continue;
    const auto [entry, is_new] = common.try_emplace(withoutSideOf(prior.parameter), 0.0);
    if (is_new) entry->second = random.truncatedNormal();
    const bool sided = entry->first != prior.parameter;
    const double own = random.truncatedNormal();
    const double z = sided ? std::sqrt(kCommonVariance) * entry->second + std::sqrt(1 - kCommonVariance) * own : own;
    values[std::size_t(at - names.begin())] = prior.mean + prior.sd * std::clamp(z, -2.0, 2.0);
  }
  const double size = 0.94 + 0.05 * random.truncatedNormal();
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!isShapeAngle(names[i])) values[i] *= size;
  return shapeFromVector(values);
}

Posture drawPatientPosture(const Skeleton& skeleton, double floor_m, RandomSource& random) {
  Degrees degrees;
  Stance stance;
  stance.half_width_m = 0.068 + 0.006 * random.truncatedNormal();
  const std::string front = random.uniform() < 0.5 ? "r" : "l";
  for (const std::string side : {"r", "l"}) {
    const double knee = random.uniform(2, 12);
    degrees["knee_flexion_" + side] = knee;
    degrees["hip_flexion_" + side] = knee / 2 + (side == front ? 3.5 : -2.5) + random.truncatedNormal();
    stance.toe_out_deg[side] = 7 + 4 * random.truncatedNormal();
    // Hands at the shoulders: the forearms stay clear of the pelvis in both views.
    degrees["shoulder_flexion_" + side] = 42;
    degrees["shoulder_adduction_" + side] = -8;
    degrees["elbow_flexion_" + side] = 132;
  }
  degrees["pelvis_tilt"] = 3 * random.truncatedNormal();
  degrees["pelvis_rotation"] = 4 * random.truncatedNormal();
  degrees["pelvis_tz"] = 0.006 * random.truncatedNormal();

  const Posture q = withSolesLevel(skeleton, stance, degrees);
  const double lowest = std::min(lowestPoint_m(skeleton, q, "foot_r"), lowestPoint_m(skeleton, q, "foot_l"));
  degrees["pelvis_ty"] = floor_m + kSoleThickness_m - lowest;
  degrees["pelvis_tx"] = centringShift_m(skeleton, q);
  return postureFromDegrees(skeleton, degrees);
}

std::vector<Sighting> drawSightings(const Skeleton& skeleton, const Posture& posture, const BiplanarRig& rig,
                                    const std::filesystem::path& resource_dir, double noise_mm,
                                    RandomSource& random) {
  constexpr double kBorder_px = 20;  // the shutter and a little
  const auto X_WB = segmentPoses(skeleton, posture);
  std::vector<Sighting> sightings;
  for (const auto& wanted : loadLandmarkProtocol(resource_dir)) {
    const Landmark& landmark = skeleton.landmark(wanted.name);
    const Eigen::Vector3d p_W = X_WB[std::size_t(landmark.segment)] * landmark.p_BL;
    for (int i = 0; i < int(rig.views.size()); ++i) {
      const RigView& view = rig.views[std::size_t(i)];
      if (!isAskedFor(wanted, view.role)) continue;
      const Eigen::Vector2d noise{random.normal(), random.normal()};  // drawn also if not seen: others stay the same
      const auto uv_px = project(view, p_W);
      if (!uv_px || std::min({uv_px->x(), uv_px->y(), view.width_px - 1 - uv_px->x(),
                              view.height_px - 1 - uv_px->y()}) < kBorder_px)
        continue;
      const double px_per_mm = 1e-3 * magnification_px_per_m(view, p_W);
      sightings.push_back(
          {wanted.name, i, *uv_px + noise_mm * px_per_mm * noise, std::max(noise_mm, 0.02) * px_per_mm});
    }
  }
  return sightings;
}

}  // namespace sinew
