#pragma once
#include <array>
#include <filesystem>
#include <limits>
#include <span>
#include <string>

#include "core/error.h"
#include "core/geometry/view.h"

namespace sinew {

/// Where a geometry came from and how good it is.
struct CalibrationRecord {
  std::string method;  ///< "bead_phantom", "dicom_slot_scan", "dicom_nominal", "autoscoper", "mayacam", "json"
  std::string id;      ///< short hash of the geometry, printed in the report
  double rms_px = std::numeric_limits<double>::quiet_NaN();       ///< reprojection RMS of the calibration; NaN = none
  double accuracy_mm = std::numeric_limits<double>::quiet_NaN();  ///< estimated 3-D accuracy; NaN = unknown
  Warnings warnings;
  friend bool operator==(const CalibrationRecord& a, const CalibrationRecord& b) {
    return a.method == b.method && a.id == b.id && a.warnings == b.warnings;
  }
};

/// Two views of one patient in one world frame W. View 0 is frontal, view 1 lateral ("1" and "2" in files).
/// If `patient_aligned`, W is X anterior, Y up, Z right; otherwise W is the frame of the calibration (a biplane
/// laboratory, say).
struct BiplanarRig {
  std::array<View, 2> views;
  bool patient_aligned = true;
  CalibrationRecord calibration;
  friend bool operator==(const BiplanarRig&, const BiplanarRig&) = default;
};

/// Short hash of the geometry alone: the calibration id of the report.
std::string geometryId(const std::array<View, 2>& views);

/// Versioned JSON ("sinew.rig", version 1), units in the names. @throws InputError.
BiplanarRig loadRig(const std::filesystem::path& file);
void saveRig(const BiplanarRig& rig, const std::filesystem::path& file);

/// Autoscoper / MayaCam 2 text files, one a view: image size, camera matrix, rotation, translation in mm, x = K (R X
/// + t), origin top-left, y down. @throws InputError for a malformed file, a camera matrix or rotation that is none.
BiplanarRig importTextCalibration(std::span<const std::filesystem::path> files, const std::string& method);

/// Angle between the two viewing directions at the middle of the images [rad].
double angleBetweenViews_rad(const BiplanarRig& rig);

}  // namespace sinew
