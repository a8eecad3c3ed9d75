#include <gtest/gtest.h>

#include "app/model/case_document.h"
#include "app/model/stage_runner.h"
#include "clinical/case/case_io.h"
#include "tests/app/gui_support.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

class CaseDocumentTest : public ::testing::Test {
 protected:
  CaseDocumentTest() {
    test::coreApplication();
    QObject::connect(&document_, &CaseDocument::changed, [this] { ++changes_; });
    QObject::connect(&document_, &CaseDocument::rejected, [this](const QString& message) { rejected_ = message; });
    saveCase(Case{}, folder_.path());
    document_.open(folder_.path());
    changes_ = 0;
  }
  static void nameExaminer(Case& c) { c.exam.examiner = "A. B."; }

  test::TemporaryFolder folder_;
  CaseDocument document_{test::resourceDir()};
  QString rejected_;
  int changes_ = 0;
};

TEST_F(CaseDocumentTest, AnEditIsOneStepThatCanBeUndone) {
  EXPECT_TRUE(document_.edit("Set examiner", nameExaminer));
  EXPECT_EQ(changes_, 1);
  EXPECT_TRUE(document_.isModified());
  EXPECT_EQ(document_.undoLabel(), "Set examiner");
  document_.undo();
  EXPECT_EQ(document_.current().exam.examiner, "");
  EXPECT_FALSE(document_.isModified());  // back at what is stored
  document_.redo();
  EXPECT_EQ(document_.current().exam.examiner, "A. B.");
}

TEST_F(CaseDocumentTest, ARefusedEditChangesNothingAndSaysWhy) {
  EXPECT_FALSE(document_.edit("Break it", [](Case& c) {
    c.exam.examiner = "half done";
    throw InputError{{"form", "angle", "0 to 120", "400"}};
  }));
  EXPECT_EQ(rejected_, "form: angle: expected 0 to 120, found 400");
  EXPECT_EQ(document_.current().exam.examiner, "");
  EXPECT_FALSE(document_.canUndo());
  EXPECT_EQ(changes_, 0);
}

TEST_F(CaseDocumentTest, AnEditThatAltersNothingIsNoStep) {
  EXPECT_FALSE(document_.edit("Nothing", [](Case&) {}));
  EXPECT_FALSE(document_.canUndo());
}

TEST_F(CaseDocumentTest, ADragShowsButMakesOneStepOnRelease) {
  for (int i = 0; i < 5; ++i) document_.preview([&](Case& c) { c.sightings = {{"asis_r", 0, {double(i), 0}, 1}}; });
  EXPECT_EQ(document_.current().sightings.size(), 1u);
  EXPECT_FALSE(document_.canUndo());
  EXPECT_TRUE(document_.edit("Place", [](Case& c) { c.sightings = {{"asis_r", 0, {9, 0}, 1}}; }));
  document_.undo();
  EXPECT_TRUE(document_.current().sightings.empty());
}

TEST_F(CaseDocumentTest, ADroppedPreviewLeavesNothing) {
  document_.preview(nameExaminer);
  document_.dropPreview();
  EXPECT_EQ(document_.current().exam.examiner, "");
}

TEST_F(CaseDocumentTest, SavingStoresWhatIsShown) {
  document_.edit("Set examiner", nameExaminer);
  document_.save();
  EXPECT_FALSE(document_.isModified());
  EXPECT_EQ(loadCase(folder_.path()).exam.examiner, "A. B.");
}

TEST_F(CaseDocumentTest, WhatAnotherProgramStoredIsNotOverwrittenUnasked) {
  document_.edit("Set examiner", nameExaminer);
  Case other;
  other.exam.examiner = "a command";
  saveCase(other, folder_.path());
  EXPECT_TRUE(document_.wasChangedElsewhere());
  EXPECT_THROW(document_.save(), InputError);
  EXPECT_EQ(loadCase(folder_.path()).exam.examiner, "a command");
  EXPECT_TRUE(document_.isModified());
  document_.save(true);
  EXPECT_EQ(loadCase(folder_.path()).exam.examiner, "A. B.");
  EXPECT_FALSE(document_.wasChangedElsewhere());
}

TEST_F(CaseDocumentTest, AFolderWithoutACaseLeavesTheOpenOne) {
  document_.edit("Set examiner", nameExaminer);
  const test::TemporaryFolder empty;
  EXPECT_THROW(document_.open(empty.path()), InputError);
  EXPECT_EQ(document_.folder(), folder_.path());
  EXPECT_EQ(document_.current().exam.examiner, "A. B.");
}

TEST_F(CaseDocumentTest, AResultIsTakenOnlyIfItsInputsAreStillToday) {
  Case computed = document_.current();
  computed.sightings = {{"asis_r", 0, {1, 2}, 1}};
  Case same = computed, other = computed;
  other.sightings[0].uv_px.x() = 99;
  computed.landmarks = Triangulation{};
  computed.stages[Stage::Landmarks] = {
      Outcome::Converged, inputHash(computed, Stage::Landmarks, test::resourceDir()), 0.1, {}, "done"};
  const Stage stages[] = {Stage::Landmarks};
  EXPECT_EQ(mergeResults(same, computed, stages, test::resourceDir()), std::vector{Stage::Landmarks});
  EXPECT_TRUE(same.landmarks.has_value());
  EXPECT_TRUE(mergeResults(other, computed, stages, test::resourceDir()).empty());
  EXPECT_FALSE(other.landmarks.has_value());
}

}  // namespace
}  // namespace sinew
