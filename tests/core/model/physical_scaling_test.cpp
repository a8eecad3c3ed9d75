#include "core/model/physical_scaling.h"

#include <gmock/gmock.h>

#include <chrono>

#include "core/muscle/unit_selection.h"
#include "core/skeleton/shape/deformed_inertia.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const Model& reference() {
  static const Model model = loadReferenceModel(test::resourceDir());
  return model;
}

/// Every ratio L.
ShapeParameters uniform(double L) {
  auto values = toVector(ShapeParameters{});
  for (double& v : values)
    if (v == 1) v = L;
  return shapeFromVector(values);
}

TEST(PhysicalScaling, ExponentsOfHodginsAndPollard) {
  EXPECT_DOUBLE_EQ(timeScale(4), 2);
  EXPECT_DOUBLE_EQ(velocityScale(4), 2);
  EXPECT_DOUBLE_EQ(forceScale(4), 64);
  EXPECT_DOUBLE_EQ(massScale(4), 64);
  EXPECT_DOUBLE_EQ(inertiaScale(4), 1024);
  EXPECT_DOUBLE_EQ(stiffnessScale(4), 16);
  EXPECT_DOUBLE_EQ(dampingScale(4), 32);
  EXPECT_DOUBLE_EQ(strengthScale(4), 16);
}

TEST(DeformedInertia, IdentityChangesNothing) {
  const auto segments = deformedInertias(reference().skeleton, toVector(ShapeParameters{}));
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Segment& before = reference().skeleton.segments[i];
    EXPECT_NEAR(segments[i].mass_kg, before.mass_kg, 1e-13 * before.mass_kg) << before.name;
    EXPECT_LT((segments[i].p_BCom - before.p_BCom).norm(), 1e-14) << before.name;
    EXPECT_LT((segments[i].inertia_B_kgm2 - before.inertia_B_kgm2).norm(), 1e-13) << before.name;
  }
}

TEST(DeformedInertia, UniformScaleGivesTheThirdAndFifthPower) {
  const double L = 1.3;
  // The neck only elongates: it is left out.
  const auto segments = deformedInertias(reference().skeleton, toVector(uniform(L)));
  for (int i = 0; i < reference().skeleton.movingSegmentCount(); ++i) {
    const Segment& before = reference().skeleton.segments[std::size_t(i)];
    if (before.name == "neck") continue;
    const Segment& after = segments[std::size_t(i)];
    EXPECT_NEAR(after.mass_kg, massScale(L) * before.mass_kg, 1e-12 * before.mass_kg) << before.name;
    EXPECT_LT((after.p_BCom - L * before.p_BCom).norm(), 1e-14) << before.name;
    EXPECT_LT((after.inertia_B_kgm2 - inertiaScale(L) * before.inertia_B_kgm2).norm(),
              1e-12 * before.inertia_B_kgm2.norm())
        << before.name;
  }
}

TEST(DeformedInertia, ThreeScalesGiveTheScaledBox) {
  // A homogeneous box a x b x c has I_xx = m (b^2 + c^2) / 12; one that is turned about Z has products of inertia.
  Skeleton skeleton = reference().skeleton;
  const int pelvis = skeleton.segmentIndex("pelvis");
  const Eigen::Matrix3d R = rotationAbout<double>(Eigen::Vector3d::UnitZ(), 0.4);
  const Eigen::Vector3d sides{0.1, 0.2, 0.3};
  const double mass_kg = 5;
  const Eigen::Matrix3d second = mass_kg / 12 * R * sides.cwiseAbs2().asDiagonal() * R.transpose();
  Segment& box = skeleton.segments[std::size_t(pelvis)];
  box.mass_kg = mass_kg;
  box.p_BCom = {0.01, 0.02, 0.03};
  box.inertia_B_kgm2 = second.trace() * Eigen::Matrix3d::Identity() - second;
  ShapeParameters shape;
  shape.pelvis_depth = 1.2, shape.pelvis_height = 0.8, shape.pelvis_width = 1.5;
  const Eigen::Vector3d scale{1.2, 0.8, 1.5};
  const Segment after = deformedInertias(skeleton, toVector(shape))[std::size_t(pelvis)];
  const double volume = scale.prod();
  const Eigen::Matrix3d wanted = volume * scale.asDiagonal() * second * scale.asDiagonal();
  EXPECT_NEAR(after.mass_kg, volume * mass_kg, 1e-12);
  EXPECT_LT((after.p_BCom - scale.cwiseProduct(box.p_BCom)).norm(), 1e-14);
  EXPECT_LT((after.inertia_B_kgm2 - (wanted.trace() * Eigen::Matrix3d::Identity() - wanted)).norm(), 1e-13);
  EXPECT_GT(std::abs(after.inertia_B_kgm2(0, 1)), 1e-3);  // the products are not lost
}

