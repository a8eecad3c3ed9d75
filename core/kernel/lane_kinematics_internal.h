#pragma once
#include "core/kernel/lane_rotation_internal.h"
#include "core/kernel/model_view_internal.h"

namespace sinew {
namespace {

/// A posture in lanes: entry e of the lanes' poses starts at first[e * stride].
struct PostureLanes {
  const double* first;
  std::size_t stride;
};

/// C = A B of 3 x 3 matrices: A with rows of `row` numbers in lanes, B constant.
template <class L>
void timesConstant(const typename L::V* A, int row, const typename L::Real* B, typename L::V* C) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      C[3 * r + c] = A[row * r] * B[c] + A[row * r + 1] * B[3 + c] + A[row * r + 2] * B[6 + c];
}

/// Pose of a child: rows [R p] of X_WB = X_WP (R_PJ, p_PJ) R_JB. `R_WJ` is where the joint frame then stands.
template <class L, class Joint>
void jointFrame(const Joint& joint, const typename L::V* X_WP, typename L::V* R_WJ, typename L::V* X_WB) {
  if (X_WP == nullptr) {  // the world, or the pelvis taken as the world
    for (int i = 0; i < 9; ++i) R_WJ[i] = L::set(joint.R_PJ[i]);
    for (int r = 0; r < 3; ++r) X_WB[4 * r + 3] = L::set(joint.p_PJ[r]);
    return;
  }
  if (joint.turned)
    timesConstant<L>(X_WP, 4, joint.R_PJ, R_WJ);
  else
    for (int i = 0; i < 9; ++i) R_WJ[i] = X_WP[i / 3 * 4 + i % 3];
  for (int r = 0; r < 3; ++r)
    X_WB[4 * r + 3] = X_WP[4 * r + 3] + X_WP[4 * r] * joint.p_PJ[0] + X_WP[4 * r + 1] * joint.p_PJ[1] +
                      X_WP[4 * r + 2] * joint.p_PJ[2];
}

/// X_WB's rotation = A B, A with rows of 3.
template <class L>
void setRotation(const typename L::V* A, const typename L::V* B, typename L::V* X_WB) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) X_WB[4 * r + c] = A[3 * r] * B[c] + A[3 * r + 1] * B[3 + c] + A[3 * r + 2] * B[6 + c];
}

/// Glide of the patella below its start, and its rate: PatellaDriver::glide() without branches.
template <class L>
typename L::V glide(const PatellaView<typename L::Real>& d, typename L::V knee, typename L::V& rate) {
  using V = typename L::V;
  using Real = typename L::Real;
  V integral = (knee - d.knot[0]) * d.rate[0];
  rate = L::set(d.rate[0]);
  for (int i = 0; i < d.samples; ++i) {
    const V from = knee - d.knot[i], zero = L::set(0), span = L::set(d.span[i]);
    const V past = from > zero ? from : zero, t = past < span ? past : span;
    // The rate falls by slope * t inside this interval and stays so much lower in all later ones.
    rate += t * d.slope[i];
    integral += d.slope[i] * t * (past - Real(0.5) * t);
  }
  return integral;
}

template <class L, bool kRates>
void patellaPose(const PatellaView<typename L::Real>& d, typename L::V knee, typename L::V* X, typename L::V* rates) {
  using V = typename L::V;
  V rate;
  const V phi = glide<L>(d, knee, rate);
  const HalfTurn<L> half = halfTurn<L>(phi * phi);
  const V sine = 2 * half.c * half.s * phi, cosine = 1 - 2 * half.s * half.s * phi * phi;
  const V* F = X + 12 * d.femur;
  V* P = X + 12 * d.segment;
  V R_WK[9];
  timesConstant<L>(F, 4, d.R_FK, R_WK);
  const V px = d.radius_m * (d.cos_start * cosine + d.sin_start * sine);  // cos(start - phi), sin(start - phi)
  const V py = d.radius_m * (d.sin_start * cosine - d.cos_start * sine);
  for (int r = 0; r < 3; ++r) {
    const V* row = R_WK + 3 * r;
    P[4 * r] = row[0] * cosine - row[1] * sine;  // R_WK Rz(-phi)
    P[4 * r + 1] = row[0] * sine + row[1] * cosine;
    P[4 * r + 2] = row[2];
    const V centre = F[4 * r + 3] + F[4 * r] * d.p_FK[0] + F[4 * r + 1] * d.p_FK[1] + F[4 * r + 2] * d.p_FK[2];
    P[4 * r + 3] = centre + row[0] * px + row[1] * py;
    if constexpr (kRates) {  // velocity of turning per unit knee rate, and a point on the axis
      V* D = rates + 9 * d.segment;
      D[r] = -rate * row[2];
      D[3 + r] = centre;
    }
  }
}

