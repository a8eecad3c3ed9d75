// The experiments on small variants, with answers that are known beforehand.
#include <gmock/gmock.h>

#include <algorithm>
#include <numbers>

#include "app/experiments/characters.h"
#include "app/experiments/disorders.h"
#include "app/experiments/experiment_shapes.h"
#include "app/experiments/kept_functions.h"
#include "app/experiments/method_comparison.h"
#include "app/experiments/moment_arm_curves.h"
#include "app/experiments/popliteal.h"
#include "app/experiments/pose_dependence.h"
#include "app/experiments/rom_preservation.h"
#include "core/posture/evaluate.h"
#include "core/retarget/prepared/reference.h"
#include "core/rom/poses/pose_sampler.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

/// The reference with few postures: quick, and enough for what is asked here.
const RetargetReference& reference() {
  static const auto made = [] {
    Model model = loadReferenceModel(test::resourceDir());
    auto motions = loadJointMotions(test::resourceDir(), model.skeleton);
    auto poses = std::make_shared<PoseSet>(
        sampledPoseSet(model.skeleton, loadRomPreset(test::resourceDir(), "average-adult", model.skeleton),
                       loadClinicalTests(test::resourceDir(), model.skeleton).tests, {.count = 4000}));
    return std::make_unique<const RetargetReference>(std::move(model), std::move(motions), std::move(poses));
  }();
  return *made;
}

/// The reference in which the short head of the biceps femoris runs where a vastus does: a flexor of the knee that
/// extends it.
Model withReversedFlexor() {
  Model body = reference().model();
  auto& units = body.musculature.units;
  units[std::size_t(body.musculature.unitIndex("biceps_femoris_short_head_r"))].path =
      body.musculature.unit("vastus_intermedius_medial_r").path;
  return body;
}

TEST(ExperimentShapes, AreThoseOfThePaper) {
  const ShapeParameters limbs = withLimbElongation(2.5), femora = withFemora(0.7, 0.5);
  for (const SideShape& side : limbs.sides)
    EXPECT_THAT(
        (std::array{side.femur.elongation, side.tibia.elongation, side.humerus.elongation, side.ulna.elongation}),
        ::testing::Each(2.5));
  for (const SideShape& side : femora.sides) {
    EXPECT_EQ(side.femur.elongation, 0.7);
    EXPECT_EQ(side.femur.torsion_rad, 0.5);
    EXPECT_EQ(side.tibia, LimbBoneShape{});
  }
}

TEST(ExperimentShapes, RandomOnesStayInTheirRangesAndAreTheSameEveryTime) {
  const auto shapes = randomShapes(50, kMildShapes, 1);
  EXPECT_EQ(shapes, randomShapes(50, kMildShapes, 1));
  EXPECT_NE(shapes, randomShapes(50, kMildShapes, 2));
  for (const ShapeParameters& shape : shapes)
    for (const SideShape& side : shape.sides)
      for (const LimbBoneShape& bone : {side.femur, side.tibia, side.humerus, side.ulna}) {
        EXPECT_THAT(bone.elongation, ::testing::AllOf(::testing::Ge(0.8), ::testing::Le(1.3)));
        EXPECT_LE(std::abs(bone.torsion_rad), 20 * std::numbers::pi / 180);
      }
}

TEST(Disorders, OnlyAReversedMuscleIsOne) {
  const auto own = reversalShares(reference(), reference().model(), kRoutingSamples - 1);
  EXPECT_THAT(own, ::testing::Each(0.0));
  const auto reversed = reversalShares(reference(), withReversedFlexor(), 40);
  const auto flexor = std::size_t(reference().model().musculature.unitIndex("biceps_femoris_short_head_r"));
  EXPECT_GT(reversed[flexor], 0.9);  // nearly all the way
  EXPECT_EQ(std::ranges::count(reversed, 0.0), long(reversed.size()) - 1);
}

