#include "core/rom/tests/clinical_sweep.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/angle.h"
#include "core/model/rom_preset.h"
#include "core/passive/structures.h"
#include "core/posture/evaluate.h"
#include "core/rom/maps/coordinate_range.h"
#include "core/rom/tests/threshold.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

const Model& reference() {
  static const Model model = loadReferenceModel(test::resourceDir());
  return model;
}
const ClinicalTests& tests() {
  static const ClinicalTests t = loadClinicalTests(test::resourceDir(), reference().skeleton);
  return t;
}

/// Moment of muscles and structures about one coordinate, by the code that the window and `sinew evaluate` use.
double passiveTorque_Nm(const Model& model, const std::map<std::string, double>& posture_deg,
                        const char* coordinate) {
  const Posture q = postureFromDegrees(model.skeleton, posture_deg);
  return evaluatePosture(model.skeleton, model.musculature, q, model.passive_moments)
      .passive_torque[model.skeleton.coordinateIndex(coordinate)];
}

TEST(ClinicalSweep, ResistanceIsTheTorqueOfEvaluate) {
  const ClinicalSweep popliteal{reference(), tests().test("popliteal_unilateral"), 'r'};
  for (const double knee_deg : {80.0, 41.3, 30.0, 12.7})
    EXPECT_NEAR(
        popliteal.resistance_Nm(knee_deg),
        passiveTorque_Nm(reference(), {{"hip_flexion_r", 90}, {"knee_flexion_r", knee_deg}}, "knee_flexion_r"),
        1e-3)  // the table's interpolation
        << knee_deg;
  const ClinicalSweep extension{reference(), tests().test("staheli"), 'l'};
  for (const double hip_deg : {30.0, 3.1, -8.4})
    EXPECT_NEAR(
        extension.resistance_Nm(hip_deg),
        passiveTorque_Nm(reference(), {{"hip_flexion_l", hip_deg}, {"ankle_dorsiflexion_l", 0}, {"hip_flexion_r", 0}},
                         "hip_flexion_l"),
        1e-3)
        << hip_deg;
}

TEST(ClinicalSweep, IsTheSameOnBothSidesAndEndsAtTheThreshold) {
  for (const ClinicalTest& test : tests().tests) {
    const SimulatedTest right = simulateTest(reference(), test, 'r', test.threshold_Nm);
    const SimulatedTest left = simulateTest(reference(), test, 'l', test.threshold_Nm);
    EXPECT_NEAR(right.angle_deg, left.angle_deg, 1e-4) << test.id;
    EXPECT_FALSE(right.limited_by.empty()) << test.id;
    if (!right.stopped_by_joint && !right.limited_by.front().ends_with("longest)")) {
      EXPECT_NEAR(right.moment_Nm, test.threshold_Nm, 1e-3 * test.threshold_Nm) << test.id;
    }
  }
}

/// -20.0 by `sinew exam` and -12.0 by `sinew rom-tests`, before they were one.
TEST(ClinicalSweep, ExplorerAndTestGiveOneHipExtension) {
  const ClinicalTest& test = tests().test("staheli");
  for (const double mass_kg : {73.0, 48.0}) {
    const double threshold_Nm = scaledThreshold_Nm(test, mass_kg);
    const double tested_deg = simulateTest(reference(), test, 'r', threshold_Nm).angle_deg;
    const auto examiner = examinerMoments_Nm(tests(), reference().skeleton, mass_kg);
    const int hip = reference().skeleton.coordinateIndex("hip_flexion_r");
    EXPECT_EQ(examiner[std::size_t(hip)], threshold_Nm);
    const CoordinateRange range = muscleInducedRange(reference(), Eigen::VectorXd::Zero(50), hip, threshold_Nm);
    EXPECT_NEAR(range.low_rad * kDegPerRad, tested_deg, 0.02);  // its bisection
    EXPECT_TRUE(range.low_by_moment);
  }
}

