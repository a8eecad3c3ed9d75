#pragma once
#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "core/skeleton/fit/fit_view.h"
#include "core/skeleton/shape/body_parameters_internal.h"

namespace sinew {

/// What stands between the body and its images besides the body itself, as one vector y of standardized deviations
/// with prior mean 0 and SD 1: how the patient moved before every further exposure (the whole body, and hips, knees
/// and ankles), and the errors of every view's geometry. What is known exactly has no entry.
class Nuisances {
 public:
  /// `observable`: the entries of z that the sightings see; joints that are not among them are taken as still.
  Nuisances(const Skeleton& skeleton, const BodyParameters& body, std::span<const FitView> views,
            const MovementPrior& prior, std::span<const int> observable);

  int count() const { return count_; }
  int exposureCount() const { return static_cast<int>(exposures_.size()); }
  int exposureOf(int view) const { return exposure_of_[view]; }  ///< counted from 0, that of the first view

  /// Change of one entry of z between exposure 0 and another: dz = ratio * y.
  struct JointChange {
    int z = 0, y = 0;
    double ratio = 0;
    int joint = 0;         ///< of the skeleton
    Eigen::Vector3d axis;  ///< about which it turns, in the joint's frame
  };
  std::span<const JointChange> jointChanges(int exposure) const { return exposures_[exposure].joints; }
  /// Turn of a joint about the axis of such an entry that has y = 1.
  double jointSd_rad() const { return prior_.joint_rad; }
  /// The body of an exposure.
  Eigen::VectorXd bodyAt(int exposure, const Eigen::VectorXd& z, const Eigen::VectorXd& y) const;

  /// First of the six entries (turn, shift) of the whole body's movement; -1 for exposure 0.
  int movementBegin(int exposure) const { return exposures_[exposure].movement; }
  const MovementPrior& movementPrior() const { return prior_; }

  /// Turn and shift of the body, shared distance, and errors of the view: what an image depends on besides the point.
  static constexpr int kLocal = 7 + kViewErrors;
  struct Local {
    std::array<int, kLocal> y;      ///< entry of y, or -1
    std::array<double, kLocal> sd;  ///< of that entry
  };
  const Local& local(int view) const { return local_[view]; }

 private:
  struct Exposure {
    int movement = -1;
    std::vector<JointChange> joints;
  };
  int count_ = 0;
  MovementPrior prior_;
  std::vector<int> exposure_of_;
  std::vector<Exposure> exposures_;
  std::vector<Local> local_;
};

/// Image of a point of the body (as posed in the view's exposure, before the whole body moved) with derivatives.
struct PointImage {
  Eigen::Vector2d uv_px;
  Eigen::Matrix<double, 2, 3> by_point;
  Eigen::Matrix<double, 2, Nuisances::kLocal> by_local;  ///< by the standardized entries of Nuisances::local()
};

/// A view with its movement and its errors, prepared for many points.
class DisturbedView {
 public:
  /// `pivot_W` is the middle of the body, about which it turns. `view` and `local` are kept by reference.
  DisturbedView(const FitView& view, const Nuisances::Local& local, const Eigen::VectorXd& y,
                const Eigen::Vector3d& pivot_W);
  /// Returns false for a point behind the source.
  bool image(const Eigen::Vector3d& p_W, PointImage& image) const;
  std::optional<Eigen::Vector2d> image(const Eigen::Vector3d& p_W) const;

 private:
  /// exp(v) with its derivatives by the entries of v.
  struct Turn {
    Eigen::Matrix3d R;
    std::array<Eigen::Matrix3d, 3> by_entry;
    explicit Turn(const Eigen::Vector3d& v_rad);
  };
  const View& view_;
  const Nuisances::Local& local_;
  Eigen::Vector3d pivot_W_, pivot_C_;
  Eigen::Matrix<double, Nuisances::kLocal, 1> x_;  ///< the local unknowns in their units
  Turn body_, frame_;
  Eigen::Vector2d middle_px_;
};

/// One of every view.
std::vector<DisturbedView> disturbedViews(std::span<const FitView> views, const Nuisances& nuisances,
                                          const Eigen::VectorXd& y, const Eigen::Vector3d& pivot_W);

}  // namespace sinew
