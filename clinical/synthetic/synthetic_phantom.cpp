#include <algorithm>

#include "clinical/synthetic/synthetic_rig.h"

namespace sinew {
namespace {

/// Shadow of a bead on a film.
struct Shadow {
  Eigen::Vector2d uv_px;
  double radius_px;
};

/// All beads are well inside the film and no two shadows come nearer than `clearance` times the sum of their radii:
/// the surroundings of a bead must be seen too.
bool isClear(const CalibrationObject& phantom, const View& view, double clearance) {
  constexpr double kMargin_px = 85;  // for what the true rig differs from the nominal one
  constexpr double kShift_px = 8;    // and for the parallax of that difference
  const double f_px = std::get<ConeBeam>(view.projection).fx_px;
  std::vector<Shadow> shadows;
  for (const auto& bead : phantom.beads) {
    const auto uv = project(view, bead.p_WQ);
    if (!uv || std::min({uv->x(), uv->y(), view.width_px - uv->x(), view.height_px - uv->y()}) < kMargin_px)
      return false;
    const double depth_m = (view.R_CW * bead.p_WQ + view.p_CW).z();
    const Shadow shadow{*uv, f_px * bead.diameter_m / 2 / depth_m};
    for (const auto& other : shadows)
      if ((other.uv_px - shadow.uv_px).norm() < clearance * (other.radius_px + shadow.radius_px) + kShift_px)
        return false;
    shadows.push_back(shadow);
  }
  return true;
}

}  // namespace

CalibrationObject syntheticPhantom() {
  const CalibrationObject original = defaultCalibrationObject();
  const BiplanarRig rig = nominalRig(SyntheticRig::ConeBeam);
  constexpr double kHeightScale = 0.93;  // with room for the magnification of its near side
  // Clear shadows first, then a wide object; the beads keep their order, so nothing else has to be checked.
  for (double clearance = 3; clearance > 1.2; clearance -= 0.2)
    for (double z_scale = 1; z_scale > 0.4; z_scale -= 0.01)
      for (double x_scale = std::min(1.0, z_scale + 0.2); x_scale > 0.4; x_scale -= 0.01) {
        CalibrationObject phantom = original;
        for (auto& bead : phantom.beads)
          bead.p_WQ = Eigen::Vector3d{x_scale, kHeightScale, z_scale}.asDiagonal() * bead.p_WQ;
        if (!isClear(phantom, rig.views[0], clearance) || !isClear(phantom, rig.views[1], clearance)) continue;
        phantom.name += "_narrow";
        return phantom;
      }
  require(false, "a bead phantom that fits the films");
  return original;
}

}  // namespace sinew
