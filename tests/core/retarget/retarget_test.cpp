#include "core/retarget/retarget.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <chrono>
#include <numbers>

#include "core/kernel/sweep.h"
#include "core/muscle/hill.h"
#include "core/retarget/prepared/reference.h"
#include "core/skeleton/shape/body_description.h"
#include "tests/support/retarget_reference.h"

namespace sinew {
namespace {

const RetargetReference& reference() {
  return *test::retargetReference();
}

ShapeParameters oneArm() {
  ShapeParameters shape;
  shape.sides[1].humerus = {.elongation = 0.9, .torsion_rad = 0.3};
  return shape;
}

void expectSame(const Retargeted& a, const Retargeted& b) {
  ASSERT_EQ(a.outcome, Outcome::Converged);
  ASSERT_EQ(b.outcome, Outcome::Converged);
  for (std::size_t u = 0; u < a.model.musculature.units.size(); ++u) {
    const MusculotendonUnit &one = a.model.musculature.units[u], &other = b.model.musculature.units[u];
    EXPECT_EQ(one.optimal_fiber_length_m, other.optimal_fiber_length_m) << one.name;
    EXPECT_EQ(one.tendon_slack_length_m, other.tendon_slack_length_m) << one.name;
    for (std::size_t p = 0; p < one.path.size(); ++p)
      for (std::size_t k = 0; k < one.path[p].anchors.size(); ++k)
        EXPECT_EQ(one.path[p].anchors[k].p_B, other.path[p].anchors[k].p_B) << one.name;
  }
  EXPECT_EQ(a.fiber_tendon_ratio, b.fiber_tendon_ratio);
  EXPECT_EQ(a.lengths.longest_path_m, b.lengths.longest_path_m);
}

TEST(Retarget, TheReferenceStaysAsItIs) {
  const Retargeted same = retarget(reference(), {});
  ASSERT_EQ(same.outcome, Outcome::Converged);
  for (std::size_t u = 0; u < same.routing.size(); ++u) {
    const MusculotendonUnit &before = reference().model().musculature.units[u],
                            &after = same.model.musculature.units[u];
    EXPECT_LT(same.routing[u].largest_move_m, 1e-4);  // 0.1 mm: the specification's
    EXPECT_NEAR(after.optimal_fiber_length_m, before.optimal_fiber_length_m, 1e-6) << before.name;
    EXPECT_NEAR(after.tendon_slack_length_m, before.tendon_slack_length_m, 1e-6) << before.name;
  }
}

TEST(Retarget, EveryPostureOfTheSetStaysValid) {
  const Retargeted result = retarget(reference(), oneArm());
  ASSERT_EQ(result.outcome, Outcome::Converged);
  const CompiledModel model{result.model.skeleton, result.model.musculature};
  const auto read = [&](std::size_t first, PoseTable& table) { reference().poses().read(first, table); };
  const PostureSweep sweep = sweepPostures(model, reference().poses().size(), read, Precision::Single);
  EXPECT_EQ(sweep.validCount(), reference().poses().size());
}

TEST(Retarget, ABodyThatIsItsOwnMirrorImageHasMusclesThatAreToo) {
  ShapeParameters long_thighs;
  for (SideShape& side : long_thighs.sides) side.femur = {.elongation = 1.2, .torsion_rad = -0.2};
  // Here step 3 has many motions to bring back one by one.
  const ShapeParameters hulk = loadShapePreset(test::resourceDir(), "hulk").shape;
  for (const auto& [shape, peak_torque] : {std::pair{long_thighs, false}, {long_thighs, true}, {hulk, true}}) {
    const Retargeted result = retarget(reference(), shape, {.peak_torque = peak_torque});
    ASSERT_EQ(result.outcome, Outcome::Converged);
    const auto& mirror_of = reference().routing().mirrorOf();
    const auto& units = result.model.musculature.units;
    for (std::size_t u = 0; u < mirror_of.size(); ++u) {
      if (mirror_of[u] < 0) continue;
      EXPECT_NEAR(units[u].optimal_fiber_length_m, units[std::size_t(mirror_of[u])].optimal_fiber_length_m, 1e-9)
          << units[u].name;
    }
  }
}

TEST(Retarget, RatiosStayWithinThirtyPercentAndKeepTheLongestLength) {
  RetargetOptions without;
  without.peak_torque = false;
  const Retargeted before = retarget(reference(), oneArm(), without), after = retarget(reference(), oneArm());
  int changed = 0;
  for (std::size_t u = 0; u < after.fiber_tendon_ratio.size(); ++u) {
    EXPECT_GE(after.fiber_tendon_ratio[u], 0.7 - 1e-9);
    EXPECT_LE(after.fiber_tendon_ratio[u], 1.3 + 1e-9);
    changed += std::abs(after.fiber_tendon_ratio[u] - 1) > 0.01;
    const double longest_m = longestLength_m(before.model.musculature.units[u]);
    EXPECT_NEAR(longestLength_m(after.model.musculature.units[u]), longest_m, 1e-12 + 1e-9 * longest_m);
  }
  EXPECT_GT(changed, 0);
}

TEST(Retarget, AnUpdateIsWhatTheWholeComputationGives) {
  const ShapeParameters before = oneArm();
  ShapeParameters after = before;
  after.sides[0].femur.elongation = 1.1;
  const Retargeted previous = retarget(reference(), before);
  expectSame(retarget(reference(), after, {}, {}, previous), retarget(reference(), after));
}

TEST(Retarget, AnUpdateFromAnotherMethodStartsAnew) {
  RetargetOptions naive;
  naive.method = RetargetMethod::Naive;
  const Retargeted previous = retarget(reference(), oneArm(), naive);
  expectSame(retarget(reference(), oneArm(), {}, {}, previous), retarget(reference(), oneArm()));
}

TEST(Retarget, TheNumberOfProcessorsDoesNotMatter) {
  const Retargeted many = retarget(reference(), oneArm());
  cpu_set_t all, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof all, &all), 0);
  CPU_ZERO(&one);
  for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++cpu)
    if (CPU_ISSET(cpu, &all)) CPU_SET(cpu, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  const Retargeted single = retarget(reference(), oneArm());
  sched_setaffinity(0, sizeof all, &all);
  expectSame(many, single);
}

TEST(Retarget, AStopRequestIsAnsweredSoon) {
  using Clock = std::chrono::steady_clock;
  reference();
  for (const double at : {0.0, 0.3, 0.65, 0.8}) {
    std::stop_source stop;
    Clock::time_point asked = Clock::now();
    if (at == 0) stop.request_stop();
    const Job job{[&](double fraction, std::string_view) {
                    if (fraction < at || stop.stop_requested()) return;
                    asked = Clock::now();
                    stop.request_stop();
                  },
                  stop.get_token()};
    const Retargeted result = retarget(reference(), oneArm(), {}, job);
    EXPECT_EQ(result.outcome, Outcome::Cancelled) << at;
    EXPECT_TRUE(result.model.musculature.units.empty()) << at;
    constexpr double kSoon_s = 1;  // 0.2 s are promised; a loaded machine needs longer
    EXPECT_LT(std::chrono::duration<double>(Clock::now() - asked).count(), kSoon_s) << at;
  }
}

}  // namespace
}  // namespace sinew
