#include "clinical/exam/physical_exam.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "clinical/exam/exam_study.h"
#include "core/model/physical_scaling.h"
#include "core/passive/structures.h"
#include "core/posture/evaluate.h"
#include "core/random_source.h"
#include "core/rom/tests/threshold.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

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
/// The reference's own body, whose examiner's moments are as stated.
ExamSubject adult() {
  return {.mass_kg = tests().reference_mass_kg};
}
const Examiner& examiner() {
  static const Examiner e{reference(), tests(), adult()};
  return e;
}

std::map<std::string, double> groupFactor(const char* group, char side, double factor) {
  std::map<std::string, double> factors;
  for (const auto& unit : tests().group(group).units) factors[unit + "_" + side] = factor;
  return factors;
}

/// What an exact examiner would write down about `patient`, as far as the form goes.
PhysicalExam examine(const Model& patient, char side, const ExamSubject& subject = adult()) {
  PhysicalExam exam;
  for (const ClinicalTest* test : tests().form()) {
    const double found_deg =
        simulateTest(patient, *test, side, scaledThreshold_Nm(*test, subject.mass_kg)).written_deg;
    exam.entries.push_back(
        {test->id, side, std::clamp(found_deg, test->form->entry_min_deg, test->form->entry_max_deg)});
  }
  return exam;
}

/// Every test exactly at the mean of the norm, both sides.
PhysicalExam atNorm(const NormGroup& who) {
  PhysicalExam exam;
  for (const ClinicalTest* test : tests().form())
    if (const TestNorm norm = normOf(*test, who); std::isfinite(norm.mean_deg))
      for (const char side : {'r', 'l'})
        exam.entries.push_back(
            {test->id, side,
             std::clamp(test->written_deg(norm.mean_deg), test->form->entry_min_deg, test->form->entry_max_deg)});
  return exam;
}

double factorOf(const ExamFit& fit, const std::string& unit) {
  const auto found = fit.length_factors.find(unit);
  return found == fit.length_factors.end() ? 1.0 : found->second;
}
const GroupFactor& groupOf(const ExamFit& fit, const std::string& group, char side) {
  return *std::ranges::find_if(fit.groups, [&](const GroupFactor& g) { return g.group == group && g.side == side; });
}
const ExamComparison& lineOf(const ExamFit& fit, const std::string& test, char side) {
  return *std::ranges::find_if(fit.tests, [&](const ExamComparison& c) { return c.test == test && c.side == side; });
}

TEST(ApplyExam, RecoversTheLengthsThatMadeTheExamination) {
  auto truth = groupFactor("hamstrings", 'r', 0.90);
  truth.merge(groupFactor("gastrocnemius", 'r', 0.93));
  truth.merge(groupFactor("hip_flexors", 'r', 0.78));
  truth.merge(groupFactor("rectus_femoris", 'r', 0.94));
  const Model patient = withLengthFactors(reference(), truth);
  PhysicalExam exam = examine(patient, 'r');
  exam.leave_in_norm = false;
  const ExamFit fit = applyExam(reference(), exam, tests(), adult());
  ASSERT_EQ(fit.outcome, Outcome::Converged);
  for (const auto& [unit, factor] : truth) EXPECT_NEAR(factorOf(fit, unit), factor, 0.005) << unit;
  // The pull to 1 costs 0.002 of the hamstrings' length, and a degree is 0.0016. (Hips that cannot be laid flat
  // cannot be abducted or turned either: what the form then holds is its limit, and the reason says so.)
  for (const char* test :
       {"popliteal_unilateral", "staheli", "silfverskioeld_knee_extended", "silfverskioeld_knee_flexed"})
    EXPECT_LT(std::abs(lineOf(fit, test, 'r').residual_deg), 1.5) << test;
  for (const auto& line : fit.tests)
    if (std::abs(line.residual_deg) > kNamedResidual_deg) {
      EXPECT_FALSE(line.reason.empty()) << line.test;
    }
}

