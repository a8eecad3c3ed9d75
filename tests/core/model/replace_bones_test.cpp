#include "core/model/replace_bones.h"

#include <gmock/gmock.h>

#include <fstream>

#include "core/file.h"
#include "core/geometry/mesh_check.h"
#include "core/muscle/muscle_path.h"
#include "tests/support/resources.h"
#include "tests/support/shapes.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

const Model& reference() {
  static const Model model = loadReferenceModel(test::resourceDir());
  return model;
}

const BoneMesh& boneOf(const Model& model, const std::string& name) {
  return *std::ranges::find(*model.bones, name, &BoneMesh::bone);
}

/// Where the scanner saw the femur: far from our frame, turned.
RigidTransform scanner() {
  RigidTransform X_SB = RigidTransform::Identity();
  X_SB.linear() = rotationFromVector<double>({0.4, -1.1, 0.7});
  X_SB.translation() = Vector3d{0.3, -1.2, 0.8};
  return X_SB;
}

SuppliedBone seenByScanner(const std::string& bone, const RigidTransform& X_SB) {
  SuppliedBone supplied{bone, boneOf(reference(), bone).mesh};
  for (auto& v : supplied.mesh.vertices) v = X_SB * v;
  return supplied;
}

std::vector<SuppliedLandmark> landmarksSeen(const std::vector<std::string>& names, const RigidTransform& X_SB) {
  std::vector<SuppliedLandmark> seen;
  for (const auto& name : names) seen.push_back({name, X_SB * reference().skeleton.landmark(name).p_BL});
  return seen;
}

const std::vector<std::string> kFemur{"femoral_head_center_r", "knee_center_r", "greater_trochanter_tip_r",
                                      "medial_epicondyle_r", "lateral_epicondyle_r"};

double largestPathDifference(const Model& a, const Model& b) {
  const auto X_WA = segmentPoses(a.skeleton, zeroPosture(a.skeleton)),
             X_WB = segmentPoses(b.skeleton, zeroPosture(b.skeleton));
  double largest = 0;
  for (std::size_t u = 0; u < a.musculature.units.size(); ++u)
    largest = std::max(largest,
                       std::abs(pathLength(a.musculature.units[u], X_WA) - pathLength(b.musculature.units[u], X_WB)));
  return largest;
}

