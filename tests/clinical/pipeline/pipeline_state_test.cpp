#include <gmock/gmock.h>

#include "clinical/pipeline/pipeline.h"
#include "core/file.h"
#include "tests/clinical/random_case.h"

namespace sinew {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

/// A case in which every stage ran from what it holds.
Case finishedCase() {
  for (unsigned seed = 1;; ++seed) {
    Case c = test::RandomCase{seed}.make();
    if (!c.rig || !c.landmarks || !c.skeleton || !c.musculature || !c.model || !c.exam_fit || !c.report ||
        c.sightings.empty() || c.images.size() != 2)
      continue;
    c.stages.clear();
    for (const Stage stage : kStages) c.stages[stage] = {Outcome::Converged, inputHash(c, stage), 1, {}, ""};
    return c;
  }
}

std::vector<std::string> states(const Case& c) {
  std::vector<std::string> names;
  for (const Stage stage : kStages) names.push_back(nameOf(stateOf(c, stage)));
  return names;
}

TEST(PipelineState, AFinishedCaseIsDone) {
  const Case c = finishedCase();
  EXPECT_THAT(states(c), ElementsAre("done", "done", "done", "done", "done", "done", "done"));
  EXPECT_THAT(reasonsAgainstReport(c), SizeIs(0));
}

TEST(PipelineState, AnEmptyCaseAsksForImages) {
  EXPECT_THAT(states({}), ElementsAre("missing", "blocked", "missing", "blocked", "blocked", "blocked", "blocked"));
  EXPECT_EQ(missingInput({}, Stage::Images), "two radiographs are needed, there are 0");
  EXPECT_THAT(reasonsAgainstReport({}), SizeIs(6));
}

TEST(PipelineState, AMovedSightingMakesEverythingAfterItStale) {
  Case c = finishedCase();
  c.sightings[0].uv_px.x() += 1;
  EXPECT_THAT(states(c), ElementsAre("done", "done", "stale", "stale", "stale", "stale", "stale"));
  EXPECT_THAT(reasonsAgainstReport(c),
              ElementsAre("Landmarks: stale", "Skeleton: stale", "Musculature: stale", "Examination: stale"));
  c.sightings[0].uv_px.x() -= 1;  // taken back: the results are those of today's inputs again
  EXPECT_EQ(stateOf(c, Stage::Report), StageState::Done);
}

TEST(PipelineState, EachInputReachesTheStagesThatReadIt) {
  Case c = finishedCase();
  c.exam.examiner += "x";
  EXPECT_THAT(states(c), ElementsAre("done", "done", "done", "done", "done", "stale", "stale"));
  c = finishedCase();
  c.patient.diagnosis += "x";
  EXPECT_THAT(states(c), ElementsAre("done", "done", "done", "done", "done", "done", "stale"));
  c = finishedCase();
  c.patient.mass_kg = c.patient.mass_kg.value_or(40) + 1;  // forces and ligaments follow it
  EXPECT_THAT(states(c), ElementsAre("done", "done", "done", "done", "stale", "stale", "stale"));
  c = finishedCase();
  c.patient.birth_date = "2014-03-09";
  c.exam.date = "2024-03-09";  // and the joints the age
  EXPECT_EQ(stateOf(c, Stage::Musculature), StageState::Stale);
  c = finishedCase();
  c.images[1].declared_spacing_mm = 0.5;
  EXPECT_EQ(states(c)[0], "stale");
  c = finishedCase();
  c.imported_rig = c.rig;
  c.imported_rig->views[0].width_px += 1;
  EXPECT_THAT(states(c), ElementsAre("done", "stale", "stale", "stale", "stale", "stale", "stale"));
  c = finishedCase();
  c.exam_fit->seconds += 1;  // how long it took is no input of the report
  EXPECT_EQ(stateOf(c, Stage::Report), StageState::Done);
}

TEST(PipelineState, ARenamedFileOfTheSameContentIsNoNews) {
  Case c = finishedCase();
  c.images[0].file.path = "images/other.dcm";
  EXPECT_EQ(stateOf(c, Stage::Images), StageState::Done);
  c.images[0].file.sha256 = sha256("other pixels");
  EXPECT_EQ(stateOf(c, Stage::Images), StageState::Stale);
}

TEST(PipelineState, FailedAndCancelledStagesAreNotDone) {
  Case c = finishedCase();
  c.stages[Stage::Skeleton].outcome = Outcome::NotConverged;
  EXPECT_THAT(states(c), ElementsAre("done", "done", "done", "failed", "stale", "stale", "stale"));
  c.stages[Stage::Skeleton].outcome = Outcome::Cancelled;
  EXPECT_EQ(stateOf(c, Stage::Skeleton), StageState::Stale);
  c.skeleton.reset();
  EXPECT_EQ(stateOf(c, Stage::Skeleton), StageState::Ready);
}

TEST(PipelineState, ForeignPointsLeaveTheSkeletonWithoutInput) {
  Case c = finishedCase();
  c.skeleton.reset();
  c.stages.erase(Stage::Skeleton);
  c.stages[Stage::Landmarks].warnings = {{std::string{kNoKnownLandmarks}, "none of the 4 points"}};
  EXPECT_EQ(stateOf(c, Stage::Skeleton), StageState::Missing);
  EXPECT_THAT(missingInput(c, Stage::Skeleton), HasSubstr("no known landmark"));
  c.sightings[0].name = "asis_r";  // something new was picked: whether it is known is to be found out again
  EXPECT_EQ(stateOf(c, Stage::Skeleton), StageState::Blocked);
}

}  // namespace
}  // namespace sinew