/// The radius turns about its axis by 90 degrees and the axial part (twist) of the wrist: tan(twist / 2) = s / c of
/// the wrist's quaternion along the axis.
template <class L, bool kRates>
void radiusPose(const RadiusView<typename L::Real>& d, PostureLanes q, typename L::V* X, typename L::V* rates) {
  using V = typename L::V;
  const V x = L::load(q.first + d.coordinate * q.stride), y = L::load(q.first + (d.coordinate + 1) * q.stride),
          z = L::load(q.first + (d.coordinate + 2) * q.stride);
  const V square = x * x + y * y + z * z;
  const HalfTurn<L> half = halfTurn<L>(square);
  const V along = half.s * (x * d.axis[0] + y * d.axis[1] + z * d.axis[2]), c = half.c;
  const V inverse = 1 / (c * c + along * along);
  const V sine = (c * c - along * along) * inverse, cosine = -2 * c * along * inverse;  // of twist + 90 degrees
  V R[9];
  rotationAboutAxis<L>(d.axis, sine, 1 - cosine, R);
  const V* U = X + 12 * d.ulna;
  V* B = X + 12 * d.segment;
  for (int r = 0; r < 3; ++r) {
    for (int k = 0; k < 3; ++k) B[4 * r + k] = U[4 * r] * R[k] + U[4 * r + 1] * R[3 + k] + U[4 * r + 2] * R[6 + k];
    B[4 * r + 3] = U[4 * r + 3] + U[4 * r] * d.p_UR[0] + U[4 * r + 1] * d.p_UR[1] + U[4 * r + 2] * d.p_UR[2];
  }
  if constexpr (kRates) {
    // Twist per unit angular velocity w (axes of the ulna): 2 (c ds - s dc) / (c^2 + s^2) with
    // ds = (c axis + v x axis) . w / 2, dc = -v . w / 2; v is the quaternion's vector part.
    const V vx = half.s * x, vy = half.s * y, vz = half.s * z;
    const V g[3] = {inverse * (c * (c * d.axis[0] + vy * d.axis[2] - vz * d.axis[1]) + along * vx),
                    inverse * (c * (c * d.axis[1] + vz * d.axis[0] - vx * d.axis[2]) + along * vy),
                    inverse * (c * (c * d.axis[2] + vx * d.axis[1] - vy * d.axis[0]) + along * vz)};
    const V a = 2 * half.c * half.s, b = 2 * half.s * half.s;
    V J[9];
    rotation<L>(x, y, z, b, thirdCoefficient<L>(square, a), J);
    V* D = rates + 9 * d.segment;
    for (int r = 0; r < 3; ++r) {
      D[r] = U[4 * r] * d.axis[0] + U[4 * r + 1] * d.axis[1] + U[4 * r + 2] * d.axis[2];
      D[3 + r] = g[0] * J[r] + g[1] * J[3 + r] + g[2] * J[6 + r];
    }
  }
}

/// X_WB of every segment, rows [R p], 12 registers each. With `rates` (9 registers a segment) also how its joint
/// turns it: ball - three axes in the world, one a coordinate, rows; revolute - its axis; patella, radius - see
/// above. Without kRoot the pelvis stays at the world's origin: lengths do not depend on it.
template <class L, bool kRoot, bool kRates>
void lanePoses(const ModelView<typename L::Real>& m, PostureLanes q, typename L::V* X, typename L::V* rates) {
  using V = typename L::V;
  using Joint = JointView<typename L::Real>;
  for (int j = kRoot ? 0 : 1; j < m.joint_count; ++j) {
    const Joint& joint = m.joints[j];
    const bool on_world = joint.parent < 0 || (!kRoot && joint.parent == m.joints[0].child);
    V* B = X + 12 * joint.child;
    V R_WJ[9], R_JB[9];
    jointFrame<L>(joint, on_world ? nullptr : X + 12 * joint.parent, R_WJ, B);
    const double* first = q.first + joint.coordinate * q.stride;
    if (joint.kind == Joint::Revolute) {
      const V angle = L::load(first);
      const HalfTurn<L> half = halfTurn<L>(angle * angle);
      const V half_sine = half.s * angle;
      rotationAboutAxis<L>(joint.axis, 2 * half.c * half_sine, 2 * half_sine * half_sine, R_JB);
      if constexpr (kRates)
        for (int r = 0; r < 3; ++r)
          rates[9 * joint.child + r] =
              R_WJ[3 * r] * joint.axis[0] + R_WJ[3 * r + 1] * joint.axis[1] + R_WJ[3 * r + 2] * joint.axis[2];
    } else {
      const V x = L::load(first), y = L::load(first + q.stride), z = L::load(first + 2 * q.stride);
      const V square = x * x + y * y + z * z;
      const HalfTurn<L> half = halfTurn<L>(square);
      const V a = 2 * half.c * half.s, b = 2 * half.s * half.s;
      rotation<L>(x, y, z, a, b, R_JB);
      if (joint.kind == Joint::Free) {
        const double* shift = first - 3 * q.stride;
        const V tx = L::load(shift), ty = L::load(shift + q.stride), tz = L::load(shift + 2 * q.stride);
        for (int r = 0; r < 3; ++r) B[4 * r + 3] += R_WJ[3 * r] * tx + R_WJ[3 * r + 1] * ty + R_WJ[3 * r + 2] * tz;
      }
      if constexpr (kRates) {  // columns of R_WJ times the left Jacobian of the exponential map, stored as rows
        V J[9];
        rotation<L>(x, y, z, b, thirdCoefficient<L>(square, a), J);
        for (int c = 0; c < 3; ++c)
          for (int r = 0; r < 3; ++r)
            rates[9 * joint.child + 3 * c + r] =
                R_WJ[3 * r] * J[c] + R_WJ[3 * r + 1] * J[3 + c] + R_WJ[3 * r + 2] * J[6 + c];
      }
    }
    setRotation<L>(R_WJ, R_JB, B);
  }
  if (!kRoot) {
    V* pelvis = X + 12 * m.joints[0].child;
    for (int i = 0; i < 12; ++i) pelvis[i] = L::set(i % 5 == 0 ? 1 : 0);
  }
  for (int i = 0; i < 2; ++i) {
    patellaPose<L, kRates>(m.patellae[i], L::load(q.first + m.patellae[i].coordinate * q.stride), X, rates);
    radiusPose<L, kRates>(m.radii[i], q, X, rates);
  }
}

}  // namespace
}  // namespace sinew
