#pragma once
#include "core/skeleton/shape/bone_field.h"

namespace sinew {

/// d(deformed point) / d(reference point), exact (automatic differentiation). Its determinant is the local change of
/// volume; positive everywhere in a body that deformedSkeleton() accepts.
Eigen::Matrix3d fieldJacobian(const Skeleton& reference, const std::vector<double>& parameters, int segment,
                              const Eigen::Vector3d& p_B);

/// A point's image and how it moves.
struct FieldDerivatives {
  Eigen::Vector3d p_B;            ///< deform()
  Eigen::Matrix3d d_point;        ///< fieldJacobian()
  Eigen::Matrix3Xd d_parameters;  ///< by shape parameter, in the order of shapeParameterNames() [m; m/rad for angles]
};
FieldDerivatives fieldDerivatives(const Skeleton& reference, const std::vector<double>& parameters, int segment,
                                  const Eigen::Vector3d& p_B);

}  // namespace sinew
