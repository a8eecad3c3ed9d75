#include <gmock/gmock.h>

#include "clinical/pipeline/pipeline.h"
#include "clinical/pipeline/resource_hash.h"
#include "core/file.h"
#include "tests/clinical/random_case.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

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
    for (const Stage stage : kStages)
      c.stages[stage] = {Outcome::Converged, inputHash(c, stage, test::resourceDir()), 1, {}, ""};
    return c;
  }
}

std::vector<std::string> states(const Case& c) {
  std::vector<std::string> names;
  for (const auto& status : statusOf(c, test::resourceDir())) names.push_back(nameOf(status.state));
  return names;
}

TEST(PipelineState, AFinishedCaseIsDone) {
  const Case c = finishedCase();
  EXPECT_THAT(states(c), ElementsAre("done", "done", "done", "done", "done", "done", "done"));
  EXPECT_THAT(reasonsAgainstReport(c, test::resourceDir()), SizeIs(0));
}

TEST(PipelineState, AnEmptyCaseAsksForImages) {
  EXPECT_THAT(states({}), ElementsAre("missing", "blocked", "missing", "blocked", "blocked", "blocked", "blocked"));
  EXPECT_EQ(missingInput({}, Stage::Images, test::resourceDir()), "two radiographs are needed, there are 0");
  EXPECT_THAT(reasonsAgainstReport({}, test::resourceDir()), SizeIs(6));
}

TEST(PipelineState, AMovedSightingMakesEverythingAfterItStale) {
  Case c = finishedCase();
  c.sightings[0].uv_px.x() += 1;
  EXPECT_THAT(states(c), ElementsAre("done", "done", "stale", "stale", "stale", "stale", "stale"));
  EXPECT_THAT(reasonsAgainstReport(c, test::resourceDir()),
              ElementsAre("Landmarks: stale", "Skeleton: stale", "Musculature: stale", "Examination: stale"));
  c.sightings[0].uv_px.x() -= 1;  // taken back: the results are those of today's inputs again
  EXPECT_EQ(stateOf(c, Stage::Report, test::resourceDir()), StageState::Done);
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
  EXPECT_EQ(stateOf(c, Stage::Musculature, test::resourceDir()), StageState::Stale);
  c = finishedCase();
  c.images[1].declared_spacing_mm = 0.5;
  EXPECT_EQ(states(c)[0], "stale");
  c = finishedCase();
  c.imported_rig = c.rig;
  c.imported_rig->views[0].width_px += 1;
  EXPECT_THAT(states(c), ElementsAre("done", "stale", "stale", "stale", "stale", "stale", "stale"));
  c = finishedCase();
  c.exam_fit->seconds += 1;  // how long it took is no input of the report
  EXPECT_EQ(stateOf(c, Stage::Report, test::resourceDir()), StageState::Done);
}

TEST(PipelineState, ARenamedFileOfTheSameContentIsNoNews) {
  Case c = finishedCase();
  c.images[0].file.path = "images/other.dcm";
  EXPECT_EQ(stateOf(c, Stage::Images, test::resourceDir()), StageState::Done);
  c.images[0].file.sha256 = sha256("other pixels");
  EXPECT_EQ(stateOf(c, Stage::Images, test::resourceDir()), StageState::Stale);
}

TEST(PipelineState, FailedAndCancelledStagesAreNotDone) {
  Case c = finishedCase();
  c.stages[Stage::Skeleton].outcome = Outcome::NotConverged;
  EXPECT_THAT(states(c), ElementsAre("done", "done", "done", "failed", "stale", "stale", "stale"));
  c.stages[Stage::Skeleton].outcome = Outcome::Cancelled;
  EXPECT_EQ(stateOf(c, Stage::Skeleton, test::resourceDir()), StageState::Stale);
  c.skeleton.reset();
  EXPECT_EQ(stateOf(c, Stage::Skeleton, test::resourceDir()), StageState::Ready);
}

TEST(PipelineState, ForeignPointsLeaveTheSkeletonWithoutInput) {
  Case c = finishedCase();
  c.skeleton.reset();
  c.stages.erase(Stage::Skeleton);
  c.stages[Stage::Landmarks].warnings = {{std::string{kNoKnownLandmarks}, "none of the 4 points"}};
  EXPECT_EQ(stateOf(c, Stage::Skeleton, test::resourceDir()), StageState::Missing);
  EXPECT_THAT(missingInput(c, Stage::Skeleton, test::resourceDir()), HasSubstr("no known landmark"));
  c.sightings[0].name = "asis_r";  // something new was picked: whether it is known is to be found out again
  EXPECT_EQ(stateOf(c, Stage::Skeleton, test::resourceDir()), StageState::Blocked);
}

