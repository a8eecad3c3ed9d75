#include "clinical/pipeline/case_store.h"

#include <gmock/gmock.h>

#include "clinical/case/case_io.h"
#include "clinical/pipeline/pipeline.h"
#include "core/file.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using ::testing::HasSubstr;

/// A case whose landmarks are being computed while others write into its folder.
class CaseStoreTest : public ::testing::Test {
 protected:
  CaseStoreTest() {
    Case c;
    c.sightings = {{"asis_r", 0, {10, 20}, 1}};
    saveCase(c, folder_.path());
  }
  /// The landmarks stage as it ends from what `c` held.
  static void compute(Case& c) {
    const std::string read = inputHash(c, Stage::Landmarks, test::resourceDir());
    c.landmarks = Triangulation{};
    c.stages[Stage::Landmarks] = {Outcome::Converged, read, 0.1, {}, "done"};
  }

  test::TemporaryFolder folder_;
  CaseStore store_{folder_.path(), test::resourceDir()};
};

TEST_F(CaseStoreTest, AResultIsStored) {
  Case c = store_.load();
  compute(c);
  store_.store(c, Stage::Landmarks);
  EXPECT_TRUE(loadCase(folder_.path()) == c);
  store_.store(c, Stage::Landmarks);  // what it wrote itself is no news
}

TEST_F(CaseStoreTest, AnEntryMadeMeanwhileSurvives) {
  Case c = store_.load();
  Case other = c;
  other.exam.examiner = "edited elsewhere";
  saveCase(other, folder_.path());
  compute(c);
  store_.store(c, Stage::Landmarks);
  const Case stored = loadCase(folder_.path());
  EXPECT_EQ(stored.exam.examiner, "edited elsewhere");
  EXPECT_TRUE(stored.landmarks);
  EXPECT_TRUE(c == stored);  // and the run goes on from it
}

TEST_F(CaseStoreTest, AResultOfInputsThatWereChangedIsNotStored) {
  Case c = store_.load();
  Case other = c;
  other.sightings[0].uv_px.x() = 99;
  saveCase(other, folder_.path());
  compute(c);
  try {
    store_.store(c, Stage::Landmarks);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("changed meanwhile"));
  }
  EXPECT_TRUE(loadCase(folder_.path()) == other);
}

TEST_F(CaseStoreTest, AFolderThatIsGoneIsNotMadeAgain) {
  Case c = store_.load();
  compute(c);
  std::filesystem::rename(folder_.path(), folder_.path().string() + "-moved");
  EXPECT_THROW(store_.store(c, Stage::Landmarks), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder_.path()));
  std::filesystem::rename(folder_.path().string() + "-moved", folder_.path());
}

TEST_F(CaseStoreTest, ALinkedCaseStaysALink) {
  const test::TemporaryFolder elsewhere;
  std::filesystem::rename(folder_ / "case.json", elsewhere / "real.json");
  std::filesystem::create_symlink(elsewhere / "real.json", folder_ / "case.json");
  Case c = store_.load();
  compute(c);
  store_.store(c, Stage::Landmarks);
  EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "case.json"));
  EXPECT_THAT(readFile(elsewhere / "real.json"), HasSubstr("\"landmarks\""));
  EXPECT_TRUE(loadCase(folder_.path()).landmarks);
}

}  // namespace
}  // namespace sinew
