#include "tests/support/bone_measures.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

#include "core/error.h"
#include "core/file.h"
#include "core/geometry/mesh_io.h"
#include "core/text.h"
#include "tests/support/resources.h"

namespace sinew::test {
namespace {

constexpr double kMm = 1000, kDeg = 180 / 3.14159265358979323846;

std::map<std::string, Vector3d> readLandmarks() {
  std::istringstream in{readFile(resourceDir() / "skeleton" / "landmarks.csv")};
  std::map<std::string, Vector3d> landmarks;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    const auto c = splitCsvLine(line);
    landmarks[c.at(0)] = kMm * Vector3d{std::stod(c.at(3)), std::stod(c.at(4)), std::stod(c.at(5))};
  }
  return landmarks;
}

Eigen::Matrix3d scatter(const std::vector<Vector3d>& points) {
  const Vector3d center = mean(points);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const auto& p : points) sum += (p - center) * (p - center).transpose();
  return sum;
}

}  // namespace

const TriangleMesh& boneMesh(const std::string& bone) {
  static const auto meshes = readMeshes(resourceDir() / "skeleton" / "bone_meshes.bin");
  for (const auto& mesh : meshes)
    if (mesh.bone == bone || mesh.bone == bone + "_r") return mesh.mesh;
  throw InputError{"no bone " + bone};
}

Vector3d landmark_mm(const std::string& name) {
  static const auto landmarks = readLandmarks();
  return landmarks.at(name);
}

Where between(const Vector3d& axis, double low_mm, double high_mm) {
  return [=](const Vector3d& p) { return p.dot(axis) > low_mm && p.dot(axis) < high_mm; };
}
Where operator&&(Where a, Where b) {
  return [a = std::move(a), b = std::move(b)](const Vector3d& p) { return a(p) && b(p); };
}

std::vector<Vector3d> points_mm(const std::string& bone, const Where& where) {
  std::vector<Vector3d> points;
  for (const auto& v : boneMesh(bone).vertices)
    if (!where || where(kMm * v)) points.push_back(kMm * v);
  require(!points.empty(), bone + ": there are points in the part to be measured");
  return points;
}

Vector3d furthest(const std::vector<Vector3d>& points, const Vector3d& axis) {
  return *std::ranges::max_element(points, {}, [&](const Vector3d& p) { return p.dot(axis); });
}

double extent_mm(const std::vector<Vector3d>& points, const Vector3d& axis) {
  const Vector3d u = axis.normalized();
  return (furthest(points, u) - furthest(points, -u)).dot(u);
}

Vector3d mean(const std::vector<Vector3d>& points) {
  Vector3d sum = Vector3d::Zero();
  for (const auto& p : points) sum += p;
  return sum / double(points.size());
}

Section section(const std::string& bone, const Vector3d& point_mm, const Vector3d& normal, const Where& keep) {
  const TriangleMesh& mesh = boneMesh(bone);
  const Vector3d n = normal.normalized();
  Section cut;
  Vector3d moment = Vector3d::Zero();
  double area = 0;
  for (const auto& t : mesh.triangles) {
    std::vector<Vector3d> ends;  // of the segment in which the plane cuts the triangle
    Vector3d face = Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d a = kMm * mesh.vertices[std::size_t(t[k])], b = kMm * mesh.vertices[std::size_t(t[(k + 1) % 3])];
      face += a.cross(b);
      const double da = (a - point_mm).dot(n), db = (b - point_mm).dot(n);
      if ((da < 0) != (db < 0)) ends.push_back(a + da / (da - db) * (b - a));
    }
    if (ends.size() != 2 || (keep && !(keep(ends[0]) && keep(ends[1])))) continue;
    // Directed so that the solid lies to the left, seen against n.
    if ((ends[1] - ends[0]).dot(n.cross(face)) < 0) std::swap(ends[0], ends[1]);
    const double twice = (ends[0] - point_mm).cross(ends[1] - point_mm).dot(n);
    area += twice / 2;
    moment += twice / 6 * (ends[0] + ends[1] - 2 * point_mm);
    cut.points.insert(cut.points.end(), ends.begin(), ends.end());
  }
  require(!cut.points.empty(), bone + ": the plane cuts the bone");
  cut.center = point_mm + moment / area;
  return cut;
}