/// Puts a blank behind a file: another content, the same meaning.
void touchContent(const std::filesystem::path& file) {
  writeFileAtomically(file, readFile(file) + "\n");
}

TEST(PipelineState, AChangedResourceMakesThoseStagesStaleThatReadIt) {
  const test::TemporaryFolder copy;
  std::filesystem::copy(test::resourceDir(), copy.path(), std::filesystem::copy_options::recursive);
  Case c = finishedCase();
  for (const Stage stage : kStages) c.stages[stage].input_hash = inputHash(c, stage, copy.path());
  EXPECT_EQ(stateOf(c, Stage::Report, copy.path()), StageState::Done);
  for (const auto& [path, hash, readers] : resourcesRead(copy.path())) {
    const std::string before = readFile(copy / path);
    touchContent(copy / path);
    std::vector<Stage> changed;
    for (const Stage stage : kStages)
      if (inputHash(c, stage, copy.path()) != c.stages[stage].input_hash) changed.push_back(stage);
    EXPECT_EQ(changed, readers) << path;
    for (const auto& status : statusOf(c, copy.path()))  // those behind them wait for them
      EXPECT_EQ(status.state, status.stage < readers.front() ? StageState::Done : StageState::Stale)
          << path << " " << nameOf(status.stage);
    writeFileAtomically(copy / path, before);
    EXPECT_EQ(stateOf(c, Stage::Report, copy.path()), StageState::Done) << path << " as it was";
  }
}

TEST(PipelineState, WhatNoStageReadsIsNoNews) {
  const test::TemporaryFolder copy;
  std::filesystem::copy(test::resourceDir(), copy.path(), std::filesystem::copy_options::recursive);
  const Case c = finishedCase();
  const std::string before = inputHash(c, Stage::Report, copy.path());
  touchContent(copy / "theme/window.css");
  touchContent(copy / "muscles/audit_explanations.csv");
  EXPECT_EQ(inputHash(c, Stage::Report, copy.path()), before);
}

TEST(PipelineState, AThresholdHalvedInTheTestsReachesEveryStageThatReadsThem) {
  const test::TemporaryFolder copy;
  std::filesystem::copy(test::resourceDir(), copy.path(), std::filesystem::copy_options::recursive);
  Case c = finishedCase();
  for (const Stage stage : kStages) c.stages[stage].input_hash = inputHash(c, stage, copy.path());
  const auto file = copy / "clinical/clinical_tests.json";
  std::string text = readFile(file);
  const auto at = text.find("\"threshold_Nm\": ");
  ASSERT_NE(at, std::string::npos);
  text.insert(at + std::string_view{"\"threshold_Nm\": "}.size(), "0");  // 15 -> 015: any byte counts
  writeFileAtomically(file, text);
  std::vector<std::string> names;
  for (const auto& status : statusOf(c, copy.path())) names.push_back(nameOf(status.state));
  EXPECT_THAT(names,
              ElementsAre("done", "done", "done", "done", "stale", "stale", "stale"));  // postures of tests, too
}

TEST(ResourceHash, OfAFolderFollowsNamesAndContents) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "a/b");
  writeFileAtomically(folder / "a/one.csv", "1");
  writeFileAtomically(folder / "a/b/two.csv", "2");
  const std::string before = resourceHash(folder.path(), "a");
  EXPECT_EQ(resourceHash(folder.path(), "a"), before);
  std::filesystem::rename(folder / "a/one.csv", folder / "a/uno.csv");
  EXPECT_NE(resourceHash(folder.path(), "a"), before);
  std::filesystem::rename(folder / "a/uno.csv", folder / "a/one.csv");
  EXPECT_EQ(resourceHash(folder.path(), "a"), before);
  writeFileAtomically(folder / "a/b/two.csv", "22");
  EXPECT_NE(resourceHash(folder.path(), "a"), before);
  EXPECT_EQ(resourceHash(folder.path(), "not there"), sha256(""));
}

}  // namespace
}  // namespace sinew
