#pragma once
#include <ceres/cost_function.h>
#include <ceres/evaluation_callback.h>
#include <ceres/jet.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "core/skeleton/fit/fit_nuisances_internal.h"
#include "core/skeleton/shape/body_parameters_internal.h"

namespace sinew {

/// Points of the body and their derivatives with respect to chosen entries of z.
struct PosedPoints {
  std::vector<Eigen::Vector3d> p_W;
  std::vector<Eigen::Matrix3Xd> dp_dz;  ///< 3 x active; empty if not asked for
};

/// World positions of landmarks of the body z; derivatives with respect to the entries `active` (automatic
/// differentiation, some entries at a time), none if it is empty.
PosedPoints posePoints(const Skeleton& skeleton, const BodyParameters& body, std::span<const int> landmarks,
                       const Eigen::VectorXd& z, std::span<const int> active);

/// What does not change while the fit looks for the body.
struct FitModel {
  const Skeleton& skeleton;
  const BodyParameters& body;
  std::span<const FitView> views;
  const Nuisances& nuisances;
  std::vector<int> landmarks;                         ///< indices into skeleton.landmarks
  Eigen::Vector3d pivot_W = Eigen::Vector3d::Zero();  ///< middle of the body, about which it turns between exposures
};

/// The body that all residuals of a solve share: posed once for every step the solver tries and every exposure whose
/// posture differs. The solver's only parameter block x holds the entries `active` of z, the others stay as they are,
/// and then, if `nuisances_free`, all of y.
class SharedBody : public ceres::EvaluationCallback {
 public:
  SharedBody(const FitModel& model, std::vector<int> active, Eigen::VectorXd z, Eigen::VectorXd y,
             bool nuisances_free);

  double* x() { return x_.data(); }
  int size() const { return static_cast<int>(x_.size()); }
  int activeCount() const { return static_cast<int>(active_.size()); }
  const FitModel& model() const { return model_; }
  bool nuisancesFree() const { return nuisances_free_; }
  /// Landmarks as posed in an exposure, before the whole body moved.
  const PosedPoints& points(int exposure) const { return points_[shares_posture_[exposure] ? 0 : exposure]; }
  const DisturbedView& view(int index) const { return disturbed_[index]; }
  /// Column of x that holds this entry of z; -1 if it is not active.
  int columnOf(int z) const { return column_of_[z]; }

  Eigen::VectorXd z() const;  ///< with the solver's values
  Eigen::VectorXd y() const;

  void PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override;

 private:
  const FitModel& model_;
  std::vector<int> active_, column_of_;
  Eigen::VectorXd z_, y_;
  bool nuisances_free_;
  std::vector<double> x_;
  std::vector<bool> shares_posture_;  ///< by exposure: no joint has moved, none can
  std::vector<DisturbedView> disturbed_;
  std::vector<PosedPoints> points_;  ///< by exposure; of those that share a posture the first
};

/// One sighting among those of a landmark.
struct SeenPoint {
  int view = 0;
  Eigen::Vector2d uv_px;
};

/// All sightings of one landmark: residual [-] = L^-1 (observed - projected), two components a sighting, L L^T the
/// covariance of their errors [px^2] - what the reader's idea of the landmark has in common in all of them included.
/// A point behind the source refuses the step.
class LandmarkCost : public ceres::CostFunction {
 public:
  LandmarkCost(const SharedBody& shared, int point, std::vector<SeenPoint> seen,
               const Eigen::MatrixXd& covariance_px2);
  bool Evaluate(const double* const* x, double* residuals, double** jacobians) const override;

 private:
  const SharedBody& shared_;
  int point_;
  std::vector<SeenPoint> seen_;
  Eigen::LLT<Eigen::MatrixXd> root_;
};

/// residual [-] = weight * x for every entry: the population's prior, and that of the nuisances.
class PriorCost : public ceres::CostFunction {
 public:
  explicit PriorCost(std::vector<double> weights) : weights_{std::move(weights)} {
    set_num_residuals(static_cast<int>(weights_.size()));
    mutable_parameter_block_sizes()->push_back(num_residuals());
  }

  bool Evaluate(const double* const* x, double* residuals, double** jacobians) const override {
    const int n = num_residuals();
    for (int i = 0; i < n; ++i) residuals[i] = weights_[i] * x[0][i];
    if (!jacobians || !jacobians[0]) return true;
    std::fill_n(jacobians[0], n * n, 0.0);
    for (int i = 0; i < n; ++i) jacobians[0][i * n + i] = weights_[i];
    return true;
  }

 private:
  std::vector<double> weights_;
};

/// residual [-] = weight * x for one entry, for a prior with its own loss.
class OnePriorCost : public ceres::CostFunction {
 public:
  OnePriorCost(int entry, int count, double weight) : entry_{entry}, weight_{weight} {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->push_back(count);
  }

  bool Evaluate(const double* const* x, double* residuals, double** jacobians) const override {
    residuals[0] = weight_ * x[0][entry_];
    if (!jacobians || !jacobians[0]) return true;
    std::fill_n(jacobians[0], parameter_block_sizes()[0], 0.0);
    jacobians[0][entry_] = weight_;
    return true;
  }

 private:
  int entry_;
  double weight_;
};

}  // namespace sinew
