#include "core/model/bone_meshes.h"

#include <gtest/gtest.h>

#include <map>

#include "core/geometry/mesh_io.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

const std::vector<NamedMesh>& stored() {
  static const auto meshes = readMeshes(test::resourceDir() / "skeleton" / "bone_meshes.bin");
  return meshes;
}

TEST(BoneMeshes, AreClosedAndFaceOutwards) {
  for (const auto& bone : stored()) {
    EXPECT_TRUE(isWatertight(bone.mesh)) << bone.bone;
    EXPECT_GT(signedVolume_m3(bone.mesh), 5e-7) << bone.bone;  // half a millilitre
    EXPECT_GE(bone.mesh.triangles.size(), 2000u) << bone.bone;
    EXPECT_LE(bone.mesh.triangles.size(), 10000u) << bone.bone;
  }
}

TEST(BoneMeshes, MirroringKeepsVolumeAndWinding) {
  for (const auto& bone : stored()) {
    const TriangleMesh left = mirrored(bone.mesh);
    EXPECT_TRUE(isWatertight(left));
    EXPECT_NEAR(signedVolume_m3(left), signedVolume_m3(bone.mesh), 1e-12);
    EXPECT_EQ(left.vertices[0].z(), -bone.mesh.vertices[0].z());
  }
}

TEST(BoneMeshes, LoadGivesBothSidesOnTheirSegments) {
  Skeleton skeleton;
  for (const auto& bone : stored())
    for (const auto& name : {bone.segment, std::string{withoutSide(bone.segment)} + "_l"})
      skeleton.segments.push_back({name, -1, 0, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()});
  const auto bones = loadBoneMeshes(test::resourceDir(), skeleton);
  std::map<std::string, const BoneMesh*> by_name;
  for (const auto& bone : *bones) by_name[bone.bone] = &bone;
  EXPECT_EQ(by_name.size(), bones->size());  // names are unique
  ASSERT_TRUE(by_name.contains("femur_l") && by_name.contains("sacrum"));
  EXPECT_FALSE(by_name.contains("sacrum_l"));
  EXPECT_EQ(skeleton.segments[static_cast<std::size_t>(by_name["femur_l"]->segment)].name, "femur_l");
  EXPECT_EQ(skeleton.segments[static_cast<std::size_t>(by_name["hip_bone_l"]->segment)].name, "pelvis");
  EXPECT_EQ(by_name["femur_l"]->mesh.vertices[5].z(), -by_name["femur_r"]->mesh.vertices[5].z());
}

}  // namespace
}  // namespace sinew
