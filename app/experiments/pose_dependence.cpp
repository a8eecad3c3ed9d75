#include "app/experiments/pose_dependence.h"

#include "core/posture/validity.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

double hipFlexion_deg(const Model& model, double knee_flexion_deg) {
  int flexion_deg = 0;
  for (; flexion_deg < 180; ++flexion_deg) {
    const Posture q = postureFromDegrees(
        model.skeleton, {{"knee_flexion_r", knee_flexion_deg}, {"hip_flexion_r", flexion_deg + 1.0}});
    if (!validity(model.skeleton, model.musculature, q).valid) break;
  }
  return flexion_deg;
}

}  // namespace

int forwardCount(const RomMap& map) {
  int count = 0;
  for (int polar = 0; polar < RomMap::kPolars; ++polar)
    for (int azimuth = 0; azimuth < RomMap::kAzimuths; ++azimuth) {
      if (map.direction_J(polar, azimuth).dot(map.frame.forward_J) <= 0) continue;
      for (int twist = 0; twist < RomMap::kTwists; ++twist) count += map.valid[RomMap::cell(twist, polar, azimuth)];
    }
  return count;
}

std::vector<PoseDependenceRow> poseDependence(const Model& model, const std::vector<double>& knee_flexions_deg) {
  std::vector<PoseDependenceRow> rows;
  for (const double knee_deg : knee_flexions_deg) {
    const Posture held = postureFromDegrees(model.skeleton, {{"knee_flexion_r", knee_deg}});
    rows.push_back({knee_deg, romMap(model, "hip_r", held, {.joint_limits = false}), romMap(model, "hip_r", held),
                    hipFlexion_deg(model, knee_deg)});
  }
  return rows;
}

}  // namespace sinew
