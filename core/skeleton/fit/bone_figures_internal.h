#pragma once
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "core/skeleton/fit/fit_skeleton.h"

namespace sinew {

// The clinical figures as functions of landmark positions, for any scalar. Definitions: docs/methods/
// clinical_figures.md. All signs are the same on both sides: what is mirrored has the same figures.

/// Names of the landmarks that the figures are taken from: kLegPoints of the right leg, of the left leg, the sacrum.
const std::vector<std::string>& figureLandmarkNames();
/// Quantity, side and unit of every figure, in the order of figureValues(); values NaN.
const std::vector<BoneFigure>& figureList();

namespace figures {

enum LegPoint {
  kHip,
  kKnee,
  kAnkle,
  kNeckBase,
  kShaftProximal,
  kShaftLower,
  kMedialCondyle,
  kLateralCondyle,
  kMedialPlateau,
  kLateralPlateau,
  kMedialMalleolus,
  kLateralMalleolus,
  kLegPoints
};

/// Signed angle [rad] about `axis` (any length) from u to v, both projected on the plane normal to it.
template <class T>
T angleAbout(const Vector3<T>& axis, const Vector3<T>& u, const Vector3<T>& v) {
  using std::atan2;
  const Vector3<T> a = axis.normalized();
  return atan2(a.dot(u.cross(v)), u.dot(v) - a.dot(u) * a.dot(v));
}

/// Angle between a line and the plane normal to n [rad].
template <class T>
T elevation(const Vector3<T>& line, const Vector3<T>& n) {
  using std::asin;
  return asin(line.normalized().dot(n.normalized()));
}

/// Angle between two lines, 0 to pi [rad].
template <class T>
T angleBetween(const Vector3<T>& u, const Vector3<T>& v) {
  using std::atan2;
  return atan2(u.cross(v).norm(), u.dot(v));
}

/// femur_length, tibia_length, leg_length, hka, neck_shaft_angle, femoral_torsion, tibial_torsion, knee_flexion of
/// one leg [mm, deg]. `side` is +1 for the right leg, -1 for the left.
template <class T>
void appendLeg(const Vector3<T>* p, double side, std::vector<T>& values) {
  const T mm(1000), deg(180 / std::numbers::pi), turn(side);
  const Vector3<T> femur = p[kKnee] - p[kHip], tibia = p[kAnkle] - p[kKnee];
  const Vector3<T> condyles = p[kLateralCondyle] - p[kMedialCondyle];
  const Vector3<T> neck = p[kNeckBase] - p[kHip], shaft = p[kShaftLower] - p[kShaftProximal];
  const Vector3<T> plateau = p[kLateralPlateau] - p[kMedialPlateau];
  const Vector3<T> malleoli = p[kLateralMalleolus] - p[kMedialMalleolus];
  const Vector3<T> femur_up = -femur, tibia_up = -tibia, neck_to_head = -neck, condyles_to_medial = -condyles;
  values.push_back(mm * femur.norm());
  values.push_back(mm * tibia.norm());
  values.push_back(mm * (femur.norm() + tibia.norm()));
  values.push_back(deg * (elevation(femur, condyles) - elevation(tibia, condyles)));
  values.push_back(deg * angleBetween(neck_to_head, shaft));
  values.push_back(deg * turn * angleAbout(femur_up, neck, condyles));
  values.push_back(deg * turn * angleAbout(tibia_up, malleoli, plateau));
  values.push_back(deg * turn * angleAbout(condyles_to_medial, femur, tibia));
}

}  // namespace figures

/// Values in the order of figureList() from points in the order of figureLandmarkNames().
template <class T>
std::vector<T> figureValues(std::span<const Vector3<T>> points) {
  using namespace figures;
  using std::atan2, std::sqrt;
  const T mm(1000), deg(180 / std::numbers::pi);
  std::vector<T> values;
  appendLeg(&points[0], 1, values);
  appendLeg(&points[kLegPoints], -1, values);
  values.push_back(values[2] - values[values.size() / 2 + 2]);  // leg_length, right minus left

  const Vector3<T> right = points[kHip], left = points[kLegPoints + kHip], hips = right - left;
  const Vector3<T> to_sacrum = points[2 * kLegPoints] - (right + left) * T(0.5);
  const T level = sqrt(hips.x() * hips.x() + hips.z() * hips.z());
  // Forward is up x right, in the horizontal plane.
  const T forward = (hips.z() * to_sacrum.x() - hips.x() * to_sacrum.z()) / level;
  values.push_back(mm * hips.norm());
  values.push_back(deg * atan2(hips.y(), level));
  values.push_back(deg * atan2(-forward, to_sacrum.y()));
  return values;
}

}  // namespace sinew
