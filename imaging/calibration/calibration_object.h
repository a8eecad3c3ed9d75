#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace sinew {

/// One radio-opaque ball of a calibration object.
struct CalibrationBead {
  std::string name;
  Eigen::Vector3d p_WQ;   ///< its centre in the object's frame, which becomes the world frame [m]
  double diameter_m = 0;  ///< 0 = not known
  friend bool operator==(const CalibrationBead&, const CalibrationBead&) = default;
};

/// Beads of known position that are imaged in both views. If its frame is that of a patient who stands in its place
/// (X anterior, Y up, Z right), the calibrated rig is patient aligned.
struct CalibrationObject {
  std::string name;
  std::vector<CalibrationBead> beads;
  friend bool operator==(const CalibrationObject&, const CalibrationObject&) = default;
};

/// The phantom of the embedded demo: an acrylic frame of a full lower limb and pelvis, 0.40 x 1.12 x 0.50 m (X, Y, Z)
/// about the origin, with 24 beads of 4 mm and 8 of 8 mm diameter. No bead hides another one in a frontal or lateral
/// view, and no symmetry maps the object onto itself.
CalibrationObject defaultCalibrationObject();

/// CSV `name,x_mm,y_mm,z_mm[,diameter_mm]`. @throws InputError with file, line, field, expected, found; also if there
/// are fewer than 8 beads, a name or place occurs twice, or all beads lie in one plane.
CalibrationObject loadCalibrationObject(const std::filesystem::path& file);
void saveCalibrationObject(const CalibrationObject& object, const std::filesystem::path& file);

}  // namespace sinew
