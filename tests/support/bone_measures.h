#pragma once
#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "core/geometry/triangle_mesh.h"

namespace sinew::test {

// Rulers for the shipped bone surfaces, right side and midline, in the frame of their segment. Millimetres and
// degrees.

using Eigen::Vector3d;
inline const Vector3d kX = Vector3d::UnitX(), kY = Vector3d::UnitY(), kZ = Vector3d::UnitZ();

const TriangleMesh& boneMesh(const std::string& bone);
/// A landmark of landmarks.csv [mm].
Vector3d landmark_mm(const std::string& name);

using Where = std::function<bool(const Vector3d& p_mm)>;
/// Points inside of low < p . axis < high.
Where between(const Vector3d& axis, double low_mm, double high_mm);
Where operator&&(Where a, Where b);

/// Vertices of a bone's surface [mm]; midline bones have both halves.
std::vector<Vector3d> points_mm(const std::string& bone, const Where& where = {});
/// Size along a direction.
double extent_mm(const std::vector<Vector3d>& points_mm, const Vector3d& axis);
/// The point furthest along a direction.
Vector3d furthest(const std::vector<Vector3d>& points_mm, const Vector3d& axis);
Vector3d mean(const std::vector<Vector3d>& points_mm);

/// Cut of a surface by a plane: points where its edges cross, and the centre of the enclosed area.
struct Section {
  std::vector<Vector3d> points;
  Vector3d center;
};
/// `keep` drops crossing edges (other parts of the bone that the plane meets too).
Section section(const std::string& bone, const Vector3d& point_mm, const Vector3d& normal, const Where& keep = {});

/// How far it is from a point inside a bone to its surface.
double reach_mm(const std::string& bone, const Vector3d& from_mm, const Vector3d& direction);

struct Sphere {
  Vector3d center;
  double radius, rms;
};
/// Least squares (algebraic). For a circle pass points of a plane and the normal of it.
Sphere fittedSphere(const std::vector<Vector3d>& points_mm);
Sphere fittedCircle(const std::vector<Vector3d>& points_mm, const Vector3d& normal);
/// Unit normal of the plane through points, least squares.
Vector3d fittedNormal(const std::vector<Vector3d>& points_mm);
/// Unit direction of the line through points, least squares, from the first to the last.
Vector3d fittedDirection(const std::vector<Vector3d>& points_mm);

/// Angle between two directions, 0-180.
double angle_deg(const Vector3d& a, const Vector3d& b);
/// The part of `v` across `axis`.
Vector3d across(const Vector3d& v, const Vector3d& axis);

/// One dimension of the reference adult: stated as a range (or one figure: low = high) and as measured.
struct Dimension {
  std::string name;
  double low, high, measured;
  /// Where the stated figures contradict each other: what follows from the others, and is held to instead of low,
  /// high.
  double follows = 0;
  /// Beyond the 3 %, where these are next to nothing (small angles).
  double allowance = 0;
};
/// Checks that every one lies in its range or within 3 % of it, and prints the table (a star marks
/// contradicted figures).
void expectDimensions(const std::string& bone, const std::vector<Dimension>& dimensions);

}  // namespace sinew::test
