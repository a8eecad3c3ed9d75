#pragma once
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

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

/// From where the X-rays pass through the patient. Lateral: the side that is at the detector.
enum class ViewRole { FrontalAP, FrontalPA, LateralLeft, LateralRight, Oblique, Other };
std::string nameOf(ViewRole role);  ///< "frontal_ap", ...: files
/// @throws InputError with the known names.
ViewRole roleFromName(std::string_view name);
bool isFrontal(ViewRole role);
bool isLateral(ViewRole role);
/// The role of a view in a patient's frame (X anterior, Z right), from its beam: within 30 deg of an axis frontal or
/// lateral, otherwise oblique.
ViewRole roleOfBeam(const View& view);

/// One view of a rig.
struct RigView : View {
  ViewRole role = ViewRole::Other;
  int exposure = 0;  ///< views of one number were taken at the same moment; between others the patient may have moved
  friend bool operator==(const RigView&, const RigView&) = default;
};

/// Two or more views of one patient in one world frame W; files count them from 1. Several may have one role: the
/// parts of a stitched pair, say. If `patient_aligned`, W is X anterior, Y up, Z right; otherwise W is the frame of
/// the calibration (a biplane laboratory, say).
struct BiplanarRig {
  std::vector<RigView> views = std::vector<RigView>(2);
  bool patient_aligned = true;
  CalibrationRecord calibration;
  friend bool operator==(const BiplanarRig&, const BiplanarRig&) = default;
};

/// More views than any examination has: a limit for files.
inline constexpr int kMaxViews = 32;

/// What people call a view: "Frontal", "Lateral", "Oblique", "View 3"; numbered where several share a role.
std::string viewTitle(std::span<const RigView> views, int view);

/// The projections alone, in the rig's order.
std::vector<View> projectionsOf(const BiplanarRig& rig);

/// Short hash of the geometry alone: the calibration id of the report.
std::string geometryId(std::span<const RigView> views);

/// Versioned JSON ("sinew.rig", version 1), units in the names. @throws InputError.
BiplanarRig loadRig(const std::filesystem::path& file);
void saveRig(const BiplanarRig& rig, const std::filesystem::path& file);

/// Autoscoper / MayaCam 2 text files, one a view, of one exposure: image size, camera matrix, rotation, translation
/// in mm, x = K (R X + t), origin top-left, y down. @throws InputError for fewer than two files, a malformed one, a
/// camera matrix or rotation that is none.
BiplanarRig importTextCalibration(std::span<const std::filesystem::path> files, const std::string& method);

/// Angle between the viewing directions at the middle of the images [rad], of the two views that are nearest to a
/// right angle: how well depth can be determined.
double angleBetweenViews_rad(const BiplanarRig& rig);

}  // namespace sinew
