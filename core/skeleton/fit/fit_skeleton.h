#pragma once
#include <Eigen/Core>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/job.h"
#include "core/skeleton/fit/bone_figure.h"
#include "core/skeleton/fit/fit_view.h"
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

/// How differently readers place one landmark on a bone, the same in every view that they pick it in: the covariance
/// of its place in the frame of its bone.
struct DefinitionError {
  std::string landmark;
  Eigen::Matrix3d covariance_B_m2 = Eigen::Matrix3d::Zero();
};

struct FitOptions {
  int max_iterations = 100;
  double robust_loss_sigma = 3;     ///< Huber: residuals beyond this many sigma count linearly
  double gross_error_sigma = 8;     ///< what lies farther out after that is left out, named, and fitted without
  double undetermined_ratio = 0.9;  ///< a parameter whose SD stays above this share of its prior is undetermined
  /// Landmarks that could still be picked (the protocol's): SkeletonFit::advice says which of them would help.
  std::vector<std::string> offered_landmarks;
  /// Beside the noise of each pick. Empty: landmarks are points that all readers agree on.
  std::vector<DefinitionError> definition_errors;
  MovementPrior movement;
};

struct LandmarkResidual {
  std::string landmark;
  int view = 0;
  Eigen::Vector2d residual_px;  ///< observed minus projected
  double sigmas = 0;            ///< its length over what pick and definition of the landmark let expect
};

/// How the patient moved between the first exposure and another. What is said with an interval of 95 % is an angle or
/// a distance, never below 0.
struct ExposureMovement {
  struct Amount {
    double value = 0, lower95 = 0, upper95 = 0;
  };
  struct JointChange {
    std::string joint;  ///< "knee_r"
    Amount turn_deg;
    bool moved = false;  ///< beyond doubt, and by more than anybody's standing
  };
  int exposure = 0;                 ///< of FitView::exposure
  Amount turn_deg;                  ///< of the whole body
  Amount sway_mm;                   ///< of the middle of what is seen of the body
  bool moved = false;               ///< certainly, and by more than half a degree or 2 mm
  std::vector<JointChange> joints;  ///< of the legs, right before left
};

/// How large the errors of the picks are, estimated from the residuals and used for the intervals.
struct PickScale {
  double pick = 1;        ///< noise of a pick over the stated one, never below 1
  double definition = 1;  ///< definition errors over the published ones
  double blur_mm = 0;     ///< SD of a further definition error, alike at all landmarks and in all directions
};

struct SkeletonFit {
  Outcome outcome = Outcome::NotRun;
  ShapeParameters shape;
  Posture posture;
  std::vector<LandmarkResidual> residuals;
  double rms_px = std::numeric_limits<double>::quiet_NaN();
  std::vector<BoneFigure> figures;
  std::vector<OutsideBone> outside;  ///< bones outside the model's family of shapes, the worst first
  std::vector<FigureAdvice> advice;  ///< for the figures that are not determined, if landmarks were offered
  PickScale pick_scale;
  std::vector<ExposureMovement> movements;  ///< one for every further exposure
  std::vector<std::string> undetermined;    ///< shape parameters and coordinates that stayed at the prior
  Warnings warnings;                        ///< worst offenders, unknown landmarks, ...
};

/// Shape and posture that explain the sightings in all views: non-linear least squares over every shape parameter and
/// coordinate that a landmark depends on, together with what stands between body and images: movement between the
/// exposures, errors of the geometry, errors of definition. Residuals in pixels, whitened; Huber loss, population
/// priors, bounds; covariance from the Jacobian at the solution (Laplace). The posture is that of the first view's
/// exposure. Method: docs/methods/skeleton_fit.md. @throws InputError if no landmark is known or none is seen.
SkeletonFit fitSkeleton(const Skeleton& reference, std::span<const FitView> views,
                        std::span<const LandmarkObservation> observations, std::span<const ShapePrior> priors,
                        const FitOptions& options = {}, const Job& job = {});

/// The same clinical figures of a skeleton whose shape and posture are known (no intervals): the truth of a synthetic
/// patient, or a model file.
std::vector<BoneFigure> boneFigures(const Skeleton& reference, const ShapeParameters& shape, const Posture& posture);

}  // namespace sinew
