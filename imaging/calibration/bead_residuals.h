#pragma once
#include <ceres/autodiff_cost_function.h>

#include <Eigen/Core>

#include "core/geometry/rigid_transform.h"

namespace sinew {

/// Error of one bead in one view: residual[2] = (observed - projected) / sigma [-], with
/// p_C = R0 exp(w) p_W + t,  u = f x/z (1 + k1 r^2) + cx,  v = a f y/z (1 + k1 r^2) + cy, a = fy / fx of the
/// detector. Parameter blocks: intrinsics[4] = {f, cx, cy [px], k1}, pose[6] = {w [rad], t [m]}, bead[3] = p_W [m].
class BeadProjectionResidual {
 public:
  BeadProjectionResidual(const Eigen::Vector2d& uv_px, double sigma_px, const Eigen::Matrix3d& R0, double aspect)
      : uv_px_{uv_px}, sigma_px_{sigma_px}, R0_{R0}, aspect_{aspect} {}

  template <typename T>
  bool operator()(const T* intrinsics, const T* pose, const T* bead, T* residual) const {
    const Vector3<T> w{pose[0], pose[1], pose[2]}, t{pose[3], pose[4], pose[5]}, p{bead[0], bead[1], bead[2]};
    const Vector3<T> p_C = R0_.cast<T>() * (rotationFromVector<T>(w) * p) + t;
    if (!(p_C.z() > T(1e-6))) return false;  // behind the source: the step is refused
    const T x = p_C.x() / p_C.z(), y = p_C.y() / p_C.z();
    const T stretched = intrinsics[0] * (T(1) + intrinsics[3] * (x * x + y * y));
    residual[0] = (T(uv_px_.x()) - stretched * x - intrinsics[1]) / T(sigma_px_);
    residual[1] = (T(uv_px_.y()) - T(aspect_) * stretched * y - intrinsics[2]) / T(sigma_px_);
    return true;
  }
  static ceres::CostFunction* create(const Eigen::Vector2d& uv_px, double sigma_px, const Eigen::Matrix3d& R0,
                                     double aspect) {
    return new ceres::AutoDiffCostFunction<BeadProjectionResidual, 2, 4, 6, 3>(
        new BeadProjectionResidual{uv_px, sigma_px, R0, aspect});
  }

 private:
  Eigen::Vector2d uv_px_;
  double sigma_px_;
  Eigen::Matrix3d R0_;
  double aspect_;
};

/// How far a bead is from where the object's file puts it: residual[3] = (p_W - p_nominal) / sigma [-].
class BeadPlaceResidual {
 public:
  BeadPlaceResidual(const Eigen::Vector3d& nominal, double sigma_m) : nominal_{nominal}, sigma_m_{sigma_m} {}
  template <typename T>
  bool operator()(const T* bead, T* residual) const {
    for (int k = 0; k < 3; ++k) residual[k] = (bead[k] - T(nominal_[k])) / T(sigma_m_);
    return true;
  }
  static ceres::CostFunction* create(const Eigen::Vector3d& nominal, double sigma_m) {
    return new ceres::AutoDiffCostFunction<BeadPlaceResidual, 3, 3>(new BeadPlaceResidual{nominal, sigma_m});
  }

 private:
  Eigen::Vector3d nominal_;
  double sigma_m_;
};

}  // namespace sinew