TEST(Disorders, DirectionsAndReversalsByHand) {
  // A range of 1 in four steps: one below 0.02 x 10 / 4 = 0.05 has no direction.
  const std::vector<int> directions = stepDirections(std::vector{0.0, 0.96, 1.0, 0.9, 0.1});
  EXPECT_THAT(directions, ::testing::ElementsAre(1, 0, -1, -1));
  StepCount count;
  countReversals(directions, std::vector{5.0, 4.0, 3.0, 2.0, 2.5}, count);
  EXPECT_EQ(count.directed, 3);
  EXPECT_EQ(count.reversed, 2);
  EXPECT_NEAR(count.share(), 2.0 / 3, 1e-15);
}

TEST(Disorders, NoMuscleReversesMoreThanWithoutRetargeting) {
  const Disorders found = disorders(reference(), {.elongations = {0.6, 1.3, 2.5}});
  ASSERT_EQ(found.outcome, Outcome::Converged);
  for (const DisorderRow& row : found.rows)
    for (std::size_t u = 0; u < found.units.size(); ++u)
      EXPECT_LE(row.retargeted[u], row.naive[u]) << found.units[u] << " at " << row.elongation;
  EXPECT_THAT(found.rows[1].retargeted, ::testing::Each(0.0));  // mild: none at all
}

TEST(KeptFunctions, OnlyAReversedMuscleLosesThem) {
  const KeptFunctions own = keptFunctions(reference(), reference().model());
  EXPECT_EQ(own.share(), 1);
  EXPECT_GT(own.shortenings, 282);  // every unit does something, most in several motions
  const KeptFunctions reversed = keptFunctions(reference(), withReversedFlexor());
  EXPECT_THAT(reversed.lost, ::testing::Not(::testing::IsEmpty()));
  EXPECT_THAT(reversed.lost, ::testing::Each(::testing::StartsWith("biceps_femoris_short_head_r, knee flexion")));
}

TEST(RomPreservation, TheReferenceHasNoErrorAndRetargetingLittle) {
  const RomPreservation found =
      romPreservation(reference(), {.elongations = {1, 1.3}, .torsions_deg = {0, 30}, .knee_flexions_deg = {0}});
  ASSERT_EQ(found.outcome, Outcome::Converged);
  ASSERT_EQ(found.rows.size(), 4u);
  EXPECT_EQ(found.rows[0].naive[0].muscles.differing(), 0);
  EXPECT_EQ(found.rows[0].retargeted[0].muscles.differing(), 0);
  for (std::size_t i = 1; i < 4; ++i) {
    const RomPreservationRow& row = found.rows[i];
    EXPECT_LT(row.retargeted[0].muscles.differing(), row.naive[0].muscles.differing());
    EXPECT_LT(row.retargeted[0].muscles.ofAll(), 0.017);  // Ryu et al.
  }
}

TEST(MethodComparison, LeastSquaresEndLowerThanTheDescent) {
  const MethodComparison found = compareMethods(reference(), {{"long femora", withFemora(1.2, 0.2)}});
  ASSERT_EQ(found.outcome, Outcome::Converged);
  const EnergyVerdict verdict = energyVerdict(found);
  EXPECT_EQ(verdict.compared, verdict.lower + verdict.equal + verdict.higher);
  EXPECT_GT(verdict.compared, 30);  // units of thigh and hip at least
  EXPECT_LT(verdict.sum_sinew, verdict.sum_paper);
  EXPECT_LT(verdict.sum_paper, verdict.sum_start);
  const BodyComparison& body = found.bodies.front();
  EXPECT_GT(body.whole_paper.cpu_s, body.whole_sinew.cpu_s);  // by more than any noise: see docs/validation.md
  EXPECT_GT(body.peaks_sinew.motions, 70);
  EXPECT_GE(body.peaks_sinew.within_after, body.peaks_sinew.within_before);
  EXPECT_GE(body.peaks_sinew.within_after, body.peaks_paper.within_after);
}

