#pragma once
// Spatial derivatives of the field by jets, for many points of one body.
#include <ceres/jet.h>

#include "core/skeleton/shape/bone_field.h"

namespace sinew::field {

using PointJet = ceres::Jet<double, 3>;

inline std::vector<PointJet> pointJets(const std::vector<double>& parameters) {
  return {parameters.begin(), parameters.end()};
}

struct Linearized {
  Eigen::Vector3d p_B;
  Eigen::Matrix3d d_point;
};
inline Linearized jacobianAt(const Skeleton& reference, const std::vector<PointJet>& parameters, const Place& place,
                             const Eigen::Vector3d& p_B) {
  const Vector3<PointJet> p{PointJet(p_B.x(), 0), PointJet(p_B.y(), 1), PointJet(p_B.z(), 2)};
  const Vector3<PointJet> x = deformAt(reference, parameters, place, p);
  Linearized l;
  for (int i = 0; i < 3; ++i) {
    l.p_B[i] = x[i].a;
    l.d_point.row(i) = x[i].v;
  }
  return l;
}

}  // namespace sinew::field
