#pragma once
#include <Eigen/Core>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/geometry/view.h"
#include "core/job.h"
#include "core/skeleton/kinematics.h"
#include "core/skeleton/shape/shape.h"
#include "core/skeleton/shape/shape_priors.h"

namespace sinew {

/// One image point of one landmark, for the fit (imaging's Sighting, without its file form).
struct LandmarkObservation {
  std::string landmark;
  int view = 0;  ///< index into the views
  Eigen::Vector2d uv_px;
  double sigma_px = 1;
};

struct FitOptions {
  int max_iterations = 100;
  double robust_loss_sigma = 3;     ///< Huber: residuals beyond this many sigma count linearly
  double gross_error_sigma = 8;     ///< what lies farther out after that is left out, named, and fitted without
  double undetermined_ratio = 0.9;  ///< a parameter whose SD stays above this share of its prior is undetermined
};

struct LandmarkResidual {
  std::string landmark;
  int view = 0;
  Eigen::Vector2d residual_px;  ///< observed minus projected
  double sigmas = 0;
};

/// A clinical figure of the fitted skeleton with its 95 % interval.
struct BoneFigure {
  std::string quantity;  ///< "femur_length", "tibial_torsion", ...
  std::string side;      ///< "r", "l" or ""
  std::string unit;      ///< "mm" or "deg"
  double value = std::numeric_limits<double>::quiet_NaN();
  double lower95 = std::numeric_limits<double>::quiet_NaN(), upper95 = std::numeric_limits<double>::quiet_NaN();
  bool determined = false;  ///< false: the images do not say, the value is the prior's
};

struct SkeletonFit {
  Outcome outcome = Outcome::NotRun;
  ShapeParameters shape;
  Posture posture;
  std::vector<LandmarkResidual> residuals;
  double rms_px = std::numeric_limits<double>::quiet_NaN();
  std::vector<BoneFigure> figures;
  std::vector<std::string> undetermined;  ///< shape parameters and coordinates that stayed at the prior
  Warnings warnings;                      ///< worst offenders, unknown landmarks, ...
};

/// Shape and posture that explain the sightings in both views: non-linear least squares over every shape parameter
/// and coordinate that a landmark depends on; residuals in pixels / sigma, Huber loss, population priors, bounds;
/// covariance from the Jacobian at the solution (Laplace). @throws InputError if no landmark is known or none is
/// seen.
SkeletonFit fitSkeleton(const Skeleton& reference, std::span<const View> views,
                        std::span<const LandmarkObservation> observations, std::span<const ShapePrior> priors,
                        const FitOptions& options = {}, const Job& job = {});

/// The same clinical figures of a skeleton whose shape and posture are known (no intervals): the truth of a synthetic
/// patient, or a model file.
std::vector<BoneFigure> boneFigures(const Skeleton& reference, const ShapeParameters& shape, const Posture& posture);

}  // namespace sinew
