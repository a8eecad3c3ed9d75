#include "core/passive/structures.h"

#include <gmock/gmock.h>

#include <numbers>

#include "core/angle.h"
#include "core/file.h"
#include "core/model/model.h"
#include "core/model/physical_scaling.h"
#include "core/passive/structure_moments.h"
#include "core/posture/evaluate.h"
#include "core/posture/validity.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/support/postures.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

const Model& reference() {
  static const Model model = loadReferenceModel(test::resourceDir());
  return model;
}

bool isJoint(const Skeleton& s, int coordinate) {
  return s.joints[std::size_t(s.coordinates[std::size_t(coordinate)].joint)].type != JointType::Free;
}

/// A stop is where its end alone sets its moment against the joint; so whoever asks the stops asks the structures.
void expectStopsAreEnds(const Model& model) {
  const Skeleton& s = model.skeleton;
  ASSERT_EQ(model.passive_moments.size(), s.coordinates.size());
  for (int i = 0; i < s.coordinateCount(); ++i) {
    const PassiveMoment& m = model.passive_moments[std::size_t(i)];
    const Coordinate& c = s.coordinates[std::size_t(i)];
    if (!isJoint(s, i)) {
      EXPECT_EQ(m, PassiveMoment{}) << c.name;
      continue;
    }
    ASSERT_GT(m.upper_Nm, 0) << c.name;
    ASSERT_GT(m.lower_Nm, 0) << c.name;
    EXPECT_NEAR(upperAngleAt_rad(m, m.upper_Nm), c.stop_max_rad, 1e-12) << c.name;
    EXPECT_NEAR(lowerAngleAt_rad(m, m.lower_Nm), c.stop_min_rad, 1e-12) << c.name;
  }
}

TEST(PassiveStructures, EveryStopIsTheEndOfItsStructures) {
  expectStopsAreEnds(reference());
  expectStopsAreEnds(loadReferenceModel(test::resourceDir(), "athlete"));
  const BodyDescription child = loadShapePreset(test::resourceDir(), "child");
  expectStopsAreEnds(deformedModel(reference(), child.shape));
  expectStopsAreEnds(withPhysics(deformedModel(reference(), child.shape), reference(), child.physics));
}

TEST(PassiveStructures, AMarginIsWhatIsLeftUntilTheEndMoment) {
  const Skeleton& s = reference().skeleton;
  std::mt19937_64 random{11};
  for (int trial = 0; trial < 50; ++trial) {
    const Posture q = postureFromClinical(s, test::randomClinical(s, random));
    for (const ConstraintMargin& margin : stopMargins(s, q)) {
      const PassiveMoment& m = reference().passive_moments[std::size_t(margin.index)];
      const Coordinate& c = s.coordinates[std::size_t(margin.index)];
      // The angle that the margin was read at, and what its end sets against it there.
      const double angle_rad = margin.upper ? c.stop_max_rad - margin.margin : c.stop_min_rad + margin.margin;
      PassiveMoment end = m;
      (margin.upper ? end.lower_Nm : end.upper_Nm) = 0;
      const double moment_Nm = std::abs(passiveMoment_Nm(end, angle_rad));
      const double end_Nm = margin.upper ? m.upper_Nm : m.lower_Nm;
      EXPECT_EQ(margin.margin > 0, moment_Nm < end_Nm) << c.name;
    }
  }
}

TEST(PassiveStructures, StandingIsNearlyFree) {
  const Skeleton& s = reference().skeleton;
  const PostureEvaluation e =
      evaluatePosture(s, reference().musculature, zeroPosture(s), reference().passive_moments);
  for (int i = 0; i < s.coordinateCount(); ++i)
    EXPECT_LT(std::abs(e.passive_torque[i]), 6) << s.coordinates[std::size_t(i)].name;  // a tenth of an exam's torque
}

TEST(PassiveStructures, AreAlikeOnBothSides) {
  const Skeleton& s = reference().skeleton;
  for (const Coordinate& c : s.coordinates) {
    if (!c.name.ends_with("_r")) continue;
    std::string left = c.name;
    left.back() = 'l';
    EXPECT_EQ(reference().passive_moments[std::size_t(s.coordinateIndex(c.name))],
              reference().passive_moments[std::size_t(s.coordinateIndex(left))])
        << c.name;
  }
}

