#include "clinical/case/case_io.h"

#include <gmock/gmock.h>

#include <functional>
#include <random>

#include "core/file.h"
#include "tests/clinical/random_case.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string complaintOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

std::string complaintAbout(const std::string& text) {
  return complaintOf([&] { caseFromJson(text, "case.json"); });
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

/// A random case in which everything that a test below looks for is present.
Case fullCase() {
  for (unsigned seed = 1;; ++seed) {
    Case c = test::RandomCase{seed}.make();
    if (c.rig && c.landmarks && c.skeleton && c.exam_fit && c.images.size() == 2 && !c.sightings.empty() &&
        !c.exam.entries.empty() && c.patient.height_m && c.stages.size() > 2)
      return c;
  }
}

TEST(CaseIo, RandomCasesRoundTripEqual) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const Case c = test::RandomCase{seed}.make();
    const Case back = caseFromJson(caseToJson(c), "case.json");
    ASSERT_TRUE(back == c) << "seed " << seed;
    // The stored form is not all there is to equality: look at members too.
    ASSERT_EQ(back.patient, c.patient);
    ASSERT_EQ(back.images, c.images);
    ASSERT_EQ(back.sightings, c.sightings);
    ASSERT_EQ(back.exam, c.exam);
    ASSERT_EQ(back.rig, c.rig);
    ASSERT_EQ(back.stages, c.stages);
    if (c.skeleton) {
      ASSERT_EQ(back.skeleton->shape, c.skeleton->shape);
    }
  }
}

TEST(CaseIo, DifferentCasesAreUnequal) {
  const Case c = fullCase();
  Case moved = c;
  moved.sightings[0].uv_px.x() += 1e-9;
  EXPECT_FALSE(moved == c);
  Case graded = c;
  graded.exam.entries[0].note += "x";
  EXPECT_FALSE(graded == c);
}

TEST(CaseIo, EveryTruncationIsAnsweredByAnInputError) {
  const std::string text = caseToJson(fullCase());
  for (std::size_t size = 0; size + 2 < text.size(); ++size)  // the last two bytes are "}\n"
    ASSERT_THROW(caseFromJson(text.substr(0, size), "case.json"), InputError) << size;
}

TEST(CaseIo, FlippedBitsAreAnInputErrorOrAReadableCase) {
  const std::string text = caseToJson(fullCase());
  std::mt19937 random{7};
  int refused = 0;
  for (int i = 0; i < 600; ++i) {
    std::string damaged = text;
    damaged[std::uniform_int_distribution<std::size_t>{0, text.size() - 1}(random)] ^=
        static_cast<char>(1 << std::uniform_int_distribution{0, 7}(random));
    try {
      const Case c = caseFromJson(damaged, "case.json");  // a flip inside a number or a text may be legal
      ASSERT_TRUE(caseFromJson(caseToJson(c), "again") == c);
    } catch (const InputError& error) {
      ++refused;
      ASSERT_THAT(error.what(), AllOf(HasSubstr("case.json"), Not(HasSubstr("\n"))));
    }
  }
  EXPECT_GT(refused, 200);  // most of a file is structure, of which nothing may change unnoticed
}

TEST(CaseIo, ComplaintsNameTheField) {
  const std::string text = caseToJson(fullCase());
  EXPECT_THAT(complaintAbout(replaced(text, "\"version\": 1", "\"version\": 2")),
              AllOf(HasSubstr("case.json: version: expected version 1, found 2"), HasSubstr("newer program")));
  EXPECT_THAT(complaintAbout(replaced(text, "\"sinew.case\"", "\"sinew.exam\"")), HasSubstr("format: expected"));
  EXPECT_THAT(complaintAbout(replaced(text, "\"sigma_px\"", "\"sigma\"")),
              HasSubstr("sightings[0]: expected known members only, found 'sigma'; nearest: sigma_px"));
  EXPECT_THAT(complaintAbout(replaced(text, "\"u_px\": ", "\"u_px\": true, \"v\": ")), HasSubstr("sightings[0]"));
  EXPECT_THAT(complaintAbout(replaced(text, "\"sightings\"", "\"sighting\"")), HasSubstr("nearest: sightings"));
  EXPECT_THAT(complaintAbout("[]"), HasSubstr("case.json: document: expected an object"));
}

TEST(CaseIo, RefusesFiguresOfAnotherUnit) {
  Case c;
  c.patient.height_m = 164;  // centimetres
  EXPECT_THAT(complaintAbout(caseToJson(c)), HasSubstr("patient.height_m: expected a number 0.3 ... 2.7"));
}

TEST(CaseIo, APathThatLeavesTheFolderIsRefused) {
  for (const std::string path : {"../other/view1.dcm", "/etc/passwd", "images/../../x", "", "images/", "a\\..\\b"}) {
    Case c;
    c.images = {{{path, sha256("x")}, {}}};
    EXPECT_THAT(complaintAbout(caseToJson(c)), HasSubstr("images[0].path: expected a path inside the case folder"))
        << path;
    EXPECT_FALSE(staysInFolder(path));
  }
  EXPECT_TRUE(staysInFolder("images/view1.dcm"));
}

TEST(CaseIo, SavingKeepsThePreviousStateWhenTheNewOneIsUnusable) {
  const test::TemporaryFolder folder;
  Case c = fullCase();
  saveCase(c, folder.path());
  const Case before = loadCase(folder.path());
  c.sightings[0].view = -1;
  EXPECT_THROW(saveCase(c, folder.path()), InputError);
  EXPECT_TRUE(loadCase(folder.path()) == before);
  EXPECT_THAT(complaintOf([&] { loadCase(folder / "nowhere"); }), HasSubstr("no case.json"));
}

TEST(CaseIo, ImportedFilesArePinnedByContent) {
  const test::TemporaryFolder folder;
  writeFileAtomically(folder / "Doe^Jane.dcm", "pixels");
  const auto case_dir = folder / "case";
  const FileReference reference = importFile(folder / "Doe^Jane.dcm", case_dir, "images/view1.dcm");
  EXPECT_EQ(reference, (FileReference{"images/view1.dcm", sha256("pixels")}));
  EXPECT_EQ(readFile(checkedFile(reference, case_dir)), "pixels");

  writeFileAtomically(case_dir / "images/view1.dcm", "pixel5");
  EXPECT_THAT(complaintOf([&] { checkedFile(reference, case_dir); }), HasSubstr("changed or damaged"));
  std::filesystem::remove(case_dir / "images/view1.dcm");
  EXPECT_THAT(complaintOf([&] { checkedFile(reference, case_dir); }), HasSubstr("found nothing"));
  std::filesystem::create_symlink(folder / "Doe^Jane.dcm", case_dir / "images/view1.dcm");
  EXPECT_THAT(complaintOf([&] { checkedFile(reference, case_dir); }), HasSubstr("a link that leads out of it"));
  EXPECT_THROW(importFile(folder / "Doe^Jane.dcm", case_dir, "../escape.dcm"), InputError);
}

}  // namespace
}  // namespace sinew
