#include "core/geometry/bone_shapes.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/error.h"
#include "core/file.h"
#include "core/geometry/mesh_io.h"
#include "core/text.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

using Eigen::Vector3d;

struct NamedPoint {
  std::string name, segment, bone;
  Vector3d p;
};

std::vector<NamedPoint> landmarks() {
  const std::string text = readFile(test::resourceDir() / "skeleton" / "landmarks.csv");
  std::vector<NamedPoint> points;
  std::istringstream in{text};
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    const auto c = splitCsvLine(line);
    points.push_back({c.at(0), c.at(1), c.at(2), {std::stod(c.at(3)), std::stod(c.at(4)), std::stod(c.at(5))}});
  }
  return points;
}

Vector3d landmark(const std::string& name) {
  for (const auto& point : landmarks())
    if (point.name == name) return point.p;
  throw InputError{"no landmark " + name};
}

const std::vector<BoneShape>& shapes() {
  static const std::vector<BoneShape> all = loadBoneShapes(test::resourceDir());
  return all;
}

const BoneShape& shape(const std::string& bone) {
  for (const auto& s : shapes())
    if (s.name == bone || s.name == bone + "_r") return s;
  throw InputError{"no bone " + bone};
}

Vector3d nearest(const BoneShape& bone, const Vector3d& p) {
  const auto closer = [&](const ImplicitSurface& a, const ImplicitSurface& b) {
    return std::abs(a.distance(p)) < std::abs(b.distance(p));
  };
  return std::min_element(bone.pieces.begin(), bone.pieces.end(), closer)->nearestSurfacePoint(p);
}

/// Centres, axis points and points of the skin: not on the surface of a bone.
const std::set<std::string> kNotOnBone{"acetabulum_center_r",
                                       "hip_center_midpoint",
                                       "obturator_membrane_center_r",
                                       "pubic_symphysis_top",
                                       "pubic_symphysis_bottom",
                                       "femoral_head_center_r",
                                       "femoral_neck_base_r",
                                       "femoral_shaft_proximal_r",
                                       "femoral_shaft_middle_r",
                                       "femoral_shaft_lower_r",
                                       "femoral_shaft_distal_r",
                                       "medial_condyle_center_r",
                                       "lateral_condyle_center_r",
                                       "knee_center_r",
                                       "patella_center_r",
                                       "tibial_shaft_proximal_r",
                                       "tibial_shaft_middle_r",
                                       "tibial_shaft_distal_r",
                                       "anterior_ankle_r",
                                       "ankle_center_r",
                                       "fibula_neck_r",
                                       "fibula_shaft_middle_r",
                                       "talar_dome_center_r",
                                       "heel_contact_medial_r",
                                       "heel_contact_lateral_r",
                                       "metatarsal_1_contact_r",
                                       "metatarsal_5_contact_r",
                                       "toe_contact_r",
                                       "metatarsal_1_head_r",
                                       "metatarsal_5_head_r",
                                       "hallux_tip_r",
                                       "acromioclavicular_joint_r",
                                       "humeral_shaft_proximal_r",
                                       "humeral_shaft_distal_r",
                                       "ulnar_head_r",
                                       "metacarpal_3_head_r",
                                       "tragion_r",
                                       "thumb_tip_r",
                                       "fingertip_3_r"};

constexpr double kOnSurface_m = 0.003;  // what bones of this kind promise

TEST(BoneShapes, EveryLandmarkLiesOnItsBone) {
  for (const auto& l : landmarks()) {
    if (kNotOnBone.contains(l.name) || l.name.find("_center") != std::string::npos) continue;
    if (l.bone == "abdominal_wall") continue;
    EXPECT_LT(std::abs(shape(l.bone).distance(l.p)), kOnSurface_m)
        << l.name << " " << 1e3 * shape(l.bone).distance(l.p) << " mm, surface at "
        << 1e3 * nearest(shape(l.bone), l.p).transpose();
    EXPECT_EQ(shape(l.bone).segment, l.segment) << l.name;
  }
}

/// Size of a bone's mesh along `axis` (unit), of the part with y between `from` and `to`.
double extent_mm(const std::string& bone, Vector3d axis, double from_m = -9, double to_m = 9) {
  static const auto meshes = readMeshes(test::resourceDir() / "skeleton" / "bone_meshes.bin");
  double low = 9, high = -9;
  axis.normalize();
  for (const auto& mesh : meshes)
    if (mesh.bone == bone)
      for (const auto& v : mesh.mesh.vertices)
        if (v.y() > from_m && v.y() < to_m) {
          low = std::min(low, v.dot(axis));
          high = std::max(high, v.dot(axis));
        }
  return 1e3 * (high - low);
}

constexpr double kShare = 0.04;  // of a stated dimension; landmarks themselves are +-5 mm
#define EXPECT_DIMENSION(measured, stated) EXPECT_NEAR(measured, stated, kShare*(stated))

