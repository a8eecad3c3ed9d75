#pragma once
#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/view.h"
#include "core/skeleton/fit/fit_skeleton.h"

namespace sinew {

/// A pair of views of the study.
struct StudyRig {
  std::string name;
  std::vector<View> views;
  bool simultaneous = false;
};
StudyRig coneBeamRig();
StudyRig slotScanRig();

/// What goes wrong between the body and the picks, and what the fit is told of it. All is drawn anew for every body.
struct Disturbance {
  std::string name;
  double pick_mm = 1;         ///< SD of every pick, in the plane of the body, stated to the fit
  double definition_mm = 0;   ///< SD of a displacement of every landmark along each axis, the same in both views
  double protocol_share = 0;  ///< the same with the protocol's own covariances, times this
  double yaw_deg = 0;         ///< of the patient before the second view, to either side
  std::array<double, 3> sway_mm{};  ///< of the patient before the second view: forwards, up, to the right
  double knees_deg = 0;             ///< further flexion of both knees before the second view
  bool feet_stay = false;  ///< hips and ankles follow half, so that the feet stay; otherwise the shanks swing back
  double k1 = 0;           ///< radial distortion of both films, of either sign, that the fit's views lack
  std::array<double, 2> distance_error{};  ///< relative error of the distance to the body, alike in both views: from,
                                           ///< to, of either sign
  double frame_error_mm = 0, frame_error_deg = 0;  ///< SD of shifts and turns of every view by itself
  bool nominal = false;  ///< what the fit is told of the geometry: nominal, otherwise calibrated with beads
  bool exact = false;    ///< the fit is told that views and landmarks are exact, and taken at one instant
};

/// The rows that docs/validation.md is about, and others, never looked at while the priors were chosen.
std::vector<Disturbance> requiredDisturbances();
std::vector<Disturbance> furtherDisturbances();

/// One line of the accuracy table: errors of a figure over all drawn bodies, both sides together.
struct AccuracyRow {
  std::string quantity, unit;
  int determined = 0, undetermined = 0;  ///< undetermined figures are counted, not judged
  double bias = 0, sd = 0, max = 0;      ///< of estimate minus truth; max of its absolute value
  double half_width95 = 0;               ///< mean half width of the stated interval
  double coverage = 0;                   ///< share of the intervals that hold the truth
};

struct AccuracyStudy {
  std::vector<AccuracyRow> rows;
  int bodies = 0, not_converged = 0;
  int joint_warnings = 0, movement_warnings = 0, outlier_warnings = 0;  ///< bodies with such a warning
  double median_ms = 0;                                                 ///< processor time of one fit
  double pick_scale = 0, definition_scale = 0, blur_mm = 0;             ///< medians of the estimates

  const AccuracyRow& row(const std::string& quantity) const;
  double coverage() const;  ///< of all figures together
};

/// Draws `bodies` bodies and standing postures from the population, seeds first_seed, first_seed + 1 ..., projects
/// the landmarks of the picking protocol with the disturbance, fits, and compares every figure with the truth of the
/// first exposure. Deterministic, whatever the number of threads.
AccuracyStudy studyAccuracy(const std::filesystem::path& resource_dir, const StudyRig& rig,
                            const Disturbance& disturbance, int first_seed, int bodies);

}  // namespace sinew
