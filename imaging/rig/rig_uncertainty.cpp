#include "imaging/rig/rig_uncertainty.h"

#include <cmath>

namespace sinew {
namespace {

constexpr double kDegree_rad = 0.017453292519943295;
constexpr double kUnknownAccuracy_mm = 0.5;

/// Pixels per millimetre at the world's origin, where calibrations place the patient.
double pixelsPerMillimetreAtOrigin(const View& view) {
  const double scale = pixelsPerMillimetre(view, Eigen::Vector3d::Zero());
  return std::isfinite(scale) ? scale : 1;
}

/// A calibration that places points to `accuracy_mm` over an object of about 0.3 m from its middle to its ends: that
/// error may be a shift of each image, a turn of it or a wrong scale.
GeometryUncertainty calibrated(const View& view, double accuracy_mm) {
  constexpr double kLever_mm = 300;
  return {.scale = accuracy_mm / kLever_mm,
          .image_shift_px = accuracy_mm * pixelsPerMillimetreAtOrigin(view),
          .turn_rad = accuracy_mm / kLever_mm};
}

/// Flat panels have no distortion and calibrations do not look for it unless asked to; what is left of an image
/// intensifier's, or of a plate scanned askew, is some tenths of a millimetre at the edge of a long film.
constexpr double kDistortionLeft_k1 = 0.02;

}  // namespace

GeometryUncertainty uncertaintyOf(const CalibrationRecord& calibration, const View& view) {
  if (calibration.method == "dicom_nominal") {
    constexpr double kTape_m = 0.02, kTape = 0.005, kCentring_mm = 5, kTurn_rad = 1 * kDegree_rad;
    return {.scale = kTape,
            .image_shift_px = kCentring_mm * pixelsPerMillimetreAtOrigin(view),
            .body_distance_m = kTape_m,
            .turn_rad = kTurn_rad,
            .common_distance_m = kObjectDepth_m / std::sqrt(12.0)};  // SD of even chances
  }
  if (calibration.method == "dicom_slot_scan") {
    constexpr double kScale = 0.002, kShift_mm = 0.3, kTurn_rad = 0.1 * kDegree_rad;
    return {.scale = kScale, .image_shift_px = kShift_mm * pixelsPerMillimetreAtOrigin(view), .turn_rad = kTurn_rad};
  }
  GeometryUncertainty uncertainty =
      calibrated(view, std::isfinite(calibration.accuracy_mm) ? calibration.accuracy_mm : kUnknownAccuracy_mm);
  const auto* cone = std::get_if<ConeBeam>(&view.projection);
  if (cone && cone->k1 == 0) uncertainty.k1 = kDistortionLeft_k1;
  return uncertainty;
}

bool isSimultaneous(const CalibrationRecord& calibration) {
  return calibration.method == "dicom_slot_scan" || calibration.method == "autoscoper" ||
         calibration.method == "mayacam";
}

}  // namespace sinew
