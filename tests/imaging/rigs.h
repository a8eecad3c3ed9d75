#pragma once
#include <Eigen/Geometry>
#include <cmath>

#include "imaging/rig/biplanar_rig.h"
#include "imaging/rig/sighting.h"

namespace sinew::test {

/// Frontal (AP) and left lateral view of a patient, as rigFromDicom() defines their axes.
inline std::array<Eigen::Matrix3d, 2> frontalAndLateral() {
  Eigen::Matrix3d frontal, lateral;
  frontal << 0, 0, -1, 0, -1, 0, -1, 0, 0;
  lateral << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  return {frontal, lateral};
}

/// Two flat-panel views of a full lower limb, 1.8 m from source to detector, pixels of 0.3 mm.
inline BiplanarRig coneBeamRig() {
  const auto R = frontalAndLateral();
  BiplanarRig rig;
  for (std::size_t i = 0; i < 2; ++i)
    rig.views[i] = {View{ConeBeam{6000, 6000, 1000 + 13.0 * double(i), 2200 - 21.0 * double(i)},
                         R[i],
                         {0.01, -0.02, 1.4},
                         2000,
                         4400},
                    i == 0 ? ViewRole::FrontalAP : ViewRole::LateralLeft, int(i)};
  rig.calibration = {"json", geometryId(rig.views), 0.1, 0.2, {}};
  return rig;
}

inline BiplanarRig slotScanRig() {
  const auto R = frontalAndLateral();
  BiplanarRig rig;
  const double source_m[] = {0.987, 0.918};
  for (std::size_t i = 0; i < 2; ++i)
    rig.views[i] = {
        View{SlotScan{source_m[i], 0.000185, 0.000179, 900, 4000}, R[i], Eigen::Vector3d::Zero(), 1800, 8000},
        i == 0 ? ViewRole::FrontalAP : ViewRole::LateralLeft, 0};
  rig.calibration.method = "dicom_slot_scan";
  rig.calibration.id = geometryId(rig.views);
  return rig;
}

/// The cone-beam rig with a third view, turned by `turn_deg` about the vertical from the frontal one.
inline BiplanarRig threeViews(double turn_deg) {
  BiplanarRig rig = coneBeamRig();
  RigView third = rig.views[0];
  third.R_CW = third.R_CW * Eigen::AngleAxisd{turn_deg * M_PI / 180, Eigen::Vector3d::UnitY()}.toRotationMatrix();
  third.role = ViewRole::Oblique;
  third.exposure = 2;
  rig.views.push_back(third);
  rig.calibration.id = geometryId(rig.views);
  return rig;
}

inline Sighting see(const BiplanarRig& rig, int view, const Eigen::Vector3d& p_W, const std::string& name = "L") {
  return {name, view, project(rig.views[std::size_t(view)], p_W).value(), 1.0};
}

}  // namespace sinew::test
