#include <gtest/gtest.h>
#include <vtkCamera.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <cmath>
#include <cstdlib>

#include "app/scene/model_scene.h"
#include "app/scene/muscle_shape.h"
#include "app/scene/palette.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/support/plain_model.h"

namespace sinew {
namespace {

constexpr int kWidth = 200, kHeight = 400;

bool isBackground(const std::uint8_t* p) {
  return p[0] > 250 && p[1] > 250 && p[2] > 250;
}

double coverage(const RgbImage& image) {
  int drawn = 0;
  for (int v = 0; v < image.height_px; ++v)
    for (int u = 0; u < image.width_px; ++u) drawn += !isBackground(image.at(u, v));
  return double(drawn) / (image.width_px * image.height_px);
}

/// Renders and tells the pixel of a world point, by VTK's own projection.
struct Shot {
  RgbImage image;
  std::vector<Eigen::Vector2i> pixels;
};
Shot shoot(const Model& model, const Posture& q, StandardView view, const std::vector<Eigen::Vector3d>& p_W,
           const std::function<void(ModelScene&)>& adjust = {}) {
  Shot shot;
  shot.image = renderOffscreen(kWidth, kHeight,
                               [&](vtkRenderer& renderer) {
                                 ModelScene scene{renderer};
                                 scene.setModel(std::make_shared<const Model>(model));
                                 scene.setPosture(q);
                                 if (adjust) adjust(scene);
                                 scene.lookFrom(view);
                                 const int* size = renderer.GetVTKWindow()->GetSize();
                                 for (const auto& p : p_W) {
                                   renderer.SetWorldPoint(p.x(), p.y(), p.z(), 1);
                                   renderer.WorldToDisplay();
                                   const double* d = renderer.GetDisplayPoint();
                                   shot.pixels.emplace_back(int(d[0] * kWidth / size[0]),
                                                            kHeight - 1 - int(d[1] * kHeight / size[1]));
                                 }
                               },
                               {1, false});
  return shot;
}

Eigen::Vector3d centreOf(const Model& model, const Posture& q, const std::string& segment, double y) {
  return segmentPoses(model.skeleton, q)[model.skeleton.segmentIndex(segment)] * Eigen::Vector3d{0, y, 0};
}

class Scene : public testing::Test {
 protected:
  void SetUp() override { unsetenv("DISPLAY"); }
  const Model model = test::plainModel();
  const Posture zero = zeroPosture(model.skeleton);
};

TEST_F(Scene, BonesAreWhereTheKinematicsPutsThem) {
  const auto bent = postureFromDegrees(model.skeleton, {{"hip_flexion_r", 90}, {"knee_flexion_r", 60}});
  for (const auto& q : {zero, bent})
    for (const auto view : {StandardView::Front, StandardView::Right, StandardView::Oblique}) {
      std::vector<Eigen::Vector3d> p_W;
      for (const auto* segment : {"femur_r", "femur_l", "tibia_r", "tibia_l"})
        p_W.push_back(centreOf(model, q, segment, -0.2));
      const auto shot = shoot(model, q, view, p_W);
      for (const auto& p : shot.pixels) {
        ASSERT_TRUE(p.x() >= 0 && p.x() < kWidth && p.y() >= 0 && p.y() < kHeight) << p.transpose();
        EXPECT_FALSE(isBackground(shot.image.at(p.x(), p.y()))) << p.transpose();
      }
      EXPECT_GT(coverage(shot.image), 0.02);
      EXPECT_LT(coverage(shot.image), 0.9);
    }
}

TEST_F(Scene, FrontViewHasTheRightSideOnTheLeft) {
  const auto shot = shoot(model, zero, StandardView::Front,
                          {centreOf(model, zero, "femur_r", -0.2), centreOf(model, zero, "femur_l", -0.2)});
  EXPECT_LT(shot.pixels[0].x(), kWidth / 2);
  EXPECT_GT(shot.pixels[1].x(), kWidth / 2);
}

TEST_F(Scene, HiddenLayersAreNotDrawn) {
  const auto nothing = [](ModelScene& scene) {
    for (auto layer : {SceneLayer::Bones, SceneLayer::Muscles, SceneLayer::MechanicalAxes})
      scene.setVisible(layer, false);
  };
  EXPECT_EQ(coverage(shoot(model, zero, StandardView::Front, {}, nothing).image), 0);
}

TEST_F(Scene, AxesShowThroughTheBones) {
  const auto no_muscles = [](ModelScene& scene) { scene.setVisible(SceneLayer::Muscles, false); };
  const auto shot = shoot(model, zero, StandardView::Front, {centreOf(model, zero, "femur_r", -0.2)}, no_muscles);
  const auto* p = shot.image.at(shot.pixels[0].x(), shot.pixels[0].y());
  EXPECT_GT(p[0] - p[2], 60) << "an axis is vermilion or blue, not ivory: " << int(p[0]) << ' ' << int(p[1]) << ' '
                             << int(p[2]);
}

TEST_F(Scene, ColoursFollowTheScalarsAndUnknownUnitsAreGrey) {
  MuscleScalars scalars;
  scalars.by_unit["front_of_thigh_r"] = 1.3;
  scalars.low = 0.7;
  scalars.high = 1.3;
  scalars.diverging = true;
  const auto shot = shoot(model, zero, StandardView::Front,
                          {centreOf(model, zero, "femur_r", -0.215), centreOf(model, zero, "femur_l", -0.215)},
                          [&](ModelScene& scene) {
                            scene.setVisible(SceneLayer::MechanicalAxes, false);
                            scene.colourMusclesBy(scalars);
                          });
  const auto* right = shot.image.at(shot.pixels[0].x(), shot.pixels[0].y());
  const auto* left = shot.image.at(shot.pixels[1].x(), shot.pixels[1].y());
  EXPECT_GT(right[0], 2 * right[2]);                     // the orange-brown end
  EXPECT_LT(std::abs(int(left[0]) - int(left[2])), 25);  // grey; the key light is a little warm
}

TEST_F(Scene, PicksWhatIsInFront) {
  std::optional<ScenePick> muscle, bone, nothing;
  renderOffscreen(kWidth, kHeight,
                  [&](vtkRenderer& renderer) {
                    ModelScene scene{renderer};
                    scene.setModel(std::make_shared<const Model>(model));
                    scene.lookFrom(StandardView::Front);
                    renderer.GetVTKWindow()->Render();
                    const auto pickAt = [&](const Eigen::Vector3d& p) {
                      renderer.SetWorldPoint(p.x(), p.y(), p.z(), 1);
                      renderer.WorldToDisplay();
                      return scene.pick(renderer.GetDisplayPoint()[0], renderer.GetDisplayPoint()[1]);
                    };
                    muscle = pickAt(centreOf(model, zero, "femur_l", -0.215));
                    bone = pickAt(centreOf(model, zero, "tibia_r", -0.2));
                    nothing = scene.pick(1, 1);
                  },
                  {1, false});
  ASSERT_TRUE(muscle && bone);
  EXPECT_EQ(muscle->name, "front_of_thigh_l");
  EXPECT_EQ(muscle->layer, SceneLayer::Muscles);
  EXPECT_EQ(bone->name, "tibia_r");
  EXPECT_NEAR(bone->p_W.x(), 0.0225, 0.003);  // the front of the ellipsoid
  EXPECT_FALSE(nothing);
}

TEST_F(Scene, RefusesAPostureOfAnotherSkeleton) {
  EXPECT_THROW(shoot(model, Posture::Zero(3), StandardView::Front, {}), std::logic_error);
}

TEST(MuscleSpindle, EndsThinBulgesInTheMiddleAndKeepsCorners) {
  MusculotendonUnit unit;
  unit.max_isometric_force_N = 1000;
  unit.optimal_fiber_length_m = 0.1;
  const Eigen::Vector3d corner{0.1, 0.02, 0};
  const auto s = muscleSpindle(unit, {{0, 0, 0}, corner, {0.3, 0, 0}});
  ASSERT_EQ(s.points.size(), s.radius_m.size());
  EXPECT_EQ(s.points.front(), Eigen::Vector3d(0, 0, 0));
  EXPECT_LT((s.points.back() - Eigen::Vector3d(0.3, 0, 0)).norm(), 1e-12);
  EXPECT_LT(s.radius_m.front(), 0.002);
  EXPECT_GT(*std::ranges::max_element(s.radius_m), 0.008);
  double nearest = 1;
  for (const auto& p : s.points) nearest = std::min(nearest, (p - corner).norm());
  EXPECT_LT(nearest, 0.003);  // the station beside a corner may replace it: 0.2 of a step
  EXPECT_TRUE(muscleSpindle(unit, {{1, 1, 1}, {1, 1, 1}}).points.empty());
}

TEST(Palette, MapsReadInGrey) {
  const auto luminance = [](const Rgb& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; };
  for (int i = 0; i < 20; ++i)
    EXPECT_LT(luminance(sequentialColour(i / 20.0)), luminance(sequentialColour((i + 1) / 20.0)));
  EXPECT_GT(luminance(divergingColour(0.5)), luminance(divergingColour(0)));
  EXPECT_GT(luminance(divergingColour(0.5)), luminance(divergingColour(1)));
  EXPECT_EQ(sequentialColour(NAN).r, sequentialColour(0).r);
}

}  // namespace
}  // namespace sinew
