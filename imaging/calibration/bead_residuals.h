#pragma once
#include <ceres/autodiff_cost_function.h>

#include <Eigen/Core>

#include "core/geometry/view.h"

namespace sinew {

/// The members of a ConeBeam as numbers of a solver.
template <class T>
struct PinholeUnknowns {
  T fx_px, fy_px, cx_px, cy_px, k1, k2, p1, p2, k3;
};

/// A cone-beam view as a solver's unknowns.
///   intrinsics[8] = {f, cx, cy [px], k1, k2, p1, p2, k3}: the rows' focal length is `aspect` f,
///   pose[6] = {w [rad], t [m]}: p_C = R0 exp(w) p_W + t.
struct ViewUnknowns {
  static constexpr int kIntrinsics = 8, kFirstDistortion = 3;
  Eigen::Matrix<double, kIntrinsics, 1> intrinsics;
  Eigen::Matrix<double, 6, 1> pose;
  Eigen::Matrix3d R0;
  double aspect;

  explicit ViewUnknowns(const View& view);  ///< @pre a cone beam
  /// The view that the unknowns describe; what they do not is as in `start`.
  View view(const View& start) const;

  template <typename T>
  static PinholeUnknowns<T> pinhole(const T* intrinsics, double aspect) {
    return {.fx_px = intrinsics[0],
            .fy_px = T(aspect) * intrinsics[0],
            .cx_px = intrinsics[1],
            .cy_px = intrinsics[2],
            .k1 = intrinsics[3],
            .k2 = intrinsics[4],
            .p1 = intrinsics[5],
            .p2 = intrinsics[6],
            .k3 = intrinsics[7]};
  }
};

/// Error of one bead in one view: residual[2] = (observed - projected) / sigma [-], projected as everywhere (view.h).
/// Parameter blocks: intrinsics[8] and pose[6] of ViewUnknowns, bead[3] = p_W [m].
class BeadProjectionResidual {
 public:
  BeadProjectionResidual(const Eigen::Vector2d& uv_px, double sigma_px, const Eigen::Matrix3d& R0, double aspect)
      : uv_px_{uv_px}, sigma_px_{sigma_px}, R0_{R0}, aspect_{aspect} {}

  template <typename T>
  bool operator()(const T* intrinsics, const T* pose, const T* bead, T* residual) const {
    const Vector3<T> w{pose[0], pose[1], pose[2]}, t{pose[3], pose[4], pose[5]}, p{bead[0], bead[1], bead[2]};
    const Vector3<T> p_C = R0_.cast<T>() * (rotationFromVector<T>(w) * p) + t;
    Eigen::Matrix<T, 2, 1> uv_px;
    // Behind the source: the step is refused.
    if (!detail::project<T>(ViewUnknowns::pinhole(intrinsics, aspect_), p_C, uv_px)) return false;
    for (int k = 0; k < 2; ++k) residual[k] = (T(uv_px_[k]) - uv_px[k]) / T(sigma_px_);
    return true;
  }
  static ceres::CostFunction* create(const Eigen::Vector2d& uv_px, double sigma_px, const Eigen::Matrix3d& R0,
                                     double aspect) {
    return new ceres::AutoDiffCostFunction<BeadProjectionResidual, 2, ViewUnknowns::kIntrinsics, 6, 3>(
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
