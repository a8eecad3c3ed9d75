// Dimensions of pelvis, spine, rib cage and skull, measured on the meshes; figures: Bell 1990, Murray 1993, Legaye
// 1998, Panjabi 1991 and 1992, Berry 1987, de Leva 1996.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/support/bone_measures.h"

namespace sinew::test {
namespace {

constexpr double kDeg = 180 / 3.14159265358979;

/// Opening of the acetabulum: normal of the plane through the rim, out of the socket. The rim is where the sphere of
/// the socket ends outside; far points (notch, fossa) are dropped in turns.
Vector3d acetabularAxis() {
  const TriangleMesh& mesh = boneMesh("hip_bone");
  const Vector3d center = landmark_mm("acetabulum_center_r");
  std::vector<Vector3d> rim;
  const auto radius = [&](const Vector3d& p) { return (1e3 * p - center).norm(); };
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d a = mesh.vertices[std::size_t(t[k])], b = mesh.vertices[std::size_t(t[(k + 1) % 3])];
      if (radius(a) < 27.2 && radius(b) > 27.2 && radius(b) < 31) rim.push_back(500 * (a + b));
    }
  Vector3d axis{0.3, -0.7, 0.64}, middle;
  for (int turn = 0; turn < 12; ++turn) {
    std::vector<Vector3d> kept;
    for (const auto& p : rim) {
      const bool first = turn == 0;
      if (first ? (p - center).dot(axis) > -12 : std::abs((p - middle).dot(axis)) < std::max(4, 12 - turn))
        kept.push_back(p);
    }
    middle = mean(kept);
    axis = fittedNormal(kept);
    if (axis.z() < 0) axis = -axis;
  }
  return axis;
}

TEST(BoneDimensions, Pelvis) {
  const auto hip = points_mm("hip_bone");
  const Vector3d asis = furthest(points_mm("hip_bone", between(kY, 66, 95)), kX);
  const Vector3d psis = furthest(points_mm("hip_bone", between(kY, 88, 120)), -kX);
  const Vector3d center = landmark_mm("acetabulum_center_r");
  const Sphere socket =
      fittedSphere(points_mm("hip_bone", [&](const Vector3d& p) { return (p - center).norm() < 27; }));
  const Vector3d ischium = furthest(hip, -kY);
  // The pubic arch in its own plane: from below the symphysis to both ischial tips.
  const Vector3d arch = across(furthest(points_mm("hip_bone", between(kZ, 0, 5)), Vector3d{-0.52, -0.85, 0}), kZ);
  const Vector3d opening = acetabularAxis();
  expectDimensions(
      "pelvis",
      {{"inter-ASIS", 240, 240, 2 * asis.z()},
       {"bi-iliac", 280, 285, 2 * furthest(points_mm("hip_bone", between(kY, 60, 130)), kZ).z()},
       {"inter-PSIS", 80, 90, 2 * psis.z()},
       {"hip centre spacing", 172, 172, 2 * socket.center.z()},
       {"depth ASIS-PSIS", 150, 150, asis.x() - psis.x()},
       {"acetabular diameter", 52, 54, 2 * socket.radius},
       {"height crest-ischium", 200, 215, extent_mm(hip, kY)},
       {"ischial tips", 110, 120, 2 * ischium.z()},
       {"subpubic angle, to the ischial tips", 65, 75, 2 * angle_deg(ischium - arch, across(ischium - arch, kZ))},
       {"acetabular inclination", 40, 45, kDeg * std::atan2(opening.z(), -opening.y())},
       {"acetabular anteversion", 17, 20, kDeg * std::asin(opening.x())}});
}

TEST(BoneDimensions, Sacrum) {
  const Vector3d top{0.643, 0.766, 0}, forward{0.766, -0.643, 0};
  const auto endplate = points_mm("sacrum", [&](const Vector3d& p) {
    return p.dot(top) >
               furthest(points_mm("sacrum", between(kZ, -8, 8) && between(kX, -50, -5)), top).dot(top) - 1.2 &&
           std::abs(p.z()) < 20 && p.x() > -60;
  });
  Vector3d normal = fittedNormal(endplate);
  if (normal.y() < 0) normal = -normal;
  const double level = mean(endplate).dot(normal);
  const Section below = section("sacrum", (level - 4) * normal, normal,
                                [](const Vector3d& p) { return p.x() > -56 && std::abs(p.z()) < 27; });
  const Vector3d s1 = mean(endplate);
  const double slope = angle_deg(normal, kY), tilt = angle_deg(across(s1, kZ), kY);
  // Anterior contour in the midline, promontory to the apex of S5.
  const Section middle = section("sacrum", 0.5 * kZ, kZ);
  std::vector<Vector3d> contour;
  double length = 0;
  for (double y = 84; y >= -6; y -= 6) {
    double x = -1e9;
    for (const auto& p : middle.points)
      if (std::abs(p.y() - y) < 3) x = std::max(x, p.x());
    contour.push_back({x, y, 0});
    if (contour.size() > 1) length += (contour.back() - contour[contour.size() - 2]).norm();
  }
  expectDimensions("sacrum", {{"S1 endplate width", 50, 50, extent_mm(below.points, kZ)},
                              {"S1 endplate depth", 32, 32, extent_mm(below.points, forward)},
                              {"sacral slope", 40, 40, slope},
                              {"pelvic tilt", 13, 13, tilt, 14.6},
                              {"pelvic incidence", 52, 52, slope + tilt, 54.6},
                              {"length along the curve", 110, 120, length, 141},
                              {"breadth at the alae", 105, 110, extent_mm(points_mm("sacrum"), kZ)}});
}

/// A vertebral body, found by rays from its centre.
struct Body {
  Vector3d center, up;  ///< up: out of the upper endplate
  Vector3d lower_up;    ///< into the lower endplate
  double depth, width, height;
  double lower_width;  ///< at the lower endplate, away from uncinate processes
};
/// `size_mm` about half the depth: how far from the centre the endplates are probed.
Body bodyOf(const std::string& bone, const Vector3d& guess_up, double size_mm) {
  const Vector3d center = landmark_mm(bone + "_body_center"), forward = guess_up.cross(kZ);
  const auto endplate = [&](const Vector3d& out) -> Vector3d {  // normal of it, upwards
    const auto at = [&](double offset) -> Vector3d {
      const Vector3d start = center + offset * forward;
      return start + reach_mm(bone, start, out) * out;
    };
    return kZ.cross(at(0.5 * size_mm) - at(-0.5 * size_mm)).normalized();
  };
  Body body{center, endplate(guess_up), endplate(-guess_up), 0, 0, 0, 0};
  const double above = reach_mm(bone, center, body.up), below = reach_mm(bone, center, -body.up);
  body.height = above + below;
  const Vector3d ahead = body.up.cross(kZ);
  for (const double level : {above - 2.5, 2.5 - below}) {  // just inside of both endplates
    const Vector3d middle = center + level * body.up;
    body.depth = std::max(body.depth, reach_mm(bone, middle, ahead) + reach_mm(bone, middle, -ahead));
    body.width = std::max(body.width, 2 * reach_mm(bone, middle + 0.1 * size_mm * ahead, kZ));
  }
  body.lower_width = 2 * reach_mm(bone, center + (1.2 - below) * body.up + 0.1 * size_mm * ahead, kZ);
  return body;
}
/// How far a direction leans forwards.
double lean_deg(const Vector3d& up) {
  return kDeg * std::atan2(up.x(), up.y());
}
/// From the end of a process to where the tip is stated; bones.md means its points to 5 mm.
Dimension tip(const std::string& bone, const std::string& process, const Vector3d& towards, const Vector3d& stated) {
  const Vector3d end = furthest(points_mm(bone), towards);
  return {bone + " " + process + " to the stated point", 0, 5, (end - stated).norm()};
}
/// Up with a given forward component.
Vector3d leaning(double x) {
  return {x, std::sqrt(1 - x * x), 0};
}

TEST(BoneDimensions, LumbarColumn) {
  std::vector<Body> bodies;
  std::vector<Dimension> rows;
  const double up_x[5] = {0.375, 0.139, -0.11, -0.23, -0.30};
  for (int level = 5; level >= 1; --level) {
    const std::string bone = "l" + std::to_string(level);
    const Body body = bodyOf(bone, leaning(up_x[5 - level]), 17);
    bodies.push_back(body);
    const Vector3d center = body.center;
    const Vector3d spinous = furthest(points_mm(bone, between(kZ, -6, 6)), -kX);
    const Vector3d transverse = furthest(points_mm(bone), kZ);
    rows.push_back({bone + " body depth", 34, 35, body.depth});
    rows.push_back({bone + " body width", 45, 51, body.width});
    rows.push_back({bone + " body height", 27, 28, body.height});
    rows.push_back({bone + " spinous tip behind the body", 70, 80, center.x() - spinous.x()});
    rows.push_back(tip(bone, "spinous tip", -kX, center - Vector3d{75, 8, 0}));
    // Superior articular and mammillary process: what stands out sideways, behind and above the body's middle.
    const auto mammillary = points_mm(bone, between(kX, center.x() - 60, center.x() - 30) &&
                                                between(kY, center.y() + 5, center.y() + 30) && between(kZ, 8, 30));
    rows.push_back({bone + " mammillary process, lateral", 18, 22, furthest(mammillary, kZ).z()});
    rows.push_back(
        {bone + " mammillary process behind the body", 38, 38, center.x() - furthest(mammillary, -kX).x()});
    rows.push_back({bone + " transverse tip, lateral", 42, 47, transverse.z()});
    rows.push_back({bone + " transverse tip behind the body", 32, 36, center.x() - transverse.x()});
  }
  for (std::size_t i = 1; i < bodies.size(); ++i)
    rows.push_back(
        {"disc l" + std::to_string(6 - i) + "/l" + std::to_string(5 - i), 8, 12,
         (bodies[i].center - bodies[i - 1].center).norm() - (bodies[i].height + bodies[i - 1].height) / 2});
  rows.push_back({"lordosis L1-S1", 55, 60, angle_deg(bodies.back().up, {0.643, 0.766, 0})});
  expectDimensions("lumbar", rows);
}

TEST(BoneDimensions, ThoracicColumn) {
  std::vector<Dimension> rows;
  for (const auto& [bone, up_x] : {std::pair{"t1", 0.62}, {"t4", 0.182}, {"t8", -0.1}, {"t12", -0.3}}) {
    const Body body = bodyOf(bone, leaning(up_x), 9);
    rows.push_back({std::string{bone} + " body width", 28, 42, body.width});
    rows.push_back({std::string{bone} + " body depth", 17, 32, body.depth});
    if (std::string{bone} == "t12") continue;  // its transverse process is but a stump
    const Vector3d transverse = furthest(points_mm(bone), kZ);
    rows.push_back({std::string{bone} + " transverse tip, lateral", 30, 36, transverse.z()});
    rows.push_back({std::string{bone} + " transverse tip behind the body", 28, 28, body.center.x() - transverse.x()});
  }
  const Vector3d t4 = bodyOf("t4", leaning(0.182), 9).up;
  const Vector3d t12 = bodyOf("t12", leaning(-0.3), 9).up;
  rows.push_back({"kyphosis T4-T12", 35, 45, angle_deg(t4, t12)});
  rows.push_back(tip("t1", "spinous tip", -kX, {-58, 255, 0}));
  rows.push_back(tip("t4", "spinous tip", -kX, {-85, 195, 0}));
  rows.push_back(tip("t8", "spinous tip", -kX, {-88, 90, 0}));
  rows.push_back(tip("t12", "spinous tip", -kX, {-68, 5, 0}));
  expectDimensions("thoracic", rows);
}

TEST(BoneDimensions, RibCage) {
  const auto sternum = points_mm("sternum");
  const Vector3d notch = furthest(points_mm("sternum", between(kZ, -4, 4)), kY),
                 angle = furthest(points_mm("sternum", between(kY, 163, 167) && between(kZ, -6, 6)), kX),
                 xiphisternal = landmark_mm("xiphisternal_joint");
  const Vector3d xiphoid = furthest(sternum, -kY);
  const Vector3d back = furthest(points_mm("t9", between(kZ, -5, 5)), -kX);
  const Vector3d front = furthest(points_mm("sternum", between(kY, 25, 60)), kX);
  expectDimensions("rib cage", {{"breadth at rib 8", 280, 300, 2 * furthest(points_mm("rib_8"), kZ).z()},
                                {"depth at the xiphoid with 10 mm of skin and fat in front and behind", 220, 240,
                                 front.x() - back.x() + 20},
                                {"manubrium", 50, 50, (notch - angle).norm()},
                                {"body of the sternum", 95, 105, (angle - xiphisternal).norm(), 120},
                                {"xiphoid", 30, 30, (xiphisternal - xiphoid).norm()}});
}

TEST(BoneDimensions, CervicalColumn) {
  std::vector<Dimension> rows;
  for (const auto& [bone, up_x] : {std::pair{"c7", 0.342}, {"c5", 0.19}, {"c3", 0.04}}) {
    const Body body = bodyOf(bone, leaning(up_x), 7);
    rows.push_back({std::string{bone} + " body depth", 15, 17, body.depth});
    rows.push_back({std::string{bone} + " body width", 17, 24, body.lower_width});
    rows.push_back({std::string{bone} + " transverse tubercle, lateral", 26, 34, furthest(points_mm(bone), kZ).z()});
  }
  rows.push_back(tip("c1", "transverse process", kZ, {6, 106, 40}));
  rows.push_back(tip("c2", "spinous tip", -kX, {-30, 91, 0}));
  rows.push_back(tip("c5", "spinous tip", -kX, {-40, 40, 0}));
  rows.push_back(tip("c7", "spinous tip", -kX, {-56, 3, 0}));
  // Between the lower endplates of C2 and C7 (Cobb).
  rows.push_back(
      {"lordosis C2-C7", 20, 35,
       lean_deg(bodyOf("c7", leaning(0.342), 7).lower_up) - lean_deg(bodyOf("c2", leaning(0), 7).lower_up)});
  expectDimensions("cervical", rows);
}

TEST(BoneDimensions, Skull) {
  constexpr double kScalp_mm = 5;  // either side: head measures are taken on the skin; own estimate
  const auto skull = points_mm("skull");
  const auto above_nose = points_mm("skull", between(kY, 50, 140));  // glabella to opisthocranion
  expectDimensions("skull", {{"head length with scalp", 195, 197, extent_mm(above_nose, kX) + 2 * kScalp_mm},
                             {"head breadth with scalp", 152, 155, extent_mm(skull, kZ) + 2 * kScalp_mm},
                             {"vertex to chin", 230, 230,
                              furthest(skull, kY).y() - furthest(points_mm("mandible"), -kY).y(), 202}});
}

}  // namespace
}  // namespace sinew::test
