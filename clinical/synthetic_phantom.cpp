#include <algorithm>

#include "clinical/synthetic_rig.h"

namespace sinew {

CalibrationObject syntheticPhantom() {
  CalibrationObject phantom = defaultCalibrationObject();
  const BiplanarRig rig = nominalRig(SyntheticRig::ConeBeam);
  constexpr double kMargin_px = 90;  // for the errors of the true rig
  const auto fits = [&](double x_scale, double z_scale) {
    return std::all_of(phantom.beads.begin(), phantom.beads.end(), [&](const CalibrationBead& bead) {
      const Eigen::Vector3d p_W{x_scale * bead.p_WQ.x(), bead.p_WQ.y(), z_scale * bead.p_WQ.z()};
      return std::all_of(rig.views.begin(), rig.views.end(), [&](const View& view) {
        const auto uv = project(view, p_W);
        return uv && std::min({uv->x(), uv->y(), view.width_px - uv->x(), view.height_px - uv->y()}) > kMargin_px;
      });
    });
  };
  double scale = 1;
  while (scale > 0.3 && !fits(scale, scale)) scale -= 0.01;
  for (auto& bead : phantom.beads) bead.p_WQ = Eigen::Vector3d{scale, 1, scale}.asDiagonal() * bead.p_WQ;
  if (scale < 1) phantom.name += "-narrow";
  return phantom;
}

}  // namespace sinew
