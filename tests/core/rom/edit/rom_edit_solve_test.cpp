#include "core/rom/edit/rom_edit_solve.h"
#include "core/angle.h"

#include <gtest/gtest.h>

#include <set>

#include "app/experiments/rom_edit_experiment.h"
#include "core/error.h"
#include "core/muscle/hill.h"
#include "core/posture/muscle_role.h"
#include "core/rom/edit/rom_edit_target.h"
#include "core/rom/edit/threshold_fit_internal.h"
#include "core/rom/maps/rom_cells_internal.h"
#include "core/rom/maps/rom_limits.h"
#include "core/rom/poses/pose_sampler.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

const Model& reference() {
  static const Model model = loadReferenceModel(test::resourceDir());
  return model;
}

/// A smaller set than the product's: quicker, and what is tested here does not depend on its size.
RomEditSolver& solver() {
  static RomEditSolver s = [] {
    const RomPreset preset = loadRomPreset(test::resourceDir(), kDefaultPreset, reference().skeleton);
    const ClinicalTests norms = loadClinicalTests(test::resourceDir(), reference().skeleton);
    return RomEditSolver{reference(), sampledPoseSet(reference().skeleton, preset, norms.tests, {.count = 4000})};
  }();
  return s;
}

RomTilt towards(const char* name, double deg) {
  return {.towards = name, .angle_rad = deg * kRadPerDeg};
}
const RomEdits kHipForward = {{.joint = "hip_r", .cone_factor = 0.63, .tilt = {"forward", {}, 30 * kRadPerDeg}}};

bool sameUnit(const MusculotendonUnit& a, const MusculotendonUnit& b) {
  return a.optimal_fiber_length_m == b.optimal_fiber_length_m && a.tendon_slack_length_m == b.tendon_slack_length_m;
}

/// What the fit makes small: cells wrong within the stops, and a little of those by which muscles alone are wrong.
double objective(const RomEditResult& result) {
  double sum = 0;
  for (const RomEditCells& c : result.cells)
    sum += (c.held == "zero" ? 1 : 0.5) *
           (c.differing_in_stops + RomEditOptions{}.weight_of_muscles_alone * c.differing);
  return sum;
}

TEST(ThresholdFit, FindsTheLimitsOfABoxOfSamples) {
  // Samples on a 10 x 10 grid; those with x <= 3 and y <= 6 are wanted. Two columns know x and y, a third knows the
  // same of all.
  std::vector<ThresholdColumn> columns(3);
  ThresholdProblem p;
  for (int x = 0; x < 10; ++x)
    for (int y = 0; y < 10; ++y) {
      p.wanted.push_back(x <= 3 && y <= 6);
      p.weight.push_back(1);
    }
  for (int v = 0; v < 10; ++v)
    for (std::uint32_t other = 0; other < 10; ++other) {
      columns[0].value.push_back(v), columns[0].sample.push_back(std::uint32_t(v) * 10 + other);
      columns[1].value.push_back(v), columns[1].sample.push_back(other * 10 + std::uint32_t(v));
      columns[2].value.push_back(1), columns[2].sample.push_back(std::uint32_t(v) * 10 + other);
    }
  p.columns = {&columns[0], &columns[1], &columns[2]};
  const std::vector<double> reference = {7.5, 6.25, 20}, preferred = {3.4, 100, 0};
  const ThresholdFit fit = fitThresholds(p, {reference}, reference, preferred);
  EXPECT_EQ(fit.outcome, Outcome::Converged);
  EXPECT_EQ(fit.error, 0);
  EXPECT_NEAR(fit.threshold[0], 3.4, 1e-12);         // had to change: the preferred place of those that are right
  EXPECT_EQ(fit.threshold[1], 6.25);                 // was right, stays bit for bit
  EXPECT_EQ(fit.threshold[2], 20);                   // does not matter, stays
  EXPECT_EQ(thresholdError(p, {4.5, 6.25, 20}), 7);  // x = 4 passes, seven times
  const ThresholdFit quick = descendThresholds(p, reference);
  EXPECT_EQ(quick.error, 0);
  EXPECT_NEAR(quick.threshold[0], 4, 2e-5);  // as near to where it began as x <= 3 allows
  EXPECT_LT(quick.threshold[0], 4);
  EXPECT_EQ(quick.threshold[1], 6.25);
  EXPECT_EQ(quick.threshold[2], 20);
}