TEST(EnergyVerdict, CountsByHand) {
  MethodComparison comparison{Outcome::Converged, {"a", "b", "c", "d", "e", "f"}, {}};
  BodyComparison body{.name = "body"};
  body.start = {1, 1, 1, 0, 1, 1};  // nothing to improve in the fourth
  body.paper = {0.5, 0.5, 0.5, 0, 1, 0.5};
  body.sinew = {0.4, 0.5, 0.6, 0, 1, 0.55};
  body.paper_reversed = {0.1, 0, 0, 0, 0, 0.1};
  body.sinew_reversed = {0, 0, 0, 0, 0, 0};
  comparison.bodies = {body};
  const EnergyVerdict v = energyVerdict(comparison);
  EXPECT_EQ(v.compared, 5);
  EXPECT_EQ(v.lower, 1);
  EXPECT_EQ(v.equal, 2);
  EXPECT_EQ(v.equal_at_start, 1);
  EXPECT_EQ(v.higher, 2);
  EXPECT_EQ(v.higher_by_one_percent, 2);
  EXPECT_EQ(v.higher_for_order, 1);
  EXPECT_NEAR(v.worst_ratio, 1.2, 1e-12);
  EXPECT_EQ(v.worst_unit, "c, body");
}

TEST(PeakTorqueTotals, CountByHand) {
  const double nan = std::nan("");
  const std::vector<PeakTorqueAngle> angles = {{"kept", 30, 30, 31},
                                               {"restored", 30, 40, 32},
                                               {"missed", 30, 32, 34},
                                               {"lost", 30, 30, nan},
                                               {"none", nan, 1, 1}};
  const PeakTorqueTotals t = peakTorqueTotals(angles);
  EXPECT_EQ(t.motions, 4);
  EXPECT_EQ(t.within_before, 3);
  EXPECT_EQ(t.within_after, 2);
  EXPECT_EQ(t.worst_before_deg, 10);
  EXPECT_EQ(t.worst_after_deg, 180);
}

TEST(Characters, TheHumanIsTheReference) {
  const Character human = makeCharacter(reference(), loadShapePreset(test::resourceDir(), "human"));
  ASSERT_EQ(human.retargeted.outcome, Outcome::Converged);
  for (const UnitRouting& unit : human.retargeted.routing) EXPECT_LT(unit.largest_move_m, 1e-4) << unit.unit;
  EXPECT_NEAR(human.height_m, 1.75, 0.1);  // an adult man
  double reference_kg = 0;
  for (const Segment& segment : reference().model().skeleton.segments) reference_kg += segment.mass_kg;
  EXPECT_NEAR(human.mass_kg, reference_kg, 1e-9);
  for (const RestingVerdict& rest : human.at_rest)
    EXPECT_TRUE(rest.valid) << rest.posture << ": " << rest.first_to_fail;

  // ... and so are its moment arms.
  const MomentArmFigure figure =
      momentArmFigure(reference(), std::span{&human, 1}, {"iliacus_anterior_r", "hip_flexion"});
  ASSERT_EQ(figure.curves.size(), 2u);
  const auto& model = reference().model();
  const MotionCurve expected = motionCurve(model.skeleton, model.musculature.unit("iliacus_anterior_r"),
                                           findMotion(reference().motions(), "hip_flexion"), 41);
  for (std::size_t i = 0; i < expected.theta.size(); ++i) {
    EXPECT_NEAR(figure.curves[0].arm_m[i], expected.moment_arm_m[i], 1e-12);  // flexion increases the coordinate
    EXPECT_NEAR(figure.curves[1].arm_m[i], figure.curves[0].arm_m[i], 1e-6);
  }
}

TEST(PoseDependence, AFlexedKneeFreesTheHip) {
  const auto rows = poseDependence(reference().model(), {0, 90});
  EXPECT_GT(rows[1].with_stops.validCount(), rows[0].with_stops.validCount());
  EXPECT_GT(forwardCount(rows[1].muscles), forwardCount(rows[0].muscles));
  EXPECT_GT(rows[1].flexion_deg, rows[0].flexion_deg);
}

TEST(Popliteal, TheReferenceHasThePapersAngle) {
  const PoplitealRow row = poplitealRow(test::resourceDir(), reference().model(), "reference");
  EXPECT_NEAR(row.angle_deg, kPoplitealReference_deg, kPoplitealTolerance_deg);
  EXPECT_FALSE(row.stopped_by_joint);
}

}  // namespace
}  // namespace sinew
