#pragma once
#include <ceres/cost_function.h>
#include <ceres/evaluation_callback.h>
#include <ceres/jet.h>

#include <Eigen/Core>
#include <vector>

#include "core/geometry/view.h"
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

/// The body that all residuals of a solve share: posed once for every step the solver tries. The solver's only
/// parameter block x holds the entries `active` of z; the others stay as they are in `z`.
class SharedBody : public ceres::EvaluationCallback {
 public:
  SharedBody(const Skeleton& skeleton, const BodyParameters& body, std::vector<int> landmarks,
             std::vector<int> active, Eigen::VectorXd z)
      : skeleton_{skeleton},
        body_{body},
        landmarks_{std::move(landmarks)},
        active_{std::move(active)},
        z_{std::move(z)} {
    x_.resize(active_.size());
    for (std::size_t i = 0; i < active_.size(); ++i) x_[i] = z_[active_[i]];
  }

  double* x() { return x_.data(); }
  int activeCount() const { return static_cast<int>(active_.size()); }
  const std::vector<int>& active() const { return active_; }
  const PosedPoints& points() const { return points_; }

  /// z with the solver's values.
  Eigen::VectorXd z() const {
    Eigen::VectorXd z = z_;
    for (std::size_t i = 0; i < active_.size(); ++i) z[active_[i]] = x_[i];
    return z;
  }

  void PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override {
    if (!new_evaluation_point && !(evaluate_jacobians && points_.dp_dz.empty())) return;
    points_ = posePoints(skeleton_, body_, landmarks_, z(), evaluate_jacobians ? active_ : std::vector<int>{});
  }

 private:
  const Skeleton& skeleton_;
  const BodyParameters& body_;
  std::vector<int> landmarks_, active_;
  Eigen::VectorXd z_;
  std::vector<double> x_;
  PosedPoints points_;
};

/// residual [-] = (observed - projected) / sigma, two components. A point behind the source refuses the step.
class SightingCost : public ceres::CostFunction {
 public:
  SightingCost(const SharedBody& body, int point, const View& view, const Eigen::Vector2d& uv_px, double sigma_px)
      : body_{body}, point_{point}, view_{view}, uv_px_{uv_px}, sigma_px_{sigma_px} {
    set_num_residuals(2);
    mutable_parameter_block_sizes()->push_back(body.activeCount());
  }

  bool Evaluate(const double* const*, double* residuals, double** jacobians) const override {
    using Jet = ceres::Jet<double, 3>;
    const Eigen::Vector3d& p = body_.points().p_W[point_];
    const Vector3<Jet> p_W{Jet(p.x(), 0), Jet(p.y(), 1), Jet(p.z(), 2)};
    Eigen::Matrix<Jet, 2, 1> uv;
    if (!project<Jet>(view_, p_W, uv)) return false;
    for (int i = 0; i < 2; ++i) residuals[i] = (uv_px_[i] - uv[i].a) / sigma_px_;
    if (!jacobians || !jacobians[0]) return true;
    Eigen::Map<Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor>> jacobian{jacobians[0], 2,
                                                                                   body_.activeCount()};
    for (int i = 0; i < 2; ++i) jacobian.row(i) = -uv[i].v.transpose() * body_.points().dp_dz[point_] / sigma_px_;
    return true;
  }

 private:
  const SharedBody& body_;
  int point_;
  const View& view_;
  Eigen::Vector2d uv_px_;
  double sigma_px_;
};

/// residual [-] = weight * z for every active entry: the population's prior.
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

}  // namespace sinew