TEST(RomEditSolve, AHingeHeldByAStringFollowsExactly) {
  // A string from 0.1 m below the knee of the femur to the same place of the tibia measures 0.2 sin(theta / 2): a
  // longest length of 0.1 m is a range of +-60 degrees. Half of it: 0.2 sin(15).
  Model model;
  model.skeleton = reference().skeleton;
  const int femur = model.skeleton.segmentIndex("femur_r"), tibia = model.skeleton.segmentIndex("tibia_r");
  MusculotendonUnit string;
  string.name = "string";
  string.optimal_fiber_length_m = 0.05;
  string.tendon_slack_length_m = 0.02 / 1.03;
  string.path = {{PathPointRole::Origin, {{femur, 1, {0, -0.522, 0}}}, "", ""},
                 {PathPointRole::Insertion, {{tibia, 1, {0, -0.1, 0}}}, "", ""}};
  model.musculature.units = {string};
  ASSERT_NEAR(longestLength_m(string), 0.1, 1e-12);
  PoseSet poses{model.skeleton, "two"};
  const int knee = model.skeleton.coordinateIndex("knee_flexion_r");
  for (const double deg : {-60.0, 60.0}) {
    Posture q = zeroPosture(model.skeleton);
    q[knee] = deg * kRadPerDeg;
    poses.add(q);
  }
  RomEditSolver on_string{model, std::move(poses)};
  for (const auto method : {RomEditMethod::Paper, RomEditMethod::Sinew}) {
    const RomEditResult result = on_string.solve({{.joint = "knee_r", .range_factor = 0.5}}, {.method = method});
    ASSERT_EQ(result.outcome, Outcome::Converged);
    const MusculotendonUnit& unit = result.model.musculature.units[0];
    EXPECT_NEAR(longestLength_m(unit), 0.2 * std::sin(15 * kRadPerDeg),
                1e-6);  // postures are stored in single precision
    EXPECT_NEAR(unit.tendon_slack_length_m / unit.optimal_fiber_length_m, 0.02 / 1.03 / 0.05, 1e-12);
    for (const RomEditCells& c : result.cells) EXPECT_EQ(c.differing, 0) << c.held;
    ASSERT_EQ(result.stops.size(), 1u);
    EXPECT_NEAR(result.stops[0].after_max_rad, result.stops[0].before_max_rad / 2, 1e-6);
    const auto limits = romLimits(result.model, model.skeleton.jointIndex("knee_r"), zeroPosture(model.skeleton));
    EXPECT_NEAR(limits[0].high_rad, 30 * kRadPerDeg, 0.01 * kRadPerDeg);
    EXPECT_EQ(limits[0].high_by, "string");
  }
}

TEST(RomEditSolve, NothingIsTouchedThatNeedNotBe) {
  const RomEditResult nothing = solver().solve({{.joint = "hip_r"}, {.joint = "knee_l"}});
  const RomEditResult knee = solver().solve({{.joint = "knee_r", .range_factor = 0.8, .shift_rad = 10 * kRadPerDeg}});
  const Kinematics k = clinicalKinematics(reference().skeleton, zeroPosture(reference().skeleton));
  std::set<std::string> changed;
  for (const auto& c : knee.changed) changed.insert(c.unit);
  EXPECT_FALSE(changed.empty());
  for (std::size_t i = 0; i < reference().musculature.units.size(); ++i) {
    const MusculotendonUnit& before = reference().musculature.units[i];
    EXPECT_TRUE(sameUnit(nothing.model.musculature.units[i], before)) << before.name;
    const bool spans =
        std::ranges::count(spannedCoordinates(before, k), reference().skeleton.coordinateIndex("knee_flexion_r"));
    EXPECT_TRUE(spans || sameUnit(knee.model.musculature.units[i], before)) << before.name;
    EXPECT_EQ(sameUnit(knee.model.musculature.units[i], before), !changed.contains(before.name)) << before.name;
  }
  for (std::size_t i = 0; i < reference().skeleton.coordinates.size(); ++i) {
    const Coordinate &before = reference().skeleton.coordinates[i], &after = knee.model.skeleton.coordinates[i];
    EXPECT_TRUE(before.name == "knee_flexion_r" || before.stop_max_rad == after.stop_max_rad) << before.name;
  }
  EXPECT_TRUE(nothing.changed.empty() && nothing.stops.empty() && nothing.model.length_factors.empty());
}

TEST(RomEditSolve, ThisMethodIsNeverWorseThanThePapers) {
  for (const RomEdits& edits :
       {kHipForward, RomEdits{{.joint = "shoulder_r", .cone_factor = 0.7, .twist_factor = 0.8}},
        RomEdits{{.joint = "ankle_r", .cone_factor = 0.7, .tilt = towards("down", 10)}},
        RomEdits{{.joint = "knee_r", .range_factor = 0.8, .shift_rad = 10 * kRadPerDeg}},
        RomEdits{{.joint = "hip_r", .tilt = towards("forward", 15)}, {.joint = "knee_r", .range_factor = 0.7}}}) {
    const RomEditResult paper = solver().solve(edits, {.method = RomEditMethod::Paper}),
                        sinew = solver().solve(edits);
    EXPECT_LE(objective(sinew), objective(paper)) << inWords(edits.front());
  }
}

