#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "imaging/calibration/calibrate.h"

namespace sinew {

// Steps of a bead calibration; included by the .cpp files of the calibration and by tests.

constexpr int kMinBeads = 8;  ///< in each view: 9 unknowns, 16 numbers
constexpr double kMinFlatness =
    0.03;  ///< least over largest extent; below, focal length and distance trade off freely

/// Least over largest singular value of the centred points: 0 for points in a plane.
double flatness(const std::vector<Eigen::Vector3d>& points);

/// One bead seen in one view.
struct BeadObservation {
  int bead = 0;  ///< index in the object
  int view = 0;
  Eigen::Vector2d uv_px;
  double sigma_px = 0.05;
  int detection = -1;  ///< index in the list of detections, if it came from there
};

/// Names detections: which are which beads, for a pose within reach of `guess`. Also improves the guess.
struct BeadMatch {
  std::vector<std::pair<int, int>> pairs;  ///< bead, detection
  View view;                               ///< the improved guess
};
/// @returns nullopt if no pose explains at least kMinBeads detections.
std::optional<BeadMatch> matchBeads(const CalibrationObject& object, const std::vector<DetectedBead>& detected,
                                    const View& guess, const Job& job);

/// Pinhole view through the direct linear transformation (Hartley & Zisserman 2003, sec. 7.1) of >= 6 points that
/// fill a volume. A mirrored image gives a left-handed view. @returns nullopt if they do not determine it.
std::optional<View> viewFromDlt(const std::vector<Eigen::Vector3d>& points_W,
                                const std::vector<Eigen::Vector2d>& uv_px);

/// All views refined together with the bead positions.
struct RefinedViews {
  Outcome outcome = Outcome::NotRun;
  std::vector<View> views;
  std::vector<Eigen::Vector2d> residual_px;  ///< of every observation, observed minus projected
  double rms_px = 0;
  double accuracy_mm = 0;
  double focal_length_error = 0;  ///< largest relative standard error of the focal lengths
};
RefinedViews refineViews(const CalibrationObject& object, const std::vector<BeadObservation>& observations,
                         const std::vector<View>& start, const CalibrationOptions& options, const Job& job);

}  // namespace sinew