/// The moments are what the clinical angles' rates do work against: no more and no less energy than is stored.
TEST(PassiveStructures, MomentsAreMinusTheGradientOfTheEnergyInEveryPosture) {
  const Skeleton& s = reference().skeleton;
  const PassiveMoments& moments = reference().passive_moments;
  std::mt19937_64 random{12};
  constexpr double h = 1e-6;
  int compared = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Posture q = postureFromClinical(s, test::randomClinical(s, random));
    const Eigen::VectorXd clinical = clinicalFromPosture(s, q);
    const Eigen::VectorXd moment_Nm = structureMoments_Nm(s, moments, q);
    for (int i = 0; i < s.coordinateCount(); ++i) {
      if (!isJoint(s, i)) continue;
      Eigen::VectorXd more = clinical, less = clinical;
      more[i] += h, less[i] -= h;
      const double up_J = structureEnergy_J(s, moments, postureFromClinical(s, more));
      const double down_J = structureEnergy_J(s, moments, postureFromClinical(s, less));
      // Where two readings store the same energy the gradient jumps; and rounding of a large energy is not a moment.
      const double tolerance = 1e-3 * (1 + std::abs(moment_Nm[i])) + 1e-9 * up_J / h;
      EXPECT_NEAR(moment_Nm[i], -(up_J - down_J) / (2 * h), tolerance) << s.coordinates[std::size_t(i)].name;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 40 * 44);
}

TEST(PassiveStructures, DoNoWorkOverAClosedPath) {
  const Skeleton& s = reference().skeleton;
  const int hip = s.coordinateIndex("hip_flexion_r");
  constexpr int kSteps = 4000;
  double work_J = 0, there_J = 0;
  Eigen::VectorXd before;
  Eigen::VectorXd force_before;
  for (int k = 0; k <= kSteps; ++k) {
    const double t = 2 * std::numbers::pi * k / kSteps;
    Eigen::VectorXd clinical = Eigen::VectorXd::Zero(s.coordinateCount());
    clinical[hip] = 0.9 + 1.05 * std::cos(t);       // from 9 deg of extension to 112 of flexion
    clinical[hip + 1] = -0.15 + 0.5 * std::sin(t);  // both ways near the ends
    clinical[hip + 2] = 0.6 * std::sin(2 * t);
    const Eigen::VectorXd force =
        structureMoments_Nm(s, reference().passive_moments, postureFromClinical(s, clinical));
    if (k > 0) {
      const double step_J = 0.5 * (force + force_before).dot(clinical - before);
      work_J += step_J;
      there_J += std::abs(step_J);
    }
    before = clinical;
    force_before = force;
  }
  EXPECT_GT(there_J, 1);              // the path does press against the ends
  EXPECT_LT(std::abs(work_J), 1e-5);  // trapezoids of 4000 steps
}

TEST(PassiveStructures, TakeTheReadingThatStoresLess) {
  // An arm abducted by 110 deg: the usual reading is 70 with the other two angles turned by half a turn.
  const Skeleton& s = reference().skeleton;
  const Posture q = postureFromDegrees(s, {{"shoulder_adduction_r", -110}});
  EXPECT_LT(structureEnergy_J(s, reference().passive_moments, q), 5);
  const int i = s.coordinateIndex("shoulder_adduction_r");
  const double alone_Nm = passiveMoment_Nm(reference().passive_moments[std::size_t(i)], -110 * kRadPerDeg);
  EXPECT_GT(alone_Nm, 1);  // towards the body
  // The rate of the usual reading's middle angle runs the other way there.
  EXPECT_NEAR(structureMoments_Nm(s, reference().passive_moments, q)[i], -alone_Nm, 1e-9);
}

TEST(PassiveStructures, GrowWithTheMassOfTheBody) {
  ShapeParameters shape;
  shape.trunk_elongation = shape.trunk_expansion = 1.1;
  for (auto& side : shape.sides)
    for (LimbBoneShape* bone : {&side.femur, &side.tibia}) bone->elongation = 1.1;
  const Model large = deformedModel(reference(), shape);
  const double ratio = bodyMass_kg(large.skeleton) / bodyMass_kg(reference().skeleton);
  ASSERT_GT(ratio, 1.1);
  for (std::size_t i = 0; i < large.passive_moments.size(); ++i) {
    EXPECT_NEAR(large.passive_moments[i].upper_Nm, ratio * reference().passive_moments[i].upper_Nm, 1e-9);
    EXPECT_EQ(large.passive_moments[i].upper_rate_per_rad, reference().passive_moments[i].upper_rate_per_rad);
  }
  PhysicsFactors heavier;
  for (int i = 0; i < large.skeleton.movingSegmentCount(); ++i)
    heavier.mass_factors[large.skeleton.segments[std::size_t(i)].name] = 2;
  const Model twice = withPhysics(large, reference(), heavier);
  const auto hip = std::size_t(reference().skeleton.coordinateIndex("hip_flexion_l"));
  EXPECT_NEAR(twice.passive_moments[hip].lower_Nm, 2 * large.passive_moments[hip].lower_Nm, 1e-9);
}