const Vector3d kX = Vector3d::UnitX(), kY = Vector3d::UnitY(), kZ = Vector3d::UnitZ();

TEST(BoneShapes, FemurHasItsDimensions) {  // Yoshioka 1987, Mahfouz 2012
  EXPECT_DIMENSION(1e3 * (shape("femur").pieces[0].nearestSurfacePoint({0.001, 0.024, -0.01}).norm()) * 2, 48);
  EXPECT_DIMENSION(extent_mm("femur_r", kZ, -0.43, -0.405), 82);     // epicondylar width
  EXPECT_DIMENSION(extent_mm("femur_r", kX, -0.44, -0.39), 64);      // condylar depth
  EXPECT_DIMENSION(extent_mm("femur_r", kY), 464);                   // maximum length 455-473
  EXPECT_DIMENSION(extent_mm("femur_r", kZ, -0.205, -0.195), 27.5);  // mid shaft
  const Vector3d neck = -landmark("femoral_neck_base_r");
  const Vector3d shaft = landmark("femoral_shaft_middle_r") - landmark("femoral_shaft_proximal_r");
  const double neck_shaft_deg = std::acos(neck.normalized().dot(shaft.normalized())) * 180 / 3.14159265358979;
  EXPECT_NEAR(neck_shaft_deg, 127, 2);
  EXPECT_NEAR(std::atan2(neck.x(), -neck.z()) * 180 / 3.14159265358979, 12, 1);  // anteversion
}

TEST(BoneShapes, TibiaFibulaAndPatellaHaveTheirDimensions) {  // Yoshioka 1989, Jakob 1980
  EXPECT_DIMENSION(extent_mm("tibia_r", kZ, -0.045, -0.03), 75);
  EXPECT_DIMENSION(extent_mm("tibia_r", {0.99, 0.139, 0}, -0.036, -0.02), 50);
  EXPECT_NEAR(extent_mm("tibia_r", kX, -0.255, -0.245), 29, 1.5);
  EXPECT_NEAR(extent_mm("tibia_r", kZ, -0.255, -0.245), 23, 1.5);
  EXPECT_DIMENSION(extent_mm("patella_r", kY), 43.5);
  EXPECT_DIMENSION(extent_mm("patella_r", kZ), 45);
  EXPECT_NEAR(extent_mm("patella_r", kX), 22, 2);  // 20-24
  EXPECT_NEAR(extent_mm("fibula_r", kZ, -0.235, -0.225), 14, 1);
  const Vector3d mortise = landmark("lateral_malleolus_r") - landmark("medial_malleolus_r");
  EXPECT_DIMENSION(1e3 * std::hypot(mortise.x(), mortise.z()), 70);
  const Vector3d plateau = landmark("posterior_plateau_lateral_r") - landmark("posterior_plateau_medial_r");
  const double torsion_deg =
      (std::atan2(plateau.x(), plateau.z()) - std::atan2(mortise.x(), mortise.z())) * 180 / 3.14159265358979;
  EXPECT_NEAR(torsion_deg, 25, 2);
}

TEST(BoneShapes, PelvisHasItsDimensions) {  // Bell 1990, Murray 1993, Legaye 1998
  EXPECT_DIMENSION(2e3 * landmark("asis_r").z(), 240);
  EXPECT_DIMENSION(1e3 * (landmark("asis_r") - landmark("psis_r")).x(), 150);
  double widest = 0;
  for (const auto& mesh : readMeshes(test::resourceDir() / "skeleton" / "bone_meshes.bin"))
    if (mesh.bone == "hip_bone_r")
      for (const auto& v : mesh.mesh.vertices) widest = std::max(widest, v.z());
  EXPECT_DIMENSION(2e3 * widest, 282);                   // bicristal
  EXPECT_NEAR(extent_mm("hip_bone_r", kY), 207.5, 8);    // crest to ischium, 200-215
  EXPECT_DIMENSION(extent_mm("sacrum", kZ, 0.06), 108);  // across the alae
  const BoneShape& hip = shape("hip_bone");
  const Vector3d center = landmark("acetabulum_center_r");
  for (const Vector3d& wall : {Vector3d{-0.5, 0.5, -0.3}, Vector3d{0, 1, 0}, Vector3d{-0.3, 0.9, 0.3}})
    EXPECT_NEAR((hip.pieces[0].nearestSurfacePoint(center + 0.026 * wall.normalized()) - center).norm(), 0.026,
                0.001);
  EXPECT_GT(hip.distance(landmark("obturator_membrane_center_r")), 0.010);  // the foramen is open
}

