// The map of a ball joint as a picture: colours, patch, sphere, and its place on the body.
#include <gtest/gtest.h>
#include <vtkPointData.h>

#include <cmath>
#include <numbers>

#include "app/scene/model_scene.h"
#include "app/scene/rom_patch.h"
#include "app/scene/rom_sphere.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/support/plain_model.h"

namespace sinew {
namespace {

/// Every twist is free within a cone about the resting shaft, none outside.
RomMap cone(int polars) {
  RomMap map{"hip_r", {-Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitX()}, {}};
  map.valid.assign(RomMap::kCells, 0);
  for (int t = 0; t < RomMap::kTwists; ++t)
    for (int p = 0; p < polars; ++p)
      for (int a = 0; a < RomMap::kAzimuths; ++a) map.valid[std::size_t(RomMap::cell(t, p, a))] = 1;
  return map;
}

double luminance(const Rgb& c) {
  return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

bool isRomRed(const std::uint8_t* p) {
  return p[0] > 90 && p[1] < 60 && p[2] < 80;
}

int count(const RgbImage& image, bool (*test)(const std::uint8_t*)) {
  int n = 0;
  for (int v = 0; v < image.height_px; ++v)
    for (int u = 0; u < image.width_px; ++u) n += test(image.at(u, v));
  return n;
}

TEST(RomColour, DarkensFromNarrowToWide) {
  for (int i = 0; i < 20; ++i) EXPECT_GT(luminance(romColour(i, 20)), luminance(romColour(i + 1, 20)));
  EXPECT_EQ(romColour(30, 20).r, romColour(20, 20).r);  // cut off
}

TEST(RomPatch, CoversTheFreeDirectionsAndNoOther) {
  constexpr double kRadius_m = 0.2;
  const auto patch = romPatch(cone(6), kRadius_m, 2 * std::numbers::pi);  // 30 degrees
  ASSERT_GT(patch->GetNumberOfPoints(), 0);
  double widest = 0;
  for (vtkIdType i = 0; i < patch->GetNumberOfPoints(); ++i) {
    Eigen::Vector3d p;
    patch->GetPoint(i, p.data());
    EXPECT_NEAR(p.norm(), kRadius_m, 1e-6);
    widest = std::max(widest, std::acos(-p.y() / p.norm()));
  }
  EXPECT_NEAR(widest, 30 * std::numbers::pi / 180, 1e-5);  // single precision of VTK's points
  EXPECT_EQ(romPatch(cone(0), kRadius_m, 1)->GetNumberOfCells(), 0);
}

TEST(RomPatch, CellsLieWhereTheMapSaysTheyDo) {
  RomMap map = cone(0);
  map.valid[std::size_t(RomMap::cell(3, 10, 7))] = 1;
  const auto patch = romPatch(map, 1, 1);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (vtkIdType i = 0; i < patch->GetNumberOfPoints(); ++i) {
    Eigen::Vector3d p;
    patch->GetPoint(i, p.data());
    sum += p;
  }
  constexpr double kDegree = std::numbers::pi / 180;
  EXPECT_LT(std::acos(sum.normalized().dot(map.direction_J(10, 7))),
            0.2 * kDegree);  // the mean is not quite the middle
}

TEST(RomSphere, PictureShowsMoreOfAWiderMap) {
  RomPicture picture;
  picture.width_px = picture.height_px = 160;
  picture.colour_bar = false;
  picture.quality.supersampling = 1;
  const int narrow = count(renderRomSphere(cone(6), picture), isRomRed);
  const int wide = count(renderRomSphere(cone(18), picture), isRomRed);
  EXPECT_GT(narrow, 50);
  EXPECT_GT(wide, 2 * narrow);
}

TEST(RomSphere, StandsAtTheJointOnTheBody) {
  const Model model = test::plainModel();
  const auto redAt = [&](std::optional<RomMap> map) {
    ModelPicture picture;
    picture.width_px = picture.height_px = 160;
    picture.muscles = picture.mechanical_axes = false;
    picture.quality = {1, false};
    picture.rom = std::move(map);
    picture.rom_widest_rad = 2 * std::numbers::pi;
    const auto X_WB = segmentPoses(model.skeleton, zeroPosture(model.skeleton));
    picture.focus = {X_WB[std::size_t(model.skeleton.segmentIndex("femur_r"))].translation(), 0.35};
    return count(renderModel(model, zeroPosture(model.skeleton), picture), isRomRed);
  };
  EXPECT_EQ(redAt(std::nullopt), 0);
  EXPECT_GT(redAt(cone(18)), 200);
}

TEST(RomSphere, ShaftFollowsTheJoint) {
  const Model model = test::plainModel();
  const auto bent = postureFromDegrees(model.skeleton, {{"hip_flexion_r", 90}});
  EXPECT_LT((shaftDirection(model, cone(1), bent) - Eigen::Vector3d::UnitX()).norm(), 1e-9);  // forward
}

}  // namespace
}  // namespace sinew
