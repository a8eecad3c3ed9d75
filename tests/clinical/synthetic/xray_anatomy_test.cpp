#include <gtest/gtest.h>

#include "clinical/synthetic/body_envelope.h"
#include "clinical/synthetic/bone_tissue.h"
#include "core/skeleton/kinematics.h"
#include "imaging/xray/xray_attenuation.h"
#include "tests/support/resources.h"
#include "tests/support/solids.h"

namespace sinew {
namespace {

using Eigen::Vector3d;

/// Millimetre pixels, looking along -Z; the middle of the image is the world's origin.
View sideView(int width_px, int height_px) {
  View view{Orthographic{0.001, 0.001, (width_px - 1) / 2.0, (height_px - 1) / 2.0}, {}, {}, width_px, height_px};
  view.R_CW << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  view.p_CW = Vector3d::Zero();
  return view;
}

/// A shaft with the girth of a femur: ellipsoid 440 mm long, 32 mm thick in the middle.
BoneMesh spindle(const std::string& name) {
  BoneMesh bone{name, 0, test::ballMesh(Vector3d::Zero(), 1, 40)};
  for (auto& p : bone.mesh.vertices) p = Vector3d{0.016, 0.22, 0.016}.asDiagonal() * p;
  return bone;
}

TEST(SmoothlySubdivided, BringsABallCloserToRound) {
  const auto coarse = test::ballMesh(Vector3d::Zero(), 0.02, 10);
  const auto fine = smoothlySubdivided(coarse);
  EXPECT_TRUE(isWatertight(fine));
  EXPECT_EQ(fine.triangles.size(), 4 * coarse.triangles.size());
  const double ball = 4.0 / 3 * 3.14159265358979 * std::pow(0.02, 3);
  const double coarse_error = 1 - signedVolume_m3(coarse) / ball, fine_error = 1 - signedVolume_m3(fine) / ball;
  EXPECT_LT(std::abs(fine_error), 0.35 * coarse_error);  // a quarter for exact normals
  const auto box = test::boxMesh(-Vector3d::Ones(), Vector3d::Ones());
  for (const auto& p : smoothlySubdivided(box).vertices)
    EXPECT_LT(p.cwiseAbs().maxCoeff(), 1.21);  // at a crease a twentieth of the edge, not more
}

TEST(BoneTissue, OfAShaftIsAThickShellAroundMarrow) {
  const auto tissue = boneTissue(spindle("femur_r"), RigidTransform::Identity());
  ASSERT_EQ(tissue.volumes.size(), 3U);
  for (const auto& volume : tissue.volumes) {
    EXPECT_TRUE(isWatertight(volume.mesh_W));
    EXPECT_GT(signedVolume_m3(volume.mesh_W), 0);
  }
  const View view = sideView(61, 501);
  const auto field = attenuationField(tissue.volumes, {}, view);
  const auto at = [&](int u, int v) { return double(field[std::size_t(v) * 61 + std::size_t(u)]); };
  // Middle of the shaft, through its axis: 32 mm of bone, of which two walls of 6.8 mm compact; marrow fills the rest
  // but for a tenth of its radius, which is spongy.
  const double cavity_m = 0.9 * (0.032 - 2 * 0.0068), spongy_m = 0.1 * (0.032 - 2 * 0.0068);
  const double expected = 2 * 0.0068 * (kCorticalBoneAttenuation_per_m - kMuscleAttenuation_per_m) +
                          spongy_m * (spongyAttenuation_per_m(0.17) - kMuscleAttenuation_per_m) +
                          cavity_m * (kFatAttenuation_per_m - kMuscleAttenuation_per_m);
  EXPECT_NEAR(at(30, 250), expected, 0.03 * expected);  // facets of 40 rings and of the cavity
  EXPECT_GT(at(30 + 12, 250), at(30, 250));  // the wall seen along its tangent is the brightest part of a shaft
  EXPECT_EQ(at(2, 250), 0);
}

TEST(BoneTissue, OfAnotherBoneIsAThinShellAroundSpongyBone) {
  const auto tissue = boneTissue(spindle("tarsus_r"), RigidTransform::Identity());
  ASSERT_EQ(tissue.volumes.size(), 2U);
  const auto field = attenuationField(tissue.volumes, {}, sideView(61, 501));
  const double expected = 2 * 0.0012 * (kCorticalBoneAttenuation_per_m - kMuscleAttenuation_per_m) +
                          (0.032 - 2 * 0.0012) * (spongyAttenuation_per_m(0.17) - kMuscleAttenuation_per_m);
  EXPECT_NEAR(field[250 * 61 + 30], expected, 0.02 * expected);
  EXPECT_TRUE(boneTissue(spindle("costal_cartilages_r"), RigidTransform::Identity()).volumes.empty());
}

TEST(SoftTissues, HaveTheVolumeOfTheReferenceBodyAndALayerOfFat) {
  const Skeleton skeleton = loadReferenceSkeleton(test::resourceDir());
  const auto tissues = softTissues(skeleton, segmentPoses(skeleton, zeroPosture(skeleton)));
  for (const auto& tissue : tissues) {
    EXPECT_TRUE(isWatertight(tissue.mesh_W));
    EXPECT_GT(signedVolume_m3(tissue.mesh_W), 0);
  }
  double mass_kg = 0;
  for (const auto& segment : skeleton.segments) mass_kg += segment.mass_kg;
  const double skin_m3 = signedVolume_m3(tissues[0].mesh_W), fascia_m3 = signedVolume_m3(tissues[1].mesh_W);
  EXPECT_NEAR(skin_m3, mass_kg / 1000, 0.15 * mass_kg / 1000);  // a body floats; girths are rounded means
  EXPECT_GT(1 - fascia_m3 / skin_m3, 0.10);  // fat below the skin: about half of a body fat of 20-30 %
  EXPECT_LT(1 - fascia_m3 / skin_m3, 0.30);
}

TEST(EllipsoidMesh, IsClosedWithItsVolume) {
  const auto mesh = ellipsoidMesh(RigidTransform::Identity(), {0.01, 0.02, 0.03});
  EXPECT_TRUE(isWatertight(mesh));
  EXPECT_NEAR(signedVolume_m3(mesh), 4.0 / 3 * 3.14159265358979 * 6e-6, 0.02 * 2.5e-5);
}

}  // namespace
}  // namespace sinew