std::string complaint(const std::vector<SuppliedBone>& bones, const std::vector<SuppliedLandmark>& landmarks = {}) {
  try {
    replaceBones(reference(), bones, landmarks);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(ReplaceBones, OurOwnFemurFromAScannerLandsBackInItsPlace) {
  const auto result =
      replaceBones(reference(), {seenByScanner("femur_r", scanner())}, landmarksSeen(kFemur, scanner()));
  const auto& before = boneOf(reference(), "femur_r");
  const auto& after = boneOf(result.model, "femur_r");
  ASSERT_EQ(after.mesh.vertices.size(), before.mesh.vertices.size());
  EXPECT_TRUE(after.supplied);
  double furthest = 0;
  const MeshDefects defects = meshDefects(after.mesh);
  EXPECT_TRUE(defects.sound());
  // Welding keeps the order of first use, which is not that of the file: compare as sets through the box and centre.
  Vector3d low = Vector3d::Constant(9), high = -low, low_before = low, high_before = high;
  for (const auto& v : after.mesh.vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
  for (const auto& v : before.mesh.vertices)
    low_before = low_before.cwiseMin(v), high_before = high_before.cwiseMax(v);
  furthest = std::max((low - low_before).norm(), (high - high_before).norm());
  EXPECT_LT(furthest, 1e-4);                                          // 0.1 mm
  EXPECT_LT(largestPathDifference(reference(), result.model), 1e-4);  // of the muscles [m]
  EXPECT_LT(result.fits.at(0).rms_m, 1e-9);
  EXPECT_EQ(result.joints.size(), 1u);  // the knee, named by its landmark, did not move
  EXPECT_LT(result.joints[0].moved_m, 1e-9);
  EXPECT_GT(result.attachments.size(), 40u);
  EXPECT_TRUE(result.warnings.empty());
}

TEST(ReplaceBones, WithoutLandmarksTheSegmentFrameIsMeant) {
  const auto result = replaceBones(reference(), {seenByScanner("tibia_r", RigidTransform::Identity())}, {});
  EXPECT_EQ(result.fits.at(0).landmarks, 0);
  EXPECT_LT(largestPathDifference(reference(), result.model), 1e-6);
}

TEST(ReplaceBones, AttachmentsFollowAThickerBoneAndKeepTheirDistance) {
  // A femur grown by 2 mm along its normals: what lies on it moves out by 2 mm.
  SuppliedBone grown = seenByScanner("femur_r", RigidTransform::Identity());
  const auto normals = vertexNormals(grown.mesh);
  for (std::size_t i = 0; i < normals.size(); ++i) grown.mesh.vertices[i] += 0.002 * normals[i];
  const auto result = replaceBones(reference(), {grown}, {});
  int close = 0, all = 0;
  for (const auto& a : result.attachments) {
    ++all;
    close += std::abs(a.moved_m - 0.002) < 0.0005;  // hollows and edges differ
  }
  EXPECT_GT(close, 0.7 * all);
}

TEST(ReplaceBones, JointCentresFollowTheirLandmarks) {
  // A femur 20 mm longer below: the knee, and what hangs on it, moves.
  auto longer = seenByScanner("femur_r", RigidTransform::Identity());
  for (auto& v : longer.mesh.vertices)
    if (v.y() < -0.25) v.y() -= 0.020;
  auto landmarks = landmarksSeen({"femoral_head_center_r", "greater_trochanter_tip_r", "lesser_trochanter_r",
                                  "gluteal_tuberosity_upper_r", "knee_center_r"},
                                 RigidTransform::Identity());
  landmarks.back().p_S.y() -= 0.020;
  const auto result = replaceBones(reference(), {longer}, landmarks);
  const auto& s = result.model.skeleton;
  EXPECT_NEAR(s.joints[std::size_t(s.jointIndex("knee_r"))].X_PJ.translation().norm(), 0.442, 0.003);
  EXPECT_NEAR(s.patellae[0].p_FK.norm(), 0.442, 0.003);
  EXPECT_GT(result.joints.at(0).moved_m, 0.015);
  EXPECT_THAT(result.warnings, testing::Contains(testing::Field(&Warning::code, "joint_moved")));
}

TEST(ReplaceBones, InvertedSurfacesAreTurnedAndOpenOnesRefused) {
  SuppliedBone inverted = seenByScanner("patella_r", RigidTransform::Identity());
  for (auto& t : inverted.mesh.triangles) std::swap(t[1], t[2]);
  const auto result = replaceBones(reference(), {inverted}, {});
  EXPECT_THAT(result.warnings, testing::Contains(testing::Field(&Warning::code, "bone_surface_turned")));
  EXPECT_GT(signedVolume_m3(boneOf(result.model, "patella_r").mesh), 0);

  SuppliedBone mixed = seenByScanner("patella_r", RigidTransform::Identity());
  for (std::size_t i = 0; i < mixed.mesh.triangles.size(); i += 3)
    std::swap(mixed.mesh.triangles[i][1], mixed.mesh.triangles[i][2]);
  EXPECT_TRUE(meshDefects(boneOf(replaceBones(reference(), {mixed}, {}).model, "patella_r").mesh).sound());

  SuppliedBone open = seenByScanner("patella_r", RigidTransform::Identity());
  open.mesh.triangles.pop_back();
  EXPECT_THAT(complaint({open}), HasSubstr("3 open edges"));
}

TEST(ReplaceBones, WrongInputIsNamed) {
  const auto femur = seenByScanner("femur_r", RigidTransform::Identity());
  SuppliedBone renamed = femur;
  renamed.bone = "femur";
  EXPECT_THAT(complaint({renamed}), HasSubstr("femur_r"));  // the nearest name
  EXPECT_THAT(complaint({femur, femur}), HasSubstr("two"));
  EXPECT_THAT(complaint({{"femur_r", {}}}), HasSubstr("no triangles"));
  SuppliedBone in_millimetres = femur;
  for (auto& v : in_millimetres.mesh.vertices) v *= 1000;
  EXPECT_THAT(complaint({in_millimetres}), HasSubstr("unit"));
  EXPECT_THAT(complaint({femur}, landmarksSeen({"knee_center_r", "femoral_head_center_r"}, scanner())),
              HasSubstr("three or more"));
  EXPECT_THAT(complaint({femur}, {{"knee_centre_r", Vector3d::Zero()}}), HasSubstr("knee_center_r"));
  auto twice = landmarksSeen(kFemur, scanner());
  twice.push_back(twice[0]);
  EXPECT_THAT(complaint({femur}, twice), HasSubstr("two"));
}

TEST(ReplaceBones, LandmarksOfOtherSegmentsAreNotUsed) {
  const auto result = replaceBones(reference(), {seenByScanner("patella_r", RigidTransform::Identity())},
                                   landmarksSeen({"asis_r"}, RigidTransform::Identity()));
  EXPECT_THAT(result.warnings, testing::Contains(testing::Field(&Warning::code, "landmark_without_bone")));
}

TEST(ReplaceBones, TheModelFileKeepsThemAndNoticesChanges) {
  const test::TemporaryFolder folder;
  auto longer = seenByScanner("fibula_r", RigidTransform::Identity());
  for (auto& v : longer.mesh.vertices) v.y() *= 1.01;
  const Model model = replaceBones(reference(), {longer}, {}).model;
  saveModel(model, folder / "mine.json");
  const Model back = loadModel(folder / "mine.json", reference());
  const auto& saved = boneOf(back, "fibula_r");
  EXPECT_TRUE(saved.supplied);
  EXPECT_FALSE(boneOf(back, "tibia_r").supplied);
  ASSERT_EQ(saved.mesh.vertices.size(), longer.mesh.vertices.size());
  const auto& written = boneOf(model, "fibula_r");
  for (std::size_t i = 0; i < saved.mesh.vertices.size(); i += 50)
    EXPECT_LT((saved.mesh.vertices[i] - written.mesh.vertices[i]).norm(), 1e-5);  // 16 bit in its box

  std::ofstream{folder / "mine.bones.bin", std::ios::app} << "x";
  EXPECT_THROW(loadModel(folder / "mine.json", reference()), InputError);
  std::filesystem::remove(folder / "mine.bones.bin");
  EXPECT_THROW(loadModel(folder / "mine.json", reference()), InputError);

  saveModel(reference(), folder / "plain.json");
  EXPECT_FALSE(std::filesystem::exists(folder / "plain.bones.bin"));
}

TEST(MeshCheck, FindsAndMendsWhatCanBeMended) {
  TriangleMesh ball = test::ellipsoid({0.01, 0.02, 0.03}, {0, 0, 0}, 12);
  EXPECT_TRUE(meshDefects(ball).sound());
  TriangleMesh soup;  // as STL stores it
  for (const auto& t : ball.triangles) {
    const auto first = std::int32_t(soup.vertices.size());
    for (const auto i : t) soup.vertices.push_back(ball.vertices[std::size_t(i)]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_EQ(meshDefects(soup).open_edges, int(3 * soup.triangles.size()));
  EXPECT_TRUE(meshDefects(welded(soup)).sound());
  EXPECT_EQ(welded(soup).vertices.size(), ball.vertices.size());
  auto thrice = ball;
  thrice.vertices.emplace_back(1, 1, 1);
  thrice.triangles.push_back({ball.triangles[0][0], ball.triangles[0][1], std::int32_t(ball.vertices.size())});
  EXPECT_EQ(meshDefects(thrice).shared_edges, 1);
}

}  // namespace
}  // namespace sinew
