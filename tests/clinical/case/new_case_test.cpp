#include "clinical/case/new_case.h"

#include <gmock/gmock.h>

#include "clinical/case/case_io.h"
#include "core/file.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr Date kToday{2026, 6, 1};

Radiograph film(const std::string& view_position, std::uint16_t grey) {
  Radiograph image;
  image.width_px = 40;
  image.height_px = 60;
  image.bits_stored = 12;
  image.pixels = std::make_shared<const std::vector<std::uint16_t>>(40 * 60, grey);
  image.window_center = 2000, image.window_width = 4000;
  image.tags.modality = "DX";
  image.tags.view_position = view_position;
  image.tags.patient_name = "Hong^Gildong";
  image.tags.patient_id = "P-0042";
  image.tags.patient_sex = "M";
  image.tags.patient_birth_date = "20120229";
  image.tags.study_date = "20240315";
  return image;
}

/// Two films, named as hospitals name them.
class NewCaseTest : public ::testing::Test {
 protected:
  void write(const std::function<void(RadiographTags&)>& change = [](RadiographTags&) {}) {
    Radiograph frontal = film("AP", 1000), lateral = film("LL", 1100);
    change(frontal.tags);
    change(lateral.tags);
    writeDicom(frontal, wanted_.images[0]);
    writeDicom(lateral, wanted_.images[1]);
  }
  std::string complaint() {
    try {
      makeCase(wanted_, folder_ / "case", kToday);
    } catch (const InputError& error) {
      EXPECT_FALSE(std::filesystem::exists(folder_ / "case")) << "nothing was written";
      return error.what();
    }
    return "";
  }

  test::TemporaryFolder folder_;
  NewCase wanted_{.images = {folder_ / "scan.HONG", folder_ / "Gildong.2012"}, .declared_spacing_mm = 0.2};
};

TEST_F(NewCaseTest, NoFileNameSaysWhoItIs) {
  write();
  const auto made = makeCase(wanted_, folder_ / "case", kToday);
  EXPECT_THAT(made.doubts, IsEmpty());
  EXPECT_EQ(made.c.images[0].file.path, "images/view1.dcm");
  EXPECT_EQ(made.c.images[1].file.path, "images/view2.dcm");
  EXPECT_TRUE(loadCase(folder_ / "case") == made.c);
  const auto replaced = importRadiograph(folder_ / "Gildong.2012", folder_ / "case", 0, {});
  EXPECT_THAT(replaced.file.path, ::testing::MatchesRegex("images/view1-[0-9a-f]{12}\\.dcm"));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / "case"))
    for (const char* part : {"HONG", "Hong", "ildong", "2012", "P-0042"})
      EXPECT_THAT(entry.path().filename().string(), Not(HasSubstr(part)));
}

TEST_F(NewCaseTest, ExtensionsFollowTheContent) {
  const auto named = [&](const std::string& head) {
    writeFileAtomically(folder_ / "x.JAN", head);
    return imageExtension(folder_ / "x.JAN");
  };
  EXPECT_EQ(named("\x89PNG\r\n\x1a\n rest"), ".png");
  EXPECT_EQ(named(std::string{"II*\0 rest", 9}), ".tif");
  EXPECT_EQ(named(std::string{"MM\0* rest", 9}), ".tif");
  EXPECT_EQ(named(std::string{"II*\0", 4} + std::string(124, '\0') + "DICM"), ".dcm");
  EXPECT_EQ(named("?"), ".dcm");
}

TEST_F(NewCaseTest, WhatAPersonStatesGoesBeforeWhatTheImageSays) {
  write();
  wanted_.patient = {.sex = "F", .birth_date = "2012-03-01", .mass_kg = 54};
  const auto made = makeCase(wanted_, folder_ / "case", kToday);
  EXPECT_EQ(made.c.patient.sex, "F");
  EXPECT_EQ(made.c.patient.birth_date, "2012-03-01");
  EXPECT_EQ(made.c.patient.name, "Hong^Gildong");
  EXPECT_THAT(made.doubts, Contains(Field(&Warning::code, "other_birth_date")));
  EXPECT_THAT(made.doubts, Contains(Field(&Warning::code, "other_sex")));
  for (const auto& doubt : made.doubts) EXPECT_THAT(doubt.message, Not(HasSubstr("2012")));
}

TEST_F(NewCaseTest, ABirthDateThatIsNoDayIsLeftOutAloud) {
  for (const char* wrong : {"00000000", "20120230", "99999999", "20250101"}) {  // the last: after the image
    write([&](RadiographTags& tags) { tags.patient_birth_date = wrong; });
    const test::TemporaryFolder folder;
    const auto made = makeCase(wanted_, folder / "case", kToday);
    EXPECT_EQ(made.c.patient.birth_date, "") << wrong;
    EXPECT_THAT(made.doubts, Contains(Field(&Warning::code, "birth_date_left_out"))) << wrong;
  }
  write([&](RadiographTags& tags) { tags.patient_birth_date = "2012.02.29"; });  // as ACR-NEMA wrote it
  EXPECT_EQ(makeCase(wanted_, folder_ / "case", kToday).c.patient.birth_date, "2012-02-29");
}

TEST_F(NewCaseTest, TheFrontalImageComesFirst) {
  write();
  std::swap(wanted_.images[0], wanted_.images[1]);
  const auto made = makeCase(wanted_, folder_ / "case", kToday);
  EXPECT_EQ(made.c.images[0].file.sha256, sha256OfFile(folder_ / "scan.HONG"));
  EXPECT_THAT(made.doubts, Contains(Field(&Warning::code, "views_in_other_order")));
}

TEST_F(NewCaseTest, WhatCannotBeIsRefusedBeforeAnythingIsWritten) {
  write();
  wanted_.patient.birth_date = "2012-02-30";
  EXPECT_THAT(complaint(), HasSubstr("birth date"));
  wanted_.patient.birth_date.clear();
  wanted_.patient.height_m = 164;
  EXPECT_THAT(complaint(), HasSubstr("height"));
  wanted_.patient.height_m.reset();
  wanted_.exam.date = "2010-01-01";  // before the birth that the image states
  EXPECT_THAT(complaint(), HasSubstr("before the examination"));
  wanted_.exam.date.clear();
  wanted_.images[1] = wanted_.images[0];
  EXPECT_THAT(complaint(), HasSubstr("the same image twice"));
  wanted_.images[1] = folder_ / "not there";
  EXPECT_THAT(complaint(), HasSubstr("not there"));
}

TEST_F(NewCaseTest, AnExistingCaseIsNotOverwritten) {
  write();
  makeCase(wanted_, folder_ / "case", kToday);
  const std::string before = readFile(folder_ / "case/case.json");
  EXPECT_THROW(makeCase(wanted_, folder_ / "case", kToday), InputError);
  EXPECT_EQ(readFile(folder_ / "case/case.json"), before);
}

}  // namespace
}  // namespace sinew