TEST(RomEditSolve, WhatIsReportedIsWhatMapsSay) {
  const RomEditResult result = solver().solve(kHipForward);
  const RomTransform transform = solver().transform(kHipForward);
  ASSERT_EQ(result.cells.size(), 2u);
  const auto held = heldPostures(reference().skeleton, reference().skeleton.jointIndex("hip_r"));
  for (std::size_t i = 0; i < held.size(); ++i)
    for (const bool stops : {false, true}) {
      const RomMapOptions options{.joint_limits = stops};
      const RomDifference d = compare(romMap(result.model, "hip_r", held[i].posture, options),
                                      editedRomMap(reference(), transform, "hip_r", held[i].posture, options));
      EXPECT_EQ(d.differing(), stops ? result.cells[i].differing_in_stops : result.cells[i].differing);
      EXPECT_EQ(d.either, stops ? result.cells[i].either_in_stops : result.cells[i].either);
    }
}

TEST(RomEditSolve, FiberAndTendonChangeTogetherAndAreRecorded) {
  const RomEditResult result = solver().solve(kHipForward);
  ASSERT_FALSE(result.changed.empty());
  for (const RomEditChange& c : result.changed) {
    const auto &before = reference().musculature.unit(c.unit), &after = result.model.musculature.unit(c.unit);
    EXPECT_NEAR(after.optimal_fiber_length_m, before.optimal_fiber_length_m * c.length_factor, 1e-15);
    EXPECT_NEAR(after.tendon_slack_length_m, before.tendon_slack_length_m * c.length_factor, 1e-15);
    EXPECT_EQ(result.model.length_factors.at(c.unit), c.length_factor);
  }
}

TEST(RomEditSolve, MirroredEditsGiveMirroredLengths) {
  const auto edit = [](const std::string& side) {
    return RomEdits{
        {.joint = "hip" + side, .cone_factor = 0.8, .tilt = towards("outward", 10), .twist_shift_rad = 0.1}};
  };
  const RomEditResult right = solver().solve(edit("_r")), left = solver().solve(edit("_l"));
  EXPECT_EQ(right.changed.size(), left.changed.size());
  for (const RomEditChange& c : right.changed) {
    const std::string other = c.unit.substr(0, c.unit.size() - 1) + "l";
    // Middles of the two sides are sums over the same set in another order.
    EXPECT_NEAR(left.model.length_factors.at(other), c.length_factor, 1e-9) << c.unit;
  }
  ASSERT_EQ(right.stops.size(), left.stops.size());
  for (std::size_t i = 0; i < right.stops.size(); ++i)
    EXPECT_NEAR(right.stops[i].after_max_rad, left.stops[i].after_max_rad, 1e-9) << right.stops[i].coordinate;
}

TEST(RomEditSolve, IsTheSameEveryTimeAndCanBeCancelled) {
  const RomEditResult one = solver().solve(kHipForward), other = solver().solve(kHipForward);
  for (std::size_t i = 0; i < one.changed.size(); ++i)
    EXPECT_EQ(one.changed[i].length_factor, other.changed[i].length_factor);
  std::stop_source stop;
  stop.request_stop();
  const RomEditResult cancelled = solver().solve(kHipForward, {}, {.stop = stop.get_token()});
  EXPECT_EQ(cancelled.outcome, Outcome::Cancelled);
  EXPECT_TRUE(cancelled.changed.empty());
}

TEST(RomEditSolve, AnEditThatLeavesNothingIsRefused) {
  // A cone that is nearly shut, turned to where no leg goes.
  EXPECT_THROW(solver().solve(
                   {{.joint = "hip_r", .cone_factor = 0.05, .tilt = towards("backward", 179), .twist_factor = 0.05}}),
               InputError);
}

TEST(RomEditSolve, TheHipOfThePaperFollowsWithinFivePercent) {
  // Ryu et al.: 7.3 % for the hip tilted forward by 30 degrees and narrowed by 0.63. Held to <= 5 % in both measures.
  RomEditSolver full = romEditSolver(reference(), test::resourceDir(), kDefaultPreset);
  const RomEditCells cells = full.solve(kHipForward).cells.at(0);
  EXPECT_EQ(cells.held, "zero");
  EXPECT_LE(cells.ofUnionInStops(), 0.05);
  EXPECT_LE(cells.ofAllInStops(), 0.05);
  EXPECT_LE(cells.ofAll(), 0.05);
  // Of the shoulder the stops are the range: the joint keeps T, so that a cone need not be a box.
  const RomEdits shoulder = {{.joint = "shoulder_r", .cone_factor = 0.7, .twist_factor = 0.8}};
  EXPECT_LE(full.solve(shoulder).cells.at(0).ofUnionInStops(), 0.05);
}

}  // namespace
}  // namespace sinew