double reach_mm(const std::string& bone, const Vector3d& from_mm, const Vector3d& direction) {
  const TriangleMesh& mesh = boneMesh(bone);
  const Vector3d d = direction.normalized();
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles) {  // Moeller and Trumbore 1997
    const Vector3d a = kMm * mesh.vertices[std::size_t(t[0])], b = kMm * mesh.vertices[std::size_t(t[1])],
                   c = kMm * mesh.vertices[std::size_t(t[2])];
    const Vector3d ab = b - a, ac = c - a, s = from_mm - a, p = d.cross(ac), q = s.cross(ab);
    const double det = ab.dot(p);
    if (std::abs(det) < 1e-12) continue;
    const double u = s.dot(p) / det, v = d.dot(q) / det, way = ac.dot(q) / det;
    if (u >= 0 && v >= 0 && u + v <= 1 && way > 0) nearest = std::min(nearest, way);
  }
  require(std::isfinite(nearest), bone + ": the ray meets the surface");
  return nearest;
}

Sphere fittedSphere(const std::vector<Vector3d>& points) {
  Eigen::MatrixX4d A(points.size(), 4);
  Eigen::VectorXd b(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    A.row(Eigen::Index(i)) << 2 * points[i].transpose(), 1;
    b[Eigen::Index(i)] = points[i].squaredNorm();
  }
  const Eigen::Vector4d x = A.colPivHouseholderQr().solve(b);
  Sphere sphere{x.head<3>(), std::sqrt(x[3] + x.head<3>().squaredNorm()), 0};
  for (const auto& p : points) sphere.rms += std::pow((p - sphere.center).norm() - sphere.radius, 2);
  sphere.rms = std::sqrt(sphere.rms / double(points.size()));
  return sphere;
}

Sphere fittedCircle(const std::vector<Vector3d>& points, const Vector3d& normal) {
  // The flat sphere: the minimum-norm solution leaves the centre in the plane through the points.
  const Vector3d n = normal.normalized(), center = mean(points);
  const Vector3d u = n.unitOrthogonal(), v = n.cross(u);
  Eigen::MatrixX3d A(points.size(), 3);
  Eigen::VectorXd b(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = (points[i] - center).dot(u), y = (points[i] - center).dot(v);
    A.row(Eigen::Index(i)) << 2 * x, 2 * y, 1;
    b[Eigen::Index(i)] = x * x + y * y;
  }
  const Eigen::Vector3d s = A.colPivHouseholderQr().solve(b);
  return {center + s.x() * u + s.y() * v, std::sqrt(s.z() + s.head<2>().squaredNorm()), 0};
}

Vector3d fittedNormal(const std::vector<Vector3d>& points) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>{scatter(points)}.eigenvectors().col(0);
}

Vector3d fittedDirection(const std::vector<Vector3d>& points) {
  const Vector3d d = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>{scatter(points)}.eigenvectors().col(2);
  return d.dot(points.back() - points.front()) < 0 ? Vector3d{-d} : d;
}

double angle_deg(const Vector3d& a, const Vector3d& b) {
  return kDeg * std::atan2(a.cross(b).norm(), a.dot(b));
}

Vector3d across(const Vector3d& v, const Vector3d& axis) {
  return v - v.dot(axis) / axis.squaredNorm() * axis;
}

void expectDimensions(const std::string& bone, const std::vector<Dimension>& dimensions) {
  constexpr double kShare = 0.03;  // of a figure; the landmarks themselves are meant to +-5 mm
  for (const Dimension& d : dimensions) {
    const bool contradicted = d.follows != 0;
    const double low = contradicted ? d.follows : d.low, high = contradicted ? d.follows : d.high;
    char stated[48];
    std::snprintf(stated, sizeof stated, d.low == d.high ? "%g" : "%g-%g", d.low, d.high);
    const std::string aim = contradicted ? std::string{stated} + " *" : stated;
    const double off = d.measured < d.low ? d.measured - d.low : d.measured > d.high ? d.measured - d.high : 0;
    std::printf("| %s | %s | %s | %.1f | %+.1f |\n", bone.c_str(), d.name.c_str(), aim.c_str(), d.measured, off);
    EXPECT_TRUE(d.measured >= low * (1 - kShare) - d.allowance && d.measured <= high * (1 + kShare) + d.allowance)
        << bone << ", " << d.name << ": expected " << low << " to " << high << ", measured " << d.measured;
  }
}

}  // namespace sinew::test