TEST(BoneShapes, FootHasItsDimensions) {
  EXPECT_NEAR(extent_mm("calcaneus_r", kX), 81, 5);
  // The rim of the dome lies its radius above the centre, 20-21 mm.
  EXPECT_LT(std::abs(shape("talus").distance({-0.004, 0.0203, 0.0125})), 0.001);
  const auto meshes = readMeshes(test::resourceDir() / "skeleton" / "bone_meshes.bin");
  double heel = 1, toe = -1, floor = 1;
  for (const auto& mesh : meshes)
    if (mesh.segment == "foot_r")
      for (const auto& v : mesh.mesh.vertices) {
        heel = std::min(heel, v.x());
        toe = std::max(toe, v.x());
        floor = std::min(floor, v.y());
      }
  EXPECT_DIMENSION(1e3 * (toe - heel), 255);  // 258 with the skin of the toe
  EXPECT_GT(floor, -0.0755);                  // nothing below the floor
}

TEST(BoneShapes, TrunkAndArmHaveTheirDimensions) {
  EXPECT_NEAR(2e3 * nearest(shape("rib_8"), {0.02, 0.0455, 0.15}).z(), 285, 10);  // chest breadth 280-300
  EXPECT_DIMENSION(extent_mm("humerus_r", kX, -0.31, 0.03) > 0 ? extent_mm("humerus_r", kZ, -0.289, -0.28) : 0, 64);
  EXPECT_DIMENSION(extent_mm("humerus_r", kY), 324);  // Trotter and Gleser 318-336
  EXPECT_NEAR(extent_mm("humerus_r", kZ, -0.155, -0.145), 22.5, 1);
  EXPECT_DIMENSION(extent_mm("radius_r", kY), 248);
  EXPECT_NEAR(extent_mm("radius_r", kZ, -0.003, 0.001), 22.5, 1);
  EXPECT_DIMENSION(extent_mm("ulna_r", kY), 269);
  EXPECT_DIMENSION(
      extent_mm("scapula_r", landmark("scapula_superior_angle_r") - landmark("scapula_inferior_angle_r")), 157);
  EXPECT_DIMENSION(extent_mm("clavicle_r", landmark("clavicle_acromial_end_r")), 151);
  EXPECT_DIMENSION(extent_mm("skull", kX), 190);         // head length 195-197 with skin
  EXPECT_DIMENSION(extent_mm("skull", kZ), 148);         // breadth 152-155 with skin
  EXPECT_NEAR(extent_mm("l3", kZ, 0.085, 0.10), 88, 4);  // across the transverse processes
  EXPECT_NEAR(extent_mm("sternum", kY), 187, 6);         // 50 + 95-105 + 30, inclined
}

std::string complaint(const std::string& pieces) {
  const std::string text =
      R"({"format":"sinew.bones","version":1,"bones":[{"name":"b","segment":"pelvis","voxel_mm":1,)"
      R"("triangles":2000,"pieces":)" +
      pieces + "}]}";
  try {
    readBoneShapes(text, "bones.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(BoneShapes, BadDescriptionsAreNamed) {
  using testing::HasSubstr;
  EXPECT_EQ(complaint(R"([[{"what":"head","shape":"sphere","center_mm":[0,0,0],"radius_mm":24}]])"), "none");
  EXPECT_THAT(complaint(R"([[{"what":"head","shape":"sphere","center_mm":[0,0,0],"radius_mm":-24}]])"),
              HasSubstr("radius_mm"));
  EXPECT_THAT(complaint(R"([[{"what":"head","shape":"egg"}]])"), HasSubstr("shape"));
  EXPECT_THAT(complaint(R"([[{"what":"rib","shape":"tube","stations_mm":[[0,0,0,5]]}]])"), HasSubstr("at least 2"));
  EXPECT_THAT(complaint(R"([[{"what":"rib","shape":"tube","stations_mm":[[0,0,0,5],[0,0,0,5]]}]])"),
              HasSubstr("stations_mm"));
  EXPECT_THAT(complaint(R"([[{"what":"rib","shape":"tube","stations_mm":[[0,0,0],[0,9,0]]}]])"),
              HasSubstr("numbers"));
  EXPECT_THAT(complaint(R"([[{"what":"s","shape":"sheet","rows_mm":[[[0,0,0,1],[9,0,0,1]],[[0,9,0,1]]]}]])"),
              HasSubstr("equal length"));
  EXPECT_THAT(complaint(R"([[{"what":"pit","shape":"sphere","center_mm":[0,0,0],"radius_mm":2,"join":"cut"}]])"),
              HasSubstr("first is added"));
  EXPECT_THAT(complaint(R"([[{"shape":"sphere","center_mm":[0,0,0],"radius_mm":2}]])"), HasSubstr("what"));
  EXPECT_THAT(complaint(R"([[{"what":"b","shape":"box","center_mm":[0,0,0],"half_mm":[2,2,2],"u_axis":[0,1,0]}]])"),
              HasSubstr("parallel"));
  EXPECT_THROW(loadBoneShapes("/nowhere"), InputError);
}

}  // namespace
}  // namespace sinew