TEST(DeformedInertia, IsMirroredAndFollowsAStretchedShaft) {
  ShapeParameters shape;
  for (auto& side : shape.sides) side.femur = {.elongation = 1.4, .torsion_rad = 0.5, .varus_rad = 0.1};
  const auto segments = deformedInertias(reference().skeleton, toVector(shape));
  const Segment& right = segments[std::size_t(reference().skeleton.segmentIndex("femur_r"))];
  const Segment& left = segments[std::size_t(reference().skeleton.segmentIndex("femur_l"))];
  const Eigen::Vector3d flip{1, 1, -1};
  EXPECT_NEAR(left.mass_kg, right.mass_kg, 1e-12);
  EXPECT_LT((left.p_BCom - mirrored(right.p_BCom)).norm(), 1e-12);
  EXPECT_LT((left.inertia_B_kgm2 - flip.asDiagonal() * right.inertia_B_kgm2 * flip.asDiagonal()).norm(), 1e-12);
  // The thigh is 1.4 times as long between its joints; the box reaches past them, where nothing is stretched.
  const double ratio =
      right.mass_kg /
      reference().skeleton.segments[std::size_t(reference().skeleton.segmentIndex("femur_r"))].mass_kg;
  EXPECT_GT(ratio, 1.3);
  EXPECT_LT(ratio, 1.4);
}

