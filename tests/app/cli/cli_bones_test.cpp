// `sinew model picture` and `sinew model replace-bones`, with the reference's own femur as another program would
// write it.
#include <cstdint>
#include <cstdio>
#include <fstream>

#include "core/file.h"
#include "core/geometry/mesh_io.h"
#include "tests/app/cli/cli_support.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

using test::documentOf;
using test::ProgramResult;
using test::sinewProgram;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const TriangleMesh& femur() {
  static const auto meshes = readMeshes(test::resourceDir() / "skeleton" / "bone_meshes.bin");
  for (const auto& mesh : meshes)
    if (mesh.bone == "femur_r") return mesh.mesh;
  throw std::logic_error{"the reference has a femur"};
}

std::string line(const char* format, const Eigen::Vector3d& p) {
  char text[96];
  std::snprintf(text, sizeof text, format, 1e3 * p.x(), 1e3 * p.y(), 1e3 * p.z());  // millimetres
  return text;
}

std::string binaryStl() {
  std::string out(80, ' ');
  const auto put = [&](const auto& value) { out.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(std::uint32_t(femur().triangles.size()));
  for (const auto& t : femur().triangles) {
    for (int i = 0; i < 3; ++i) put(0.0f);
    for (const auto v : t)
      for (int i = 0; i < 3; ++i) put(float(1e3 * femur().vertices[std::size_t(v)][i]));
    put(std::uint16_t{0});
  }
  return out;
}

std::string obj() {
  std::string out;
  for (const auto& v : femur().vertices) out += line("v %.6f %.6f %.6f\n", v);
  for (const auto& t : femur().triangles)
    out += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " + std::to_string(t[2] + 1) + "\n";
  return out;
}

std::string ply() {
  std::string out = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(femur().vertices.size()) +
                    "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                    std::to_string(femur().triangles.size()) +
                    "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& v : femur().vertices) out += line("%.6f %.6f %.6f\n", v);
  for (const auto& t : femur().triangles)
    out += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
  return out;
}

std::string vtp() {
  std::string points, cells, offsets;
  for (const auto& v : femur().vertices) points += line("%.6f %.6f %.6f\n", v);
  int end = 0;
  for (const auto& t : femur().triangles) {
    cells += std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
    offsets += std::to_string(end += 3) + " ";
  }
  return "<?xml version=\"1.0\"?><VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData>"
         "<Piece NumberOfPoints=\"" +
         std::to_string(femur().vertices.size()) +
         "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" " + "NumberOfPolys=\"" +
         std::to_string(femur().triangles.size()) +
         "\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">" + points +
         "</DataArray></Points><Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">" + cells +
         "</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">" + offsets +
         "</DataArray></Polys></Piece></PolyData></VTKFile>";
}

ProgramResult replace(const std::filesystem::path& mesh, const std::filesystem::path& output,
                      const std::vector<std::string>& more = {}) {
  std::vector<std::string> command{"model", "replace-bones", "reference", "--meshes", mesh.string(), "--unit", "mm",
                                   "-o",    output.string(), "--json"};
  command.insert(command.end(), more.begin(), more.end());
  return sinewProgram(command);
}

TEST(CliBones, EveryFormatOfASurfaceLandsInItsPlace) {
  for (const auto& [ending, content] :
       {std::pair{"stl", binaryStl()}, {"obj", obj()}, {"ply", ply()}, {"vtp", vtp()}}) {
    const test::TemporaryFolder folder;
    const auto mesh = folder / (std::string{"femur_r."} + ending);
    writeFileAtomically(mesh, content);
    const ProgramResult result = replace(mesh, folder / "mine.json");
    ASSERT_EQ(result.status, 0) << ending << result.out << result.err;
    const Json document = documentOf(result);
    EXPECT_GT(document["attachments"].size(), 40u) << ending;
    for (const auto& a : document["attachments"]) EXPECT_LT(a["moved_mm"].get<double>(), 0.05) << ending << a;
    EXPECT_TRUE(document["warnings"].empty()) << ending << document["warnings"];
    EXPECT_EQ(sinewProgram({"model", "validate", (folder / "mine.json").string()}).status, 0) << ending;
  }
}

TEST(CliBones, FilesMayHaveOtherNamesAndLandmarksPlaceThem) {
  const test::TemporaryFolder folder;
  writeFileAtomically(folder / "scan 7.stl", binaryStl());
  writeFileAtomically(folder / "names.csv", "file,bone\nscan 7.stl,femur_r\n");
  writeFileAtomically(
      folder / "picks.csv",
      "name,x,y,z\nfemoral_head_center_r,0,0,0\nknee_center_r,0,-422,0\nmedial_epicondyle_r,0,-418,-42\n");
  const ProgramResult result =
      replace(folder / "scan 7.stl", folder / "mine.json",
              {"--names", (folder / "names.csv").string(), "--landmarks", (folder / "picks.csv").string()});
  ASSERT_EQ(result.status, 0) << result.out;
  const Json document = documentOf(result);
  EXPECT_EQ(document["segments"][0]["landmarks"], 3);
  EXPECT_LT(document["segments"][0]["rms_mm"].get<double>(), 1.5);  // picked to a millimetre
  EXPECT_EQ(document["joints"][0]["joint"], "knee_r");
}

TEST(CliBones, BrokenInputIsNamed) {
  const test::TemporaryFolder folder;
  writeFileAtomically(folder / "femur_r.stl", "nothing of that kind");
  EXPECT_EQ(replace(folder / "femur_r.stl", folder / "mine.json").status, 2);
  writeFileAtomically(folder / "femur_r.ply", "ply\nformat ascii 1.0\nend_header\n");
  EXPECT_EQ(replace(folder / "femur_r.ply", folder / "mine.json").status, 2);
  writeFileAtomically(folder / "thigh.obj", obj());
  EXPECT_THAT(replace(folder / "thigh.obj", folder / "mine.json").out, HasSubstr("nearest"));
  EXPECT_EQ(replace(folder / "absent.stl", folder / "mine.json").status, 2);
  writeFileAtomically(folder / "femur_r.obj", obj());
  const ProgramResult metres =
      sinewProgram({"model", "replace-bones", "reference", "--meshes", (folder / "femur_r.obj").string(), "--unit",
                    "m", "-o", (folder / "mine.json").string()});
  EXPECT_EQ(metres.status, 2);
  EXPECT_THAT(metres.err, HasSubstr("unit"));
  EXPECT_EQ(sinewProgram({"model", "replace-bones", "reference", "--meshes", (folder / "femur_r.obj").string(), "-o",
                          (folder / "mine.json").string()})
                .status,
            2);  // the unit is stated, not guessed
  EXPECT_FALSE(std::filesystem::exists(folder / "mine.json"));
}

TEST(CliBones, PicturesAreDrawnWithoutADisplay) {
  const test::TemporaryFolder folder;
  const auto file = (folder / "femur.png").string();
  const ProgramResult result = sinewProgram({"model", "picture", "reference", "--bones", "femur_r,patella", "--view",
                                             "back", "--size", "60x120", "-o", file, "--json"});
  ASSERT_EQ(result.status, 0) << result.out;
  EXPECT_EQ(documentOf(result)["bones"], 3);  // one femur, both patellae
  EXPECT_THAT(readFile(file), StartsWith("\x89PNG"));
  EXPECT_THAT(sinewProgram({"model", "picture", "reference", "--bones", "femr_r", "-o", file}).err,
              HasSubstr("femur_r"));
  EXPECT_EQ(sinewProgram({"model", "picture", "reference", "--size", "9x9", "-o", file}).status, 2);
  EXPECT_EQ(sinewProgram({"model", "picture", "reference", "--view", "above", "-o", file}).status, 2);
}

}  // namespace
}  // namespace sinew