TEST(PassiveStructures, ChildrenAreLaxAndAgainAsStiffWhenGrown) {
  const Skeleton& s = reference().skeleton;
  const auto ir = std::size_t(s.coordinateIndex("hip_internal_rotation_r"));
  const double adult_rad = s.coordinates[ir].stop_max_rad;
  const auto at = [&](const Model& model, double age) {
    PhysicsFactors factors;
    factors.age_years = age;
    return withPhysics(model, reference(), factors);
  };
  const Model five = at(reference(), 5);
  EXPECT_NEAR(five.skeleton.coordinates[ir].stop_max_rad, adult_rad + 12 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(at(reference(), 6).skeleton.coordinates[ir].stop_max_rad, adult_rad + 12.5 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(at(five, 40).skeleton.coordinates[ir].stop_max_rad, adult_rad, 1e-12);
  EXPECT_NEAR(withPhysics(five, reference(), {}).skeleton.coordinates[ir].stop_max_rad, adult_rad, 1e-12);
  for (const double age : {0.5, 5.0, 12.0, 20.0})
    for (std::size_t i = 0; i < s.coordinates.size(); ++i) {
      const Model model = at(reference(), age);
      EXPECT_GE(model.skeleton.coordinates[i].stop_max_rad, s.coordinates[i].stop_max_rad);
      EXPECT_LE(model.skeleton.coordinates[i].stop_min_rad, s.coordinates[i].stop_min_rad);
      EXPECT_LE(model.skeleton.coordinates[i].stop_max_rad, s.coordinates[i].athlete_max_rad + 1e-12);
    }
}

TEST(PassiveStructures, AStopThatAPersonMovedStaysAtEveryAge) {
  Model model = reference();
  const auto knee = std::size_t(model.skeleton.coordinateIndex("knee_flexion_r"));
  model.skeleton.coordinates[knee].stop_max_rad = 1;
  PhysicsFactors factors;
  factors.age_years = 7;
  const Model young = withPhysics(model, reference(), factors);
  EXPECT_EQ(young.skeleton.coordinates[knee].stop_max_rad, 1);
  EXPECT_EQ(young.passive_moments[knee].upper_rad, 1);
}

TEST(PassiveStructures, SurviveTheModelFileAndOldFilesGetThem) {
  const test::TemporaryFolder folder;
  const BodyDescription child = loadShapePreset(test::resourceDir(), "child");
  const Model model = withPhysics(deformedModel(reference(), child.shape), reference(), child.physics);
  const auto file = folder.path() / "child.json";
  saveModel(model, file);
  const Model back = loadModel(file, reference());
  EXPECT_EQ(back.passive_moments, model.passive_moments);
  EXPECT_EQ(back.physics, model.physics);
  // A file from before there were structures.
  std::string text = readFile(file);
  const auto begin = text.find("  \"passive_moments\""), end = text.find("  \"muscles\"");
  ASSERT_NE(begin, std::string::npos);
  text.erase(begin, end - begin);
  writeFileAtomically(file, text);
  const Model old = loadModel(file, reference());
  ASSERT_EQ(old.passive_moments.size(), model.passive_moments.size());
  for (std::size_t i = 0; i < model.passive_moments.size(); ++i)
    EXPECT_NEAR(old.passive_moments[i].upper_Nm, model.passive_moments[i].upper_Nm, 1e-9);
}

TEST(PassiveStructures, ThatEndElsewhereThanTheStopAreAFinding) {
  Model model = reference();
  EXPECT_TRUE(validateModel(model).empty());
  model.passive_moments[std::size_t(model.skeleton.coordinateIndex("knee_flexion_r"))].upper_rad -= 0.01;
  const Warnings findings = validateModel(model);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].code, "passive_structures");
  EXPECT_THAT(findings[0].message, testing::HasSubstr("knee_flexion_r"));
}

TEST(PassiveStructures, ABadFileIsNamed) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "skeleton");
  const auto failsWith = [&](std::string text, const std::string& from, const std::string& to, const char* words) {
    text.replace(text.find(from), from.size(), to);
    writeFileAtomically(folder.path() / "skeleton/passive_moments.json", text);
    try {
      loadPassiveStructures(folder.path(), reference().skeleton, "average-adult");
      ADD_FAILURE() << "read " << to;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(words));
    }
  };
  const std::string good = readFile(test::resourceDir() / "skeleton/passive_moments.json");
  failsWith(good, "\"hip_adduction\"", "\"hip_abduction\"", "hip_adduction");
  failsWith(good, "\"rate_per_rad\": 21.88", "\"rate_per_rad\": -21.88", "rate_per_rad");
  failsWith(good, "\"coordinate\": \"hip_adduction\"", "\"coordinate\": \"hip_flexion\"", "twice");
}

}  // namespace
}  // namespace sinew
