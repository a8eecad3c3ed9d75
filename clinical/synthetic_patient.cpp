#include "clinical/synthetic_patient.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/skeleton/clinical_angles.h"
#include "core/skeleton/landmark_protocol.h"
#include "core/skeleton/population.h"

namespace sinew {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180;
constexpr double kCommonVariance = 0.9;  ///< share of a parameter's variance that both sides have in common
constexpr double kSoleThickness_m = 0.008;

/// "femur_r.torsion" and "femur_l.torsion" -> "femur.torsion".
std::string withoutSideOf(const std::string& parameter) {
  const auto dot = parameter.find('.');
  return std::string{withoutSide(std::string_view{parameter}.substr(0, dot))} + parameter.substr(dot);
}

using Degrees = std::map<std::string, double>;

/// Turns the ankles so that both feet lie flat.
Posture withFlatFeet(const Skeleton& skeleton, Degrees& degrees) {
  for (int pass = 0;; ++pass) {
    const Posture q = postureFromDegrees(skeleton, degrees);
    if (pass == 4) return q;
    const auto X_WB = segmentPoses(skeleton, q);
    for (const std::string side : {"r", "l"}) {
      const Eigen::Matrix3d R = X_WB[std::size_t(skeleton.segmentIndex("foot_" + side))].linear();
      degrees["ankle_dorsiflexion_" + side] -= std::asin(R(1, 0)) / kRadPerDeg;
      degrees["ankle_inversion_" + side] += (side == "l" ? -1 : 1) * std::asin(R(1, 2)) / kRadPerDeg;
    }
  }
}

double lowestPoint_m(const Skeleton& skeleton, const Posture& q, const std::string& foot) {
  const int segment = skeleton.segmentIndex(foot);
  const RigidTransform X_WB = segmentPoses(skeleton, q)[std::size_t(segment)];
  double lowest = X_WB.translation().y();
  for (const auto& landmark : skeleton.landmarks)
    if (landmark.segment == segment) lowest = std::min(lowest, (X_WB * landmark.p_BL).y());
  return lowest;
}

/// Drops the right side of the pelvis by `list_deg`; the thighs keep their direction.
Degrees withList(Degrees degrees, double list_deg) {
  degrees["pelvis_list"] += list_deg;
  degrees["hip_adduction_r"] -= list_deg;
  degrees["hip_adduction_l"] += list_deg;
  return degrees;
}

/// The obliquity of the pelvis that brings both soles to one height, by bisection.
double levellingList_deg(const Skeleton& skeleton, const Degrees& degrees) {
  double low = -20, high = 20;
  for (int i = 0; i < 22; ++i) {
    const double middle = (low + high) / 2;
    Degrees trial = withList(degrees, middle);
    const Posture q = withFlatFeet(skeleton, trial);
    const bool right_is_lower = lowestPoint_m(skeleton, q, "foot_r") < lowestPoint_m(skeleton, q, "foot_l");
    (right_is_lower ? high : low) = middle;
  }
  return (low + high) / 2;
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
    if (at == names.end()) continue;
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
  const std::string front = random.uniform() < 0.5 ? "r" : "l";
  for (const std::string side : {"r", "l"}) {
    const double knee = random.uniform(2, 12);
    degrees["knee_flexion_" + side] = knee;
    degrees["hip_flexion_" + side] = knee / 2 + (side == front ? 3.5 : -2.5) + random.truncatedNormal();
    degrees["hip_adduction_" + side] = -2 + 1.5 * random.truncatedNormal();
    degrees["hip_internal_rotation_" + side] = 5 * random.truncatedNormal();
    // Hands at the shoulders: the forearms stay clear of the pelvis in both views.
    degrees["shoulder_flexion_" + side] = 42;
    degrees["shoulder_adduction_" + side] = -8;
    degrees["elbow_flexion_" + side] = 132;
  }
  degrees["pelvis_tilt"] = 3 * random.truncatedNormal();
  degrees["pelvis_rotation"] = 4 * random.truncatedNormal();
  degrees["pelvis_tx"] = -0.035;  // the feet reach further forward than back
  degrees["pelvis_tz"] = 0.006 * random.truncatedNormal();

  degrees = withList(degrees, levellingList_deg(skeleton, degrees));
  const Posture q = withFlatFeet(skeleton, degrees);
  const double lowest = std::min(lowestPoint_m(skeleton, q, "foot_r"), lowestPoint_m(skeleton, q, "foot_l"));
  degrees["pelvis_ty"] = floor_m + kSoleThickness_m - lowest;
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
    for (const int i : wanted.views) {
      const View& view = rig.views[std::size_t(i)];
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
