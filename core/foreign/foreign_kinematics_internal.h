#pragma once
#include <ceres/jet.h>

#include <span>
#include <vector>

#include "core/foreign/foreign_model.h"

namespace sinew {

// T is double, or a ceres::Jet that carries the derivative by one coordinate.

inline double applied(const FunctionValue& f, double) {
  return f.value;
}
template <int N>
ceres::Jet<double, N> applied(const FunctionValue& f, const ceres::Jet<double, N>& x) {
  return {f.value, f.slope * x.v};
}
inline double valueOf(double x) {
  return x;
}
template <int N>
double valueOf(const ceres::Jet<double, N>& x) {
  return x.a;
}

template <class T>
T evaluated(const CoordinateFunction& f, std::span<const T> q) {
  T sum(f.constant);
  for (const auto& term : f.terms) {
    const T& x = q[static_cast<std::size_t>(term.coordinate)];
    sum += applied(term.function(valueOf(x)), x);
  }
  return sum;
}

template <class T>
Vector3<T> evaluated(const std::array<CoordinateFunction, 3>& f, std::span<const T> q) {
  return {evaluated(f[0], q), evaluated(f[1], q), evaluated(f[2], q)};
}

template <class T>
void followCouplings(const ForeignModel& model, std::span<T> q) {
  for (const auto& c : model.couplings)
    q[static_cast<std::size_t>(c.dependent)] = evaluated<T>(c.value, std::span<const T>{q});
}

/// X_PB: child in parent.
template <class T>
RigidTransformT<T> acrossJoint(const ForeignJoint& joint, std::span<const T> q) {
  RigidTransformT<T> X_FM = RigidTransformT<T>::Identity();
  Matrix3<T> R = Matrix3<T>::Identity();
  for (const auto& turn : joint.turns)
    if (!(turn.amount.isConstant() && turn.amount.constant == 0))
      R = R * rotationAbout<T>(turn.axis, evaluated(turn.amount, q));
  Vector3<T> p = Vector3<T>::Zero();
  for (const auto& shift : joint.shifts) p += shift.axis.cast<T>() * evaluated(shift.amount, q);
  if (!joint.ellipsoid_radii_m.isZero()) p += joint.ellipsoid_radii_m.cast<T>().cwiseProduct(R.col(2));
  X_FM.linear() = R;
  X_FM.translation() = p;
  return joint.X_PF.cast<T>() * X_FM * joint.X_BM.inverse().cast<T>();
}

template <class T>
std::vector<RigidTransformT<T>> posesOf(const ForeignModel& model, std::span<const T> q) {
  std::vector<RigidTransformT<T>> X_WB(model.bodies.size(), RigidTransformT<T>::Identity());
  for (const auto& joint : model.joints) {
    RigidTransformT<T> X = acrossJoint(joint, q);
    int inner = joint.parent, outer = joint.child;
    if (joint.towards_parent) {
      std::swap(inner, outer);
      X = X.inverse();
    }
    X_WB[static_cast<std::size_t>(outer)] = inner < 0 ? X : X_WB[static_cast<std::size_t>(inner)] * X;
  }
  return X_WB;
}

template <class T>
Vector3<T> inWorld(const std::vector<RigidTransformT<T>>& X_WB, int body, const Vector3<T>& p_B) {
  return body < 0 ? p_B : Vector3<T>{X_WB[static_cast<std::size_t>(body)] * p_B};
}

/// One place of a path: a point of the model, or where it meets an obstacle (`point` null, then p_B).
struct PathNode {
  const ForeignPathPoint* point = nullptr;
  int body = -1;
  Eigen::Vector3d p_B = Eigen::Vector3d::Zero();
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  int index = -1;     ///< of the point
  int wrap = -1;      ///< which of the path's wraps this belongs to
  double arc_m = -1;  ///< length over the obstacle from the node before; < 0: a straight line
};

/// The path at a posture: active points and contacts with obstacles.
std::vector<PathNode> resolvedPath(const ForeignModel& model, const ForeignPath& path, std::span<const double> q,
                                   const std::vector<RigidTransform>& X_WB);

/// Contacts are fixed to their obstacle and arcs keep their length: the derivative of a shortest path.
template <class T>
T lengthOf(const std::vector<PathNode>& nodes, const std::vector<RigidTransformT<T>>& X_WB, std::span<const T> q) {
  using std::sqrt;
  T length(0);
  Vector3<T> before;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const PathNode& node = nodes[i];
    const Vector3<T> p_B = node.point ? Vector3<T>{node.point->X_BF.cast<T>() * evaluated(node.point->p_F, q)}
                                      : Vector3<T>{node.p_B.cast<T>()};
    const Vector3<T> p_W = inWorld(X_WB, node.body, p_B);
    if (i > 0 && node.arc_m >= 0) {
      length += T(node.arc_m);
    } else if (i > 0) {
      const T squared = (p_W - before).squaredNorm();
      if (valueOf(squared) > 0) length += sqrt(squared);
    }
    before = p_W;
  }
  return length;
}

}  // namespace sinew