TEST(DeformedInertia, TakesLessThanAMillisecond) {
  const auto parameters = toVector(loadShapePreset(test::resourceDir(), "hulk").shape);
  double best_s = 1;
  for (int i = 0; i < 20; ++i) {
    const auto start = std::chrono::steady_clock::now();
    deformedInertias(reference().skeleton, parameters);
    best_s = std::min(best_s, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::printf("%.3f ms\n", 1e3 * best_s);
#ifdef NDEBUG
  EXPECT_LT(best_s, 1e-3);
#endif
}

double strengthRatio(const Model& model, const std::string& unit) {
  return model.musculature.unit(unit).max_isometric_force_N /
         reference().musculature.unit(unit).max_isometric_force_N;
}
double massRatio(const Model& model, const std::string& segment) {
  return model.skeleton.segments[std::size_t(model.skeleton.segmentIndex(segment))].mass_kg /
         reference().skeleton.segments[std::size_t(reference().skeleton.segmentIndex(segment))].mass_kg;
}

TEST(WithPhysics, NothingSaidOfTheReferenceChangesNothing) {
  const Model same = withPhysics(reference(), reference(), {});
  EXPECT_TRUE(same.physics.has_value());
  for (const auto& unit : reference().musculature.units) EXPECT_NEAR(strengthRatio(same, unit.name), 1, 1e-14);
  for (int i = 0; i < reference().skeleton.movingSegmentCount(); ++i)
    EXPECT_NEAR(massRatio(same, reference().skeleton.segments[std::size_t(i)].name), 1, 1e-13);
}

TEST(WithPhysics, StrengthGrowsWithTheCrossSection) {
  const double L = 1.25;
  const Model large = withPhysics(deformedModel(reference(), uniform(L)), reference(), {});
  // The neck is only elongated: muscles that hang on it grow less.
  for (const char* unit : {"soleus_medial_r", "rectus_femoris_l", "gluteus_medius_middle_r",
                           "biceps_brachii_long_head_r", "brachialis_l", "flexor_carpi_radialis_r"})
    EXPECT_NEAR(strengthRatio(large, unit), strengthScale(L), 1e-12) << unit;
  ShapeParameters longer;
  for (auto& side : longer.sides) side.tibia.elongation = 1.5;
  const Model long_shank = withPhysics(deformedModel(reference(), longer), reference(), {});
  EXPECT_NEAR(strengthRatio(long_shank, "soleus_medial_r"), 1, 0.03);  // along the bone: longer, not thicker
  EXPECT_NEAR(strengthRatio(long_shank, "brachialis_r"), 1, 1e-14);    // elsewhere: untouched
}

TEST(WithPhysics, FactorsOfMassAndStrength) {
  const Model alien_bones = deformedModel(reference(), loadShapePreset(test::resourceDir(), "alien").shape);
  const Model alien = withPhysics(alien_bones, reference(), loadShapePreset(test::resourceDir(), "alien").physics);
  EXPECT_NEAR(massRatio(alien, "femur_r"), 2.5, 1e-12);
  EXPECT_NEAR(massRatio(alien, "neck"), 2.0, 1e-12);
  EXPECT_NEAR(massRatio(alien, "thorax"), 1.0, 1e-12);
  PhysicsFactors factors;
  factors.mass_factors["femur_r"] = 2;
  factors.strength_factors = {{"quadriceps", 0.8}, {"rectus_femoris_r", 1.5}, {"soleus", 0.5}};
  const Model edited = withPhysics(alien, reference(), factors);  // of the reference anew, not of the alien's masses
  EXPECT_NEAR(massRatio(edited, "femur_r"), 2 * massRatio(alien_bones, "femur_r"), 1e-12);
  EXPECT_NEAR(massRatio(edited, "femur_l"), massRatio(alien_bones, "femur_l"), 1e-12);
  EXPECT_NEAR(strengthRatio(edited, "rectus_femoris_r"), 1.5, 1e-14);  // the unit's own factor wins over its group's
  EXPECT_NEAR(strengthRatio(edited, "rectus_femoris_l"), 0.8, 1e-14);
  EXPECT_NEAR(strengthRatio(edited, "vastus_lateralis_superior_r"), 0.8, 1e-14);
  EXPECT_NEAR(strengthRatio(edited, "soleus_lateral_l"), 0.5, 1e-14);
  // Inertia follows the mass.
  const int femur = reference().skeleton.segmentIndex("femur_r");
  EXPECT_LT((edited.skeleton.segments[std::size_t(femur)].inertia_B_kgm2 -
             2 * alien_bones.skeleton.segments[std::size_t(femur)].inertia_B_kgm2)
                .norm(),
            1e-12);
}

TEST(WithPhysics, TheChildHasTheMassAndHeightOfSevenYears) {
  const BodyDescription body = loadShapePreset(test::resourceDir(), "child");
  const Model child = withPhysics(deformedModel(reference(), body.shape), reference(), body.physics);
  double mass_kg = 0, low_m = 1e9, high_m = -1e9;
  for (const Segment& segment : child.skeleton.segments) mass_kg += segment.mass_kg;
  const auto X_WB = segmentPoses(child.skeleton, zeroPosture(child.skeleton));
  for (const BoneMesh& bone : *child.bones)
    for (const Eigen::Vector3d& p : bone.mesh.vertices) {
      const double y_m = (X_WB[std::size_t(bone.segment)] * p).y();
      low_m = std::min(low_m, y_m), high_m = std::max(high_m, y_m);
    }
  EXPECT_NEAR(mass_kg, 22.9, 0.5);           // WHO 2007, median boy of 7.0 years
  EXPECT_NEAR(high_m - low_m, 1.217, 0.02);  // the same
}

TEST(WithPhysics, RefusesWrongNames) {
  const auto complaint = [](const PhysicsFactors& factors) -> std::string {
    try {
      withPhysics(reference(), reference(), factors);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no complaint";
  };
  EXPECT_THAT(complaint({.strength_factors = {{"quadricps", 1}}}),
              AllOf(HasSubstr("'quadricps'"), HasSubstr("quadriceps")));
  EXPECT_THAT(complaint({.mass_factors = {{"femur", 1}}}), HasSubstr("femur_r"));
  EXPECT_THAT(complaint({.mass_factors = {{"patella_r", 1}}}), HasSubstr("carries mass"));
  EXPECT_THAT(complaint({.mass_factors = {{"femur_r", 1}}, .mass_ratios = {{"femur_r", 1}}}), HasSubstr("both"));
}

TEST(WithPhysics, IsKeptInTheModelFile) {
  const test::TemporaryFolder folder;
  PhysicsFactors factors;
  factors.mass_factors["thorax"] = 1.2;
  factors.mass_ratios["femur_l"] = 0.9;
  factors.strength_factors["quadriceps"] = 0.8;
  Model model = withPhysics(reference(), reference(), factors);
  const CurveEdit edits[] = {{"soleus", "active_width", 0.5}, {"soleus_medial_r", "tendon_strain", 0.05}};
  model.musculature = withCurves(model.musculature, edits);
  saveModel(model, folder / "model.json");
  const Model back = loadModel(folder / "model.json", reference());
  EXPECT_EQ(back.physics, model.physics);
  for (std::size_t i = 0; i < model.musculature.units.size(); ++i)
    EXPECT_EQ(back.musculature.units[i].curves, model.musculature.units[i].curves);
  saveModel(reference(), folder / "plain.json");  // as files were before there were factors
  EXPECT_FALSE(loadModel(folder / "plain.json", reference()).physics.has_value());
}

TEST(UnitSelection, UnitsMusclesGroupsAndSides) {
  const Musculature& m = reference().musculature;
  EXPECT_EQ(unitsNamed(m, "soleus_medial_r").size(), 1u);
  EXPECT_EQ(unitsNamed(m, "soleus_medial").size(), 2u);
  EXPECT_EQ(unitsNamed(m, "soleus").size(), 4u);
  EXPECT_EQ(unitsNamed(m, "soleus_l").size(), 2u);
  EXPECT_EQ(unitsNamed(m, "quadriceps").size(), 14u);
  EXPECT_EQ(unitsNamed(m, "quadriceps_r").size(), 7u);
  EXPECT_EQ(unitsNamed(m, "all").size(), m.units.size());
  EXPECT_THROW(unitsNamed(m, "sol"), InputError);
}

}  // namespace
}  // namespace sinew
