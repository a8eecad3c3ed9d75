#include <gtest/gtest.h>

#include <algorithm>

#include "app/experiments/experiment_shapes.h"
#include "core/muscle/hill.h"
#include "core/retarget/lengths/range_fit.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/retarget.h"
#include "core/rom/maps/rom_map.h"
#include "tests/support/retarget_reference.h"

namespace sinew {
namespace {

const RetargetReference& reference() {
  return *test::retargetReference();
}

LongestLengths referenceLengths() {
  LongestLengths lengths;
  for (const MusculotendonUnit& unit : reference().model().musculature.units)
    lengths.start_m.push_back(longestLength_m(unit));
  lengths.least_m = reference().longest_m();
  return lengths;
}

std::size_t unitNamed(const std::string& name) {
  const auto& units = reference().model().musculature.units;
  return std::size_t(std::ranges::find(units, name, &MusculotendonUnit::name) - units.begin());
}

TEST(RangeSamples, LieOnBothSidesOfWhatMusclesAllow) {
  for (const JointRangeSamples& joint : reference().ranges().joints()) {
    const std::string& name = reference().model().skeleton.joints[std::size_t(joint.joint)].name;
    if (name.starts_with("hip") || name.starts_with("knee")) {
      EXPECT_GT(joint.samples.size(), 1000u) << name;
      EXPECT_GT(std::ranges::count(joint.samples, true, &JointRangeSamples::Sample::valid), 100) << name;
      EXPECT_GT(std::ranges::count(joint.samples, false, &JointRangeSamples::Sample::valid), 100) << name;
    }
    // The average adult's shoulder ends at its stops in every orientation, long before its muscles.
    if (name.starts_with("shoulder")) {
      EXPECT_EQ(std::ranges::count(joint.samples, false, &JointRangeSamples::Sample::valid), 0) << name;
    }
  }
}

TEST(RangeFit, TheReferenceKeepsItsLengths) {
  const LongestLengths lengths = referenceLengths();
  const RangeFit fit = fitToRanges(reference().ranges(), reference().model(), lengths, {});
  ASSERT_EQ(fit.outcome, Outcome::Converged);
  EXPECT_EQ(fit.longest_m, lengths.start_m);
}

// One unit begins 3 % too long: the lengths that made the samples are the answer, to the gap between samples.
TEST(RangeFit, FindsALengthThatWasLost) {
  for (const std::string name : {"semimembranosus_r", "rectus_femoris_r", "adductor_longus_l"}) {
    LongestLengths lengths = referenceLengths();
    const std::size_t unit = unitNamed(name);
    const double truth_m = lengths.start_m[unit];
    lengths.start_m[unit] *= 1.03;
    const RangeFit fit = fitToRanges(reference().ranges(), reference().model(), lengths, {});
    ASSERT_EQ(fit.outcome, Outcome::Converged);
    constexpr double kGap = 0.003;  // of the length: a tenth of what was lost
    EXPECT_NEAR(fit.longest_m[unit], truth_m, kGap * truth_m) << name;
    for (std::size_t u = 0; u < fit.longest_m.size(); ++u)
      if (u != unit) {
        EXPECT_NEAR(fit.longest_m[u], lengths.start_m[u], kGap * lengths.start_m[u]);
      }
  }
}

TEST(RangeFit, NothingIsShorterThanItMay) {
  LongestLengths lengths = referenceLengths();
  const std::size_t unit = unitNamed("semimembranosus_r");
  lengths.start_m[unit] *= 1.03;
  lengths.least_m[unit] = 1.002 * referenceLengths().start_m[unit];  // the truth is no longer allowed
  const RangeFit fit = fitToRanges(reference().ranges(), reference().model(), lengths, {});
  ASSERT_EQ(fit.outcome, Outcome::Converged);
  EXPECT_GE(fit.longest_m[unit], lengths.least_m[unit]);
  EXPECT_LT(fit.longest_m[unit], lengths.start_m[unit]);
}

TEST(RangeFit, AStopRequestEndsIt) {
  std::stop_source stop;
  stop.request_stop();
  const RangeFit fit =
      fitToRanges(reference().ranges(), reference().model(), referenceLengths(), {}, Job{{}, stop.get_token()});
  EXPECT_EQ(fit.outcome, Outcome::Cancelled);
}

// The specification's 1 % of the cells that are valid in either map, where bodies move: within the stops.
TEST(RangeFit, KeepsTheRangeOfTheHipInOtherFemora) {
  const Posture zero = zeroPosture(reference().model().skeleton);
  const RomMap wanted = romMap(reference().model(), "hip_r", zero);
  for (const auto& [elongation, torsion_rad] : {std::pair{0.75, 0.2}, std::pair{1.25, -0.4}}) {
    const Retargeted body = retarget(reference(), withFemora(elongation, torsion_rad), {.peak_torque = false});
    ASSERT_EQ(body.outcome, Outcome::Converged);
    EXPECT_LT(compare(wanted, romMap(body.model, "hip_r", zero)).ofUnion(), 0.01) << elongation;
  }
}

}  // namespace
}  // namespace sinew
