// Dimensions of the bones of the leg, measured on the meshes; figures: Yoshioka 1987 and 1989, Mahfouz 2012, Jakob
// 1980, Isman and Inman 1969, Trotter and Gleser 1952.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/support/bone_measures.h"

namespace sinew::test {
namespace {

constexpr double kRad = 3.14159265358979 / 180;

/// Centre line of a shaft: centres of sections across y.
std::vector<Vector3d> centerLine(const std::string& bone, double from_mm, double to_mm, int sections = 12) {
  std::vector<Vector3d> line;
  for (int i = 0; i < sections; ++i) {
    const double y = from_mm + (to_mm - from_mm) * i / (sections - 1);
    line.push_back(section(bone, y * kY, kY).center);
  }
  return line;
}

/// Largest distance of a line's points from the chord between its ends.
double sagitta(const std::vector<Vector3d>& line, const Vector3d& axis) {
  const Vector3d chord = line.back() - line.front();
  double largest = 0;
  for (const auto& p : line) largest = std::max(largest, across(p - line.front(), chord).dot(axis));
  return largest;
}

TEST(BoneDimensions, Femur) {
  const Sphere head = fittedSphere(points_mm("femur", [](const Vector3d& p) { return p.norm() < 26 && p.z() < 5; }));
  // Middle of the neck: section across the line from the head to the base of the neck.
  const Vector3d base = landmark_mm("femoral_neck_base_r"), along = base.normalized();
  const auto at = [&](double share) {
    return section("femur", share * base, along, [&](const Vector3d& p) { return (p - share * base).norm() < 26; })
        .center;
  };
  const Vector3d neck = (at(0.55) - head.center).normalized();
  const auto shaft = centerLine("femur", -130, -250);
  const Vector3d shaft_axis = fittedDirection(shaft), shaft_middle = mean(shaft);
  const Vector3d condyles = furthest(points_mm("femur", between(kY, -440, -405) && between(kZ, 10, 40)), -kX) -
                            furthest(points_mm("femur", between(kY, -440, -405) && between(kZ, -40, -10)), -kX);
  const Vector3d neck_flat = across(neck, kY), condyles_flat = across(condyles, kY);
  const double anteversion =
      std::copysign(angle_deg(neck_flat, condyles_flat), condyles_flat.cross(neck_flat).dot(-kY));
  const double neck_shaft = angle_deg(-neck, shaft_axis),
               offset = across(shaft_middle - head.center, shaft_axis).norm();
  const Vector3d normal = kX;
  const auto condyleCircle = [&](double z_mm) {
    return fittedCircle(
               section("femur", z_mm * kZ, kZ, [](const Vector3d& p) { return p.x() < -8 && p.y() < -412; }).points,
               kZ)
        .radius;
  };
  const Section middle = section("femur", -200 * kY, kY);
  const Section groove = section("femur", -412 * kY, kY, [](const Vector3d& p) { return p.x() > 8; });
  const auto front = [&](double low, double high) {
    double x = -1e9;
    for (const auto& p : groove.points)
      if (p.z() > low && p.z() < high) x = std::max(x, p.x());
    return x;
  };
  const double lateral = front(8, 35), medial = front(-35, -8);
  const double deepest = front(-1, 3);
  const auto bow = centerLine("femur", -70, -366, 25);
  const double bow_chord = (bow.back() - bow.front()).norm(), bow_height = sagitta(bow, kX);
  const Vector3d lowest =
      furthest(points_mm("femur", between(kZ, 8, 40)), -kY) - furthest(points_mm("femur", between(kZ, -40, -8)), -kY);
  expectDimensions(
      "femur",
      {{"head diameter", 48, 48, 2 * head.radius},
       {"neck-shaft angle", 126, 128, neck_shaft},
       {"anteversion", 5, 19, anteversion},
       {"offset, head to shaft axis", 43, 43, offset},
       {"neck length, head to shaft axis", 47, 50, offset / std::sin(neck_shaft * 3.14159265358979 / 180), 53.8},
       {"maximum length", 455, 473, extent_mm(points_mm("femur"), kY)},
       {"mechanical length", 422, 422, landmark_mm("knee_center_r").norm()},
       {"shaft diameter, sagittal", 27, 28, extent_mm(middle.points, kX)},
       {"shaft diameter, frontal", 27, 28, extent_mm(middle.points, kZ)},
       {"sagitta of the bow", 9, 10, bow_height},
       {"radius of the bow", 1100, 1200, (bow_chord * bow_chord / (4 * bow_height) + bow_height) / 2},
       {"anatomical to mechanical axis", 6, 6, angle_deg(across(shaft_axis, normal), -kY)},
       // Of the shaft to the perpendicular of the tangent below both condyles, in the frontal plane.
       {"bicondylar angle", 9, 10, angle_deg(across(shaft_axis, kX), kX.cross(across(lowest, kX)))},
       {"epicondylar width", 82, 82, extent_mm(points_mm("femur", between(kY, -432, -404)), kZ)},
       {"condylar depth", 62, 65, extent_mm(points_mm("femur", between(kY, -450, -390)), kX)},
       {"posterior condyle radius, medial", 21, 22, condyleCircle(-24)},
       {"posterior condyle radius, lateral", 21, 22, condyleCircle(24)},
       {"trochlear groove depth", 5, 6, (lateral + medial) / 2 - deepest}});
}

TEST(BoneDimensions, Patella) {
  const auto all = points_mm("patella");
  // In extension, in the frame of the tibia; the ligament ends where the tuberosity stands out most.
  const Vector3d center = 46 * Vector3d{std::cos(12.5 * kRad), std::sin(12.5 * kRad), 0};
  const auto tuberosity = points_mm("tibia", between(kY, -75, -40) && between(kZ, -8, 14));
  const double ligament = (center + furthest(all, -kY) - furthest(tuberosity, kX)).norm();
  expectDimensions("patella", {{"height", 42, 45, extent_mm(all, kY)},
                               {"width", 44, 46, extent_mm(all, kZ)},
                               {"thickness", 20, 24, extent_mm(all, kX)},
                               {"articular ridge behind the centre", 10, 10,
                                -furthest(points_mm("patella", between(kY, -4, 10)), -kX).x()},
                               {"ligament, apex to tuberosity", 45, 55, ligament},
                               {"Insall-Salvati ratio", 0.8, 1.2, ligament / extent_mm(all, kY)}});
}

TEST(BoneDimensions, Tibia) {
  const auto plateau = points_mm("tibia", between(kY, -50, -20));
  // Joint surfaces of both condyles without the eminence between them.
  const auto surfaces = points_mm("tibia", [](const Vector3d& p) {
    return p.y() > -34 && std::abs(p.z()) > 12 && std::abs(p.z()) < 30 && std::abs(p.x() + 4) < 16;
  });
  Vector3d slope = fittedNormal(surfaces);
  if (slope.y() < 0) slope = -slope;
  const Vector3d level{slope.y(), -slope.x(), 0};  // along the plateau, forwards
  const auto rim = points_mm("tibia", between(slope, mean(surfaces).dot(slope) - 9, mean(surfaces).dot(slope) + 4));
  const Vector3d behind = furthest(points_mm("tibia", between(kY, -48, -30) && between(kZ, 8, 35)), -kX) -
                          furthest(points_mm("tibia", between(kY, -48, -30) && between(kZ, -35, -8)), -kX);
  const Vector3d malleoli = landmark_mm("lateral_malleolus_r") - landmark_mm("medial_malleolus_r");
  const auto turn = [](const Vector3d& v) { return std::atan2(v.x(), v.z()) * 180 / 3.14159265358979; };
  const Section middle = section("tibia", -250 * kY, kY);
  const auto ridge = points_mm("tibia", between(kY, -75, -40) && between(kZ, -8, 14));
  const double prominence = furthest(ridge, kX).x();
  const Vector3d tuberosity =
      furthest(points_mm("tibia", between(kX, prominence - 2, 60) && between(kZ, -8, 14)), kY);
  const Vector3d distal_axis{0.951, 0, 0.309}, distal_across{-0.309, 0, 0.951};  // of the ankle: forwards, sideways
  const auto distal = section("tibia", -390 * kY, kY).points;                    // above the malleolus
  const auto plafond =
      section("tibia", -400 * kY, kY, [&](const Vector3d& p) { return p.dot(distal_across) > -15; }).points;
  std::vector<Vector3d> ankle = points_mm("tibia", between(kY, -440, -415));
  const auto lateral = points_mm("fibula", between(kY, -440, -415));
  ankle.insert(ankle.end(), lateral.begin(), lateral.end());
  expectDimensions("tibia", {{"length without spines and malleolus", 379, 379,
                              landmark_mm("tibial_plafond_center_r").y() * -1 + mean(surfaces).y()},
                             {"plateau width", 75, 75, extent_mm(plateau, kZ)},
                             {"plateau depth", 50, 50, extent_mm(rim, level)},
                             {"posterior slope", 7, 9, angle_deg(across(slope, kZ), kY)},
                             {"plateau below the knee axis", 28, 28, -mean(surfaces).y()},
                             {"torsion", 23, 30, turn(behind) - turn(malleoli)},
                             {"mid shaft, sagittal", 29, 29, extent_mm(middle.points, kX)},
                             {"mid shaft, frontal", 23, 23, extent_mm(middle.points, kZ)},
                             {"tuberosity below the plateau", 22, 27, mean(surfaces).y() - tuberosity.y()},
                             {"distal width", 45, 48, extent_mm(distal, distal_across)},
                             {"distal depth", 38, 40, extent_mm(plafond, distal_axis)},
                             {"malleolar width", 68, 72, extent_mm(ankle, distal_across)}});
}

TEST(BoneDimensions, Fibula) {
  const Section middle = section("fibula", -230 * kY, kY);
  expectDimensions("fibula", {{"length", 382, 382, extent_mm(points_mm("fibula"), kY), 409},
                              {"mid diameter, sagittal", 13, 15, extent_mm(middle.points, kX)},
                              {"mid diameter, frontal", 13, 15, extent_mm(middle.points, kZ)}});
}

TEST(BoneDimensions, Foot) {
  const Vector3d heel = furthest(points_mm("calcaneus"), -kX), toe = furthest(points_mm("toes"), kX);
  const Vector3d axis{-0.309, 0, 0.951};  // of the ankle
  const auto dome = points_mm("talus", [&](const Vector3d& p) { return p.y() > 8 && std::abs(p.x()) < 17; });
  std::vector<Vector3d> flat;
  for (const auto& p : dome)  // the shoulders beside the groove
    if (const double s = std::abs(p.dot(axis) - 1.6); s > 10 && s < 14.5) flat.push_back(across(p, axis));
  const Vector3d lowest = furthest(points_mm("calcaneus", between(kX, -60, -30)), -kY);
  const Vector3d front = furthest(points_mm("calcaneus", between(kX, 5, 30)), -kY);
  const Vector3d malleoli = landmark_mm("lateral_malleolus_r") - landmark_mm("medial_malleolus_r");
  const auto heads = points_mm("metatarsals", between(kX, 90, 140));
  expectDimensions("foot",
                   {{"length with skin 3 mm", 258, 258, toe.x() - heel.x() + 3},
                    {"breadth at the heads with 6 mm of skin on either side", 98, 102, extent_mm(heads, kZ) + 12},
                    {"talar dome radius", 20, 21, fittedCircle(flat, axis).radius},
                    {"calcaneus length", 80, 82, extent_mm(points_mm("calcaneus"), kX)},
                    {"calcaneal pitch", 20, 25, angle_deg(across(front - lowest, kZ), kX)},
                    {"malleoli to the tibia, frontal", 82, 82, angle_deg(across(malleoli, kX), -kY), 79},
                    {"malleoli turned outwards", 20, 30, angle_deg(across(malleoli, kY), kZ), 18}});
}

}  // namespace
}  // namespace sinew::test
