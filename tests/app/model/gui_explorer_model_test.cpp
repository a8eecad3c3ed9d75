// What the explorer computes beside the window, without a window.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <numbers>
#include <thread>

#include "app/model/explorer/explorer.h"
#include "app/model/explorer/muscle_text.h"
#include "app/model/explorer/rom_study.h"
#include "core/angle.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/app/gui_support.h"
#include "tests/support/plain_model.h"

namespace sinew {
namespace {

using test::waitUntil;

RomMap fullMap(const std::string& joint, bool valid) {
  RomMap map{joint, {-Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitX()}, {}};
  map.valid.assign(RomMap::kCells, valid);
  return map;
}

class ExplorerModel : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { test::coreApplication(); }
  std::shared_ptr<const Model> plain = std::make_shared<const Model>(test::plainModel());
};

TEST_F(ExplorerModel, LatestJobSkipsWhatHasGrownOld) {
  LatestJob job;
  std::vector<int> finished;
  std::atomic<bool> go = false;
  for (int i = 0; i < 5; ++i)
    job.post("count", [&, i](const Job&) -> JobRunner::Finish {
      while (!go) std::this_thread::yield();
      return [&finished, i] { finished.push_back(i); };
    });
  go = true;
  ASSERT_TRUE(waitUntil([&] { return !job.isBusy(); }));
  EXPECT_THAT(finished, ::testing::ElementsAre(0, 4));
}

TEST_F(ExplorerModel, LinkedSidesMoveTogetherAndMirrorExchangesThem) {
  Explorer explorer{test::resourceDir()};
  explorer.setModel(plain, "plain");
  const auto& s = plain->skeleton;
  const int right = s.coordinateIndex("hip_flexion_r"), left = s.coordinateIndex("hip_flexion_l");
  explorer.setCoordinate(right, 0.5);
  EXPECT_EQ(explorer.clinical()[left], 0);
  explorer.mirror();
  EXPECT_NEAR(explorer.clinical()[left], 0.5, 1e-12);
  explorer.setSidesLinked(true);
  explorer.setCoordinate(left, 0.2);
  EXPECT_EQ(explorer.clinical()[right], 0.2);
  ASSERT_TRUE(waitUntil([&] { return explorer.rangesAreCurrent(); }));
  EXPECT_TRUE(explorer.range(right).has_value());
  EXPECT_FALSE(explorer.range(0).has_value());  // the root has none
}

TEST_F(ExplorerModel, ActivationIsKeptByUnitAndColoursFollow) {
  Explorer explorer{test::resourceDir()};
  explorer.setModel(plain, "plain");
  EXPECT_FALSE(explorer.colourScale().has_value());
  explorer.setColouring(MuscleColouring::Activation);
  const std::vector<int> one{1};
  explorer.setActivation(one, 0.75);
  ASSERT_TRUE(explorer.colourScale().has_value());
  EXPECT_THAT(explorer.colourScale()->by_unit, ::testing::ElementsAre(0, 75));
  explorer.relaxAll();
  EXPECT_THAT(explorer.colourScale()->by_unit, ::testing::ElementsAre(0, 0));
  explorer.setMuscle("no_such_muscle");
  EXPECT_TRUE(explorer.muscle().empty());
}

TEST_F(ExplorerModel, SearchFindsByNameAndGroupElseTheNearest) {
  const auto& m = plain->musculature;
  EXPECT_EQ(findMuscles(m, "front thigh right").units.size(), 1u);
  EXPECT_EQ(findMuscles(m, "QUADRICEPS").units.size(), 2u);
  EXPECT_EQ(findMuscles(m, "").units.size(), 2u);
  const auto nearest = findMuscles(m, "frnt_of_thigh_l");
  EXPECT_TRUE(nearest.nearest);
  EXPECT_EQ(nearest.units.front(), m.unitIndex("front_of_thigh_l"));
}

TEST_F(ExplorerModel, ValidityNamesWhatFailsFirst) {
  PostureEvaluation e;
  e.valid = true;
  e.margins = {{0, 0.012}};
  EXPECT_THAT(validityText(*plain, e).toStdString(), ::testing::HasSubstr("12.0 mm"));
  e.valid = false;
  e.margins = {{1, -0.004}, {0, -0.001}};
  e.coordinates_beyond_envelope = {"knee_flexion_l"};
  const std::string text = validityText(*plain, e).toStdString();
  EXPECT_THAT(text, ::testing::HasSubstr("Front of thigh, left: 4.0 mm beyond"));
  EXPECT_THAT(text, ::testing::HasSubstr("1 more"));
  EXPECT_THAT(text, ::testing::HasSubstr("Knee flexion left"));
}

TEST_F(ExplorerModel, RomStudyAsksForBothAnglesAndKeepsTheLastAnswer) {
  std::vector<double> knees_deg;
  RomStudy study{[&](const Model& model, const std::string& joint, const Posture& held) {
    const double knee_deg =
        clinicalFromPosture(model.skeleton, held)[model.skeleton.coordinateIndex("knee_flexion_r")] / kRadPerDeg;
    knees_deg.push_back(knee_deg);
    return fullMap(joint, knee_deg > 45);
  }};
  const RomQuestion question = firstQuestion(plain->skeleton, "hip_r");
  EXPECT_EQ(question.with, "knee_flexion_r");
  study.ask(plain, question, zeroPosture(plain->skeleton), false);
  ASSERT_TRUE(waitUntil([&] { return study.answer().has_value(); }));
  ASSERT_EQ(knees_deg.size(), 2u);
  EXPECT_NEAR(knees_deg[0], 0, 1e-9);
  EXPECT_NEAR(knees_deg[1], 90, 1e-9);
  EXPECT_EQ(study.answer()->difference.only_second, RomMap::kCells);
  EXPECT_NEAR(study.answer()->widest_rad(), 2 * std::numbers::pi, 1e-9);
}

TEST_F(ExplorerModel, ACancelledRomStudyKeepsTheAnswerBefore) {
  std::atomic<bool> wait = false;
  RomStudy study{[&](const Model&, const std::string& joint, const Posture&) {
    while (wait) std::this_thread::yield();
    return fullMap(joint, true);
  }};
  const RomQuestion hip = firstQuestion(plain->skeleton, "hip_r"), ankle = firstQuestion(plain->skeleton, "ankle_r");
  EXPECT_EQ(ankle.with, "knee_flexion_r");  // the joint that it hangs on
  study.ask(plain, hip, zeroPosture(plain->skeleton), false);
  ASSERT_TRUE(waitUntil([&] { return study.answer().has_value(); }));
  wait = true;
  study.ask(plain, ankle, zeroPosture(plain->skeleton), true);
  study.cancel();
  wait = false;
  ASSERT_TRUE(waitUntil([&] { return !study.isBusy(); }));
  EXPECT_EQ(study.answer()->question.joint, "hip_r");
}

}  // namespace
}  // namespace sinew