/// The norm of the product's own tables must not find anything: hip flexors were "18 % short" at it.
TEST(ApplyExam, FindsNothingAtTheNorm) {
  const ExamFit fit = applyExam(reference(), atNorm({"average-adult", {}, ""}), tests(), adult());
  ASSERT_EQ(fit.outcome, Outcome::Converged);
  for (const auto& g : fit.groups) EXPECT_NEAR(g.factor, 1, 0.02) << g.group << g.side;
  // Standing, nothing pulls at the hip: it was 39 N m with those hip flexors.
  const Model after = withLengthFactors(reference(), fit.length_factors);
  const auto evaluation = evaluatePosture(after.skeleton, after.musculature, zeroPosture(after.skeleton));
  EXPECT_LT(std::abs(evaluation.passive_torque[after.skeleton.coordinateIndex("hip_flexion_r")]), 3);
}

/// Children of 5, 8 and 12 years: their size, their mass, their norms.
TEST(ApplyExam, FindsNothingAtTheNormOfAChild) {
  for (const auto& [age_y, height_ratio, mass_kg] :
       {std::tuple{5.0, 0.63, 18.5}, {8.0, 0.74, 26.0}, {12.0, 0.87, 41.0}}) {
    std::vector<double> values = toVector(ShapeParameters{});
    for (double& v : values)
      if (v == 1) v = height_ratio;  // every ratio alike, no angle
    const ShapeParameters shape = shapeFromVector(values);
    Model child = deformedModel(reference(), shape);
    PhysicsFactors factors;
    factors.mass_factors = massFactorsFor(reference().skeleton, shape, mass_kg);
    factors.age_years = age_y;
    child = withPhysics(child, reference(), factors);
    EXPECT_NEAR(bodyMass_kg(child.skeleton), mass_kg, 0.01);
    const ExamFit fit = applyExam(child, atNorm({"average-adult", age_y, "F"}), tests(), {mass_kg, age_y, "F"});
    ASSERT_EQ(fit.outcome, Outcome::Converged);
    for (const auto& g : fit.groups) EXPECT_NEAR(g.factor, 1, 0.02) << age_y << " y: " << g.group << g.side;
  }
}

/// More extension than capsule and bone allow says nothing about a short muscle.
TEST(ApplyExam, BeyondTheJointNothingIsShort) {
  for (const bool leave : {true, false})
    for (const auto& [test, measured_deg, group] : {std::tuple{"staheli", -19.0, "hip_flexors"},
                                                    {"staheli", -30.0, "hip_flexors"},
                                                    {"silfverskioeld_knee_flexed", 40.0, "soleus"},
                                                    {"popliteal_unilateral", 0.0, "hamstrings"},
                                                    {"duncan_ely", 160.0, "rectus_femoris"},
                                                    {"abd_knee_flex", 75.0, "adductors"}}) {
      PhysicalExam exam{.leave_in_norm = leave};
      exam.entries.push_back({test, 'r', measured_deg});
      const ExamFit fit = examiner().fit(exam);
      EXPECT_GE(groupOf(fit, group, 'r').factor, 1 - 1e-6) << test << " " << measured_deg;
      const ExamComparison& line = lineOf(fit, test, 'r');
      if (std::abs(line.residual_deg) > kNamedResidual_deg) {
        EXPECT_FALSE(line.reason.empty()) << test;
      }
    }
}

/// Tests of which the bar is missed: a rectus femoris that holds only near the capsule's own end; gracilis, which
/// shares its test with adductors that hold most of it; gastrocnemius beyond 42 deg of equinus. Figures:
/// docs/validation.md.
bool missesTheBar(const FactorCurve& curve) {
  return curve.test == "duncan_ely" || curve.test == "abd_hip_ext" || curve.test == "silfverskioeld_knee_extended";
}

/// Where lengths begin to change there is no jump: the old hip flexors went from 1.000 to 0.821 within a degree.
TEST(ApplyExam, FactorsFollowTheMeasurementWithoutJumps) {
  for (const bool leave : {true, false})
    for (const FactorCurve& curve : factorCurves(examiner(), leave, 2)) {
      if (missesTheBar(curve)) continue;
      EXPECT_LT(curve.largest_slope_per_deg, leave ? 0.02 : 0.035) << curve.test << leave;
      EXPECT_LT(curve.largest_step_back, leave ? 1e-4 : 0.012) << curve.test << leave;  // the solver's tolerance
    }
}