TEST(ClinicalSweep, ShortMusclesHoldEarlierAndLengthFactorsAreLengths) {
  const ClinicalTest& test = tests().test("popliteal_unilateral");
  const ClinicalSweep sweep{reference(), test, 'r'};
  LengthFactors factors;
  Model tight = reference();
  for (const auto& name : tests().group("hamstrings").units) {
    const int unit = reference().musculature.unitIndex(name + "_r");
    factors[unit] = {0.9, 0.95};
    tight.musculature.units[std::size_t(unit)].optimal_fiber_length_m *= 0.9;
    tight.musculature.units[std::size_t(unit)].tendon_slack_length_m *= 0.95;
  }
  const double with_factors = sweep.simulate(test.threshold_Nm, factors).angle_deg;
  EXPECT_GT(with_factors, sweep.simulate(test.threshold_Nm).angle_deg + 5);
  EXPECT_NEAR(with_factors, simulateTest(tight, test, 'r', test.threshold_Nm).angle_deg, 1e-4);
  EXPECT_NEAR(sweep.freeEndNear_deg(with_factors + 1, test.threshold_Nm, factors),
              sweep.freeEnd_deg(test.threshold_Nm, factors), 1e-5);
}

TEST(ClinicalSweep, ThresholdsScaleWithMassFromTheReferencesOwn) {
  const ClinicalTest& test = tests().test("popliteal_unilateral");
  EXPECT_NEAR(tests().reference_mass_kg, bodyMass_kg(reference().skeleton), 0.1);
  EXPECT_EQ(scaledThreshold_Nm(test, tests().reference_mass_kg), 50);
  EXPECT_NEAR(scaledThreshold_Nm(test, 21.9), 15, 1e-9);  // a child's 15 N m are an adult's 50
}

TEST(ClinicalSweep, AnAliasIsTheSameTest) {
  EXPECT_EQ(&tests().test("popliteal_adult"), &tests().test("popliteal_unilateral"));
  EXPECT_EQ(tests().test("silf_knee_ext").id, "silfverskioeld_knee_extended");
  EXPECT_THROW(tests().test("popliteal_adlut"), InputError);
}

TEST(TestNorms, AreThoseOfAgeAndSex) {
  const ClinicalTest& popliteal = tests().test("popliteal_unilateral");
  const auto mean = [&](std::optional<double> age_y, const char* sex) {
    return normOf(popliteal, {"average-adult", age_y, sex}).mean_deg;
  };
  EXPECT_EQ(mean({}, ""), 33);
  EXPECT_EQ(mean(30, "M"), 33);
  EXPECT_EQ(mean(8, "F"), 26);
  EXPECT_EQ(mean(4.5, "F"), 17);
  EXPECT_EQ(mean(4.5, "M"), 27);
  EXPECT_EQ(mean(2, ""), 6);
  EXPECT_EQ(normOf(tests().test("popliteal_bilateral"), {"average-adult", {}, ""}).mean_deg, 15);
  EXPECT_EQ(normOf(tests().test("ir_prone"), {"average-adult", 7, ""}).mean_deg, 51);
  EXPECT_EQ(normOf(tests().test("staheli"), {"average-adult", {}, ""}).mean_deg, -10);  // not the adolescents'
}

/// Every number of the form can be meant: limits in order, norms inside, conventions that go both ways.
TEST(TestNorms, FormsAreConsistent) {
  for (const ClinicalTest* test : tests().form()) {
    const FormRow& form = *test->form;
    EXPECT_LE(form.entry_min_deg, form.doubt_min_deg) << test->id;
    EXPECT_GE(form.entry_max_deg, form.doubt_max_deg) << test->id;
    EXPECT_NEAR(form.angle_deg(form.written_deg(12.5)), 12.5, 1e-12) << test->id;
    for (const double age_y : {5.0, 8.0, 12.0, 30.0}) {
      const TestNorm norm = normOf(*test, {"average-adult", age_y, "F"});
      ASSERT_TRUE(norm.known()) << test->id << age_y;
      EXPECT_FALSE(norm.source.empty()) << test->id;
      EXPECT_GE(form.written_deg(norm.mean_deg), form.doubt_min_deg) << test->id << age_y;
      EXPECT_LE(form.written_deg(norm.mean_deg), form.doubt_max_deg) << test->id << age_y;
    }
    // The reference by itself lies within what the form takes for possible.
    const double own_deg = simulateTest(reference(), *test, 'r', test->threshold_Nm).written_deg;
    EXPECT_GE(own_deg, form.entry_min_deg) << test->id;
    EXPECT_LE(own_deg, form.entry_max_deg) << test->id;
  }
}

}  // namespace
}  // namespace sinew
