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

// Dimensions: bone_dimensions_*_test.cpp.

TEST(BoneShapes, SocketAndForamenOfTheHipBoneAreOpen) {
  const BoneShape& hip = shape("hip_bone");
  const Vector3d center = landmark("acetabulum_center_r");
  for (const Vector3d& wall : {Vector3d{-0.5, 0.5, -0.3}, Vector3d{0, 1, 0}, Vector3d{-0.3, 0.9, 0.3}})
    EXPECT_NEAR((hip.pieces[0].nearestSurfacePoint(center + 0.026 * wall.normalized()) - center).norm(), 0.026,
                0.001);
  EXPECT_GT(hip.distance(landmark("obturator_membrane_center_r")), 0.010);
}

TEST(BoneShapes, TheFootStandsOnTheFloor) {
  double floor = 1;
  for (const auto& mesh : readMeshes(test::resourceDir() / "skeleton" / "bone_meshes.bin"))
    if (mesh.segment == "foot_r")
      for (const auto& v : mesh.mesh.vertices) floor = std::min(floor, v.y());
  EXPECT_GT(floor, -0.0755);
  EXPECT_LT(floor, -0.074);
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