TEST(ApplyExam, ASilfverskioeldDifferenceChangesGastrocnemiusNotSoleus) {
  const Model patient = withLengthFactors(reference(), groupFactor("gastrocnemius", 'l', 0.90));
  const ExamFit fit = examiner().fit(examine(patient, 'l'));
  ASSERT_EQ(fit.outcome, Outcome::Converged);
  EXPECT_NEAR(factorOf(fit, "gastrocnemius_medial_l"), 0.90, 0.005);
  EXPECT_NEAR(factorOf(fit, "soleus_medial_l"), 1, 0.005);
  EXPECT_NEAR(factorOf(fit, "semimembranosus_l"), 1, 0.005);
}

TEST(ApplyExam, LeavesUntestedSidesAndGroupsExactly) {
  PhysicalExam exam;
  exam.entries.push_back({"popliteal_unilateral", 'r', 65.0});
  exam.entries.push_back({"staheli", 'r', std::nullopt, "pain"});
  const ExamFit fit = examiner().fit(exam);
  ASSERT_EQ(fit.outcome, Outcome::Converged);
  EXPECT_EQ(fit.length_factors.size(), 3u);
  for (const auto& [unit, factor] : fit.length_factors)
    EXPECT_THAT(unit, testing::AnyOf("biceps_femoris_long_head_r", "semitendinosus_r", "semimembranosus_r"));
  for (const auto& line : fit.tests)
    EXPECT_EQ(std::isnan(line.residual_deg), !(line.test == "popliteal_unilateral" && line.side == 'r'));
  EXPECT_EQ(fit.tests.size(), 2 * tests().form().size());
  for (const auto& g : fit.groups) EXPECT_EQ(g.tested, g.group == "hamstrings" && g.side == 'r');
}

TEST(ApplyExam, SaysWhatMuscleLengthsCannotMeetAndKeepsTheOtherSide) {
  PhysicalExam exam;  // equinus with a bent knee, yet free with a straight one
  exam.entries.push_back({"silfverskioeld_knee_flexed", 'r', -60.0});
  exam.entries.push_back({"silfverskioeld_knee_extended", 'r', 30.0});
  exam.entries.push_back({"popliteal_unilateral", 'l', 70.0});
  const ExamFit fit = examiner().fit(exam);
  double worst_deg = 0;
  for (const auto& line : fit.tests)
    if (line.side == 'r' && !std::isnan(line.residual_deg))
      worst_deg = std::max(worst_deg, std::abs(line.residual_deg));
  EXPECT_GT(worst_deg, 10);
  EXPECT_THAT(fit.warnings, testing::Contains(testing::Field(&Warning::code, "exam_not_met")));
  EXPECT_THAT(fit.warnings, testing::Contains(testing::Field(&Warning::code, "exam_contradiction")));
  EXPECT_LT(std::abs(lineOf(fit, "popliteal_unilateral", 'l').residual_deg), 1);
  EXPECT_LT(factorOf(fit, "semimembranosus_l"), 0.95);
}

TEST(ApplyExam, NamesEveryContradictionOfTheProtocol) {
  for (const TestContradiction& rule : tests().contradictions) {
    PhysicalExam exam;
    const FormRow &a = *tests().test(rule.first).form, &b = *tests().test(rule.second).form;
    const bool above = std::isfinite(rule.most_deg);
    exam.entries.push_back({rule.first, 'l', above ? a.doubt_max_deg : a.doubt_min_deg});
    exam.entries.push_back({rule.second, 'l', above == rule.sum ? b.doubt_max_deg : b.doubt_min_deg});
    const Warnings warnings = checkExam(exam, tests());
    EXPECT_THAT(warnings,
                testing::Contains(testing::AllOf(testing::Field(&Warning::code, "exam_contradiction"),
                                                 testing::Field(&Warning::message, testing::HasSubstr(rule.text)))))
        << rule.first << " " << rule.second;
  }
}

/// Of 723 random plausible tests 19 were off by more than a degree, 12 of these without a warning.
TEST(ApplyExam, EveryResidualAboveADegreeNamesItsReason) {
  for (const bool leave : {true, false}) {
    const RandomExams study = randomExams(examiner(), leave, 20, 7);
    EXPECT_GT(study.tests, 60);
    EXPECT_EQ(study.unnamed, 0) << leave;
    EXPECT_EQ(study.not_solved, 0) << leave;
  }
}

