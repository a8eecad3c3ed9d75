#pragma once
#include <Eigen/Core>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/job.h"
#include "imaging/calibration/calibration_object.h"
#include "imaging/calibration/detect_beads.h"
#include "imaging/rig/biplanar_rig.h"
#include "imaging/rig/sighting.h"

namespace sinew {

/// Which terms of a view's distortion are unknowns. The others stay as the guess has them: zero for named sightings.
enum class EstimatedDistortion { None, FirstRadial, Full };

struct CalibrationOptions {
  bool patient_aligned = true;  ///< the object's frame is the patient's
  /// FirstRadial (k1) or Full (k1, k2, p1, p2, k3) for image intensifiers; flat panels have none.
  EstimatedDistortion estimate_distortion = EstimatedDistortion::None;
  double bead_position_sigma_mm = 0.05;  ///< how well the beads' places are known
  int max_iterations = 100;
};

/// One bead in one view after the calibration.
struct BeadResidual {
  std::string bead;
  int view = 0;
  Eigen::Vector2d residual_px;  ///< observed minus projected
};

struct BeadCalibration {
  Outcome outcome = Outcome::NotRun;
  BiplanarRig rig;  ///< method "bead_phantom", with rms_px and accuracy_mm; empty unless converged
  double rms_px = std::numeric_limits<double>::quiet_NaN();
  double accuracy_mm =
      std::numeric_limits<double>::quiet_NaN();            ///< RMS error of a point seen as sharply as the beads
  std::vector<BeadResidual> residuals;                     ///< worst first
  std::vector<std::vector<std::string>> unmatched_beads;   ///< by view, of the object: not seen in it
  std::vector<std::vector<Eigen::Vector2d>> unmatched_px;  ///< by view: detections that are no bead, or were outliers
};

/// Two or more cone-beam views from detected, unnamed beads. `guess` says roughly how the views were taken
/// (rigFromDicom(): distances, viewing directions, image sizes); the object may stand up to about 0.15 m and 10 deg
/// from where that assumes. Beads are named by a search over poses that explain the most detections (coded diameters
/// first), so that missing and spurious ones do no harm; then bundle adjustment of all views: focal length,
/// principal point, pose, bead positions within their tolerance (Hartley & Zisserman 2003, ch. 7 and 18).
/// Roles and exposures are the guess's. @pre one list of detections for every view of the guess.
/// @throws InputError if fewer than 8 beads can be named in a view, or they do not determine the geometry.
BeadCalibration calibrateFromBeads(const CalibrationObject& object,
                                   std::span<const std::vector<DetectedBead>> detected, const BiplanarRig& guess,
                                   const CalibrationOptions& options = {}, const Job& job = {});

/// The same from named sightings (picked by a person, name = bead). Starts from the direct linear transformation, so
/// it needs no guess but the image sizes (width, height) [px], one a view. Every view is an exposure of its own; its
/// role is read off the beam if the object's frame is the patient's.
BeadCalibration calibrateFromSightings(const CalibrationObject& object, std::span<const Sighting> sightings,
                                       std::span<const Eigen::Vector2i> image_sizes_px,
                                       const CalibrationOptions& options = {}, const Job& job = {});

}  // namespace sinew
