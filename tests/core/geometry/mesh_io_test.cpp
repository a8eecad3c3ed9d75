#include "core/geometry/mesh_io.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "core/file.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

NamedMesh tetrahedron() {
  return {"femur_r",
          "femur_r",
          {{{0, 0, 0}, {0.4, 0, 0}, {0, 0.1, 0}, {0, 0, 0.05}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}}};
}

TEST(MeshIo, RoundTripKeepsNamesTrianglesAndPlaces) {
  const test::TemporaryFolder folder;
  auto other = tetrahedron();
  other.bone = "sacrum";
  other.segment = "pelvis";
  writeMeshes({tetrahedron(), other}, folder / "m.bin");
  const auto meshes = readMeshes(folder / "m.bin");
  ASSERT_EQ(meshes.size(), 2u);
  EXPECT_EQ(meshes[1].bone, "sacrum");
  EXPECT_EQ(meshes[1].segment, "pelvis");
  EXPECT_EQ(meshes[0].mesh.triangles, tetrahedron().mesh.triangles);
  EXPECT_TRUE(isWatertight(meshes[0].mesh));
  for (std::size_t i = 0; i < 4; ++i)  // half a step of 0.4 m / 65535
    EXPECT_LT((meshes[0].mesh.vertices[i] - tetrahedron().mesh.vertices[i]).norm(), 5e-6);
}

std::string complaint(const std::filesystem::path& file) {
  try {
    readMeshes(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(MeshIo, DamagedFilesAreNamedAndRefused) {
  const test::TemporaryFolder folder;
  writeMeshes({tetrahedron()}, folder / "m.bin");
  const std::string good = readFile(folder / "m.bin");
  for (std::size_t size = 8; size < good.size(); size += 7) {  // truncated anywhere
    writeFileAtomically(folder / "cut.bin", good.substr(0, size));
    EXPECT_THAT(complaint(folder / "cut.bin"), testing::HasSubstr("end of file")) << size;
  }
  writeFileAtomically(folder / "long.bin", good + "x");
  EXPECT_THAT(complaint(folder / "long.bin"), testing::HasSubstr("more bytes"));
  writeFileAtomically(folder / "else.bin", "solid stl");
  EXPECT_THAT(complaint(folder / "else.bin"), testing::HasSubstr("SINEWMSH"));
  std::string future = good;
  future[8] = 2;
  writeFileAtomically(folder / "future.bin", future);
  EXPECT_THAT(complaint(folder / "future.bin"), testing::HasSubstr("version"));
  std::string index = good;
  index[index.size() - 4] = 9;  // last triangle's last vertex
  writeFileAtomically(folder / "index.bin", index);
  EXPECT_THAT(complaint(folder / "index.bin"), testing::HasSubstr("vertex index below 4"));
}

}  // namespace
}  // namespace sinew