/// Exact patients, noisy examiners: the interval holds the truth in nine of ten draws and more.
TEST(ApplyExam, IntervalsHoldTheTruth) {
  const double truth = 0.88;
  const Model patient = withLengthFactors(reference(), groupFactor("hamstrings", 'r', truth));
  const ClinicalTest& test = tests().test("popliteal_unilateral");
  const double exact_deg = simulateTest(patient, test, 'r', test.threshold_Nm).written_deg;
  RandomSource random{11};
  constexpr int kDraws = 60;
  int held = 0;
  for (int i = 0; i < kDraws; ++i) {
    PhysicalExam exam;
    exam.entries.push_back({test.id, 'r', exact_deg + test.form->measurement_sd_deg * random.normal()});
    const ExamFit fit = examiner().fit(exam);
    const GroupFactor& g = groupOf(fit, "hamstrings", 'r');
    EXPECT_TRUE(g.determined);
    EXPECT_LE(g.lower95, g.factor);
    EXPECT_GE(g.upper95, g.factor);
    held += g.lower95 <= truth && truth <= g.upper95;
  }
  EXPECT_GE(held, 54);  // the band of the examiners and the bones make it wider than the noise alone
}

TEST(ApplyExam, WhatAStiffCapsuleHidesIsUndetermined) {
  PhysicalExam exam;
  exam.entries.push_back({"staheli", 'r', -11.0});
  const GroupFactor g = groupOf(examiner().fit(exam), "hip_flexors", 'r');
  EXPECT_TRUE(g.tested);
  EXPECT_FALSE(g.determined);  // any longer muscle would do
  EXPECT_GT(g.upper95, 1.2);
}

/// Others scale the fibre alone: the same angle, with a larger change of the fibre.
TEST(ApplyExam, FibersAloneMeetTheSameTest) {
  PhysicalExam exam{.leave_in_norm = false};
  exam.entries.push_back({"popliteal_unilateral", 'r', 65.0});
  const GroupFactor g = groupOf(examiner().fit(exam), "hamstrings", 'r');
  EXPECT_LT(g.fiber_only_factor, g.factor - 0.05);
  Model scaled = reference();
  for (const auto& unit : tests().group("hamstrings").units)
    scaled.musculature.units[std::size_t(scaled.musculature.unitIndex(unit + "_r"))].optimal_fiber_length_m *=
        g.fiber_only_factor;
  const ClinicalTest& test = tests().test("popliteal_unilateral");
  EXPECT_NEAR(simulateTest(scaled, test, 'r', test.threshold_Nm).written_deg, 65, 1);
}

TEST(ApplyExam, CancelledFitCarriesNoNumbers) {
  std::stop_source stop;
  stop.request_stop();
  PhysicalExam exam;
  exam.entries.push_back({"popliteal_unilateral", 'r', 55.0});
  const ExamFit fit = applyExam(reference(), exam, tests(), adult(), {.stop = stop.get_token()});
  EXPECT_EQ(fit.outcome, Outcome::Cancelled);
  EXPECT_TRUE(fit.tests.empty());
  EXPECT_TRUE(fit.length_factors.empty());
}

TEST(CheckExam, RefusesTheImpossibleAndDoubtsTheUnusual) {
  PhysicalExam exam;
  exam.entries.push_back({"popliteal_unilateral", 'r', 95.0});
  EXPECT_THAT(checkExam(exam, tests()), testing::ElementsAre(testing::Field(&Warning::code, "exam_unusual")));
  exam.entries[0].measured_deg = 121;
  EXPECT_THROW(checkExam(exam, tests()), InputError);
  exam.entries[0].measured_deg = std::nan("");
  EXPECT_THROW(checkExam(exam, tests()), InputError);
  exam.entries[0] = {"poplitael_unilateral", 'r', 30.0};
  try {
    checkExam(exam, tests());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("popliteal_unilateral"));
  }
}

TEST(PhysicalExam, FileGoesBothWays) {
  const test::TemporaryFolder folder;
  PhysicalExam exam{
      "A. Examiner", "2024-05-06", {{"staheli", 'l', -10.0}, {"staheli", 'r', std::nullopt, "refused"}}};
  exam.leave_in_norm = false;
  saveExam(exam, folder / "exam.json");
  EXPECT_EQ(loadExam(folder / "exam.json"), exam);
}

}  // namespace
}  // namespace sinew
