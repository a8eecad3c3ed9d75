#include "clinical/report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "clinical/pipeline/pipeline.h"
#include "clinical/report/report_tables.h"
#include "core/file.h"
#include "core/version.h"
#include "tests/support/finished_case.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::Pair;

TEST(ReportText, NumbersReadAsWritten) {
  EXPECT_EQ(numberText(12.345, 1), "12.3");
  EXPECT_EQ(numberText(-0.04, 1), "0.0");
  EXPECT_EQ(numberText(-3.6), "-4");
  EXPECT_EQ(numberText(NAN), "not measured");
  EXPECT_EQ(signedText(3.2), "+3");
  EXPECT_EQ(signedText(-0.2), "0");
  EXPECT_EQ(signedText(0.04, 1), "0.0");
  EXPECT_EQ(signedText(NAN), "not measured");
}

TEST(ReportText, DatesFromDicomAreWrittenWithDashes) {
  EXPECT_EQ(dateText("20260504"), "2026-05-04");
  EXPECT_EQ(dateText("2026-05-04"), "2026-05-04");
  EXPECT_EQ(dateText(""), "");
  EXPECT_EQ(dateText("20260231"), "no day of the calendar");
}

TEST(ReportText, NamesFromDicomReadAsPeopleWriteThem) {
  EXPECT_EQ(personText("Hong^Gildong=洪^吉洞=홍^길동"), "Hong Gildong / 洪 吉洞 / 홍 길동");
  EXPECT_EQ(personText("Demo^Patient"), "Demo Patient");
  EXPECT_EQ(personText("Doe^^^Dr"), "Doe Dr");
  EXPECT_EQ(personText(""), "");
  EXPECT_EQ(personText("=="), "");
}

BoneFigure figure(const char* quantity, const char* side, double value, double half, bool determined = true) {
  BoneFigure f;
  f.quantity = quantity;
  f.side = side;
  f.unit = "deg";
  f.value = value;
  f.lower95 = value - half;
  f.upper95 = value + half;
  f.determined = determined;
  return f;
}

class BoneTable : public testing::Test {
 protected:
  ReportTable table(std::vector<BoneFigure> figures, const NormQuery& who = {"M", 30, 1.8}) {
    SkeletonFit fit;
    fit.figures = std::move(figures);
    return boneTable(fit, loadNorms(test::resourceDir()), who);
  }
};

TEST_F(BoneTable, FlagsOnlyWhatIsBeyondNormAndMeasurementError) {
  // Norm of the hip-knee-ankle angle: 0 +- 3. Both sides are beyond 2 SD, but only the left for certain.
  const auto t = table({figure("hka", "r", 6.5, 1.0), figure("hka", "l", 8.0, 1.0)});
  ASSERT_EQ(t.rows.size(), 1u);
  EXPECT_THAT(t.rows[0], Contains("8.0 (7.0 to 9.0) \u25B2"));
  EXPECT_THAT(t.rows[0], Contains("6.5 (5.5 to 7.5)"));
  EXPECT_NEAR(t.z_scores[0][0], 6.5 / 3, 1e-9);  // right before left
  EXPECT_NEAR(t.z_scores[0][1], 8.0 / 3, 1e-9);
  EXPECT_THAT(t.columns[2], HasSubstr("Right"));
  EXPECT_EQ(t.rows[0][2], "6.5 (5.5 to 7.5)");
}

TEST_F(BoneTable, MarksADifferenceOnlyBeyondItsError) {
  // SD of each side 0.51: a difference of two has an error of 1.96 * 0.72 = 1.41.
  EXPECT_THAT(table({figure("hka", "r", 2.5, 1), figure("hka", "l", 1.2, 1)}).rows[0], Contains("+1.3"));
  EXPECT_THAT(table({figure("hka", "r", 2.7, 1), figure("hka", "l", 1.2, 1)}).rows[0], Contains("+1.5 *"));
}

TEST_F(BoneTable, NeverShowsThePriorAsAMeasurement) {
  const auto t = table({figure("tibial_torsion", "r", 31, 4), figure("tibial_torsion", "l", 30, 9, false)});
  EXPECT_THAT(t.rows[0], Contains("undetermined"));
  for (const auto& cell : t.rows[0]) EXPECT_THAT(cell, Not(HasSubstr("30.0")));
  EXPECT_TRUE(std::isnan(t.z_scores[0][1]));
}

TEST_F(BoneTable, AMissingSideIsSaid) {
  EXPECT_THAT(table({figure("hka", "r", 1, 1)}).rows[0], Contains("not measured"));
}

/// One finished case for all: the fit takes a moment.
class CaseReport : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new test::TemporaryFolder;
    reference_ = new Model{loadReferenceModel(test::resourceDir())};
    case_ = new Case{test::finishedCase(*reference_, folder_->path())};
    report_ = new Report{makeReport(*case_, folder_->path(), *reference_, test::resourceDir())};
  }
  static void TearDownTestSuite() {
    delete report_;
    delete case_;
    delete reference_;
    delete folder_;
  }
  static std::string rowText(const std::vector<std::string>& row) {
    std::string text;
    for (const auto& cell : row) text += cell + " | ";
    return text;
  }
  static inline test::TemporaryFolder* folder_ = nullptr;
  static inline Model* reference_ = nullptr;
  static inline Case* case_ = nullptr;
  static inline Report* report_ = nullptr;
};

TEST_F(CaseReport, HeaderKnowsAgeAtImagesAndAtExam) {
  EXPECT_THAT(report_->header, Contains(Pair("Age at images", "18 y 2 m")));
  EXPECT_THAT(report_->header, Contains(Pair("Images", "2026-05-04")));
  EXPECT_THAT(report_->header, Contains(Pair("Age at exam", "18 y 2 m")));
  EXPECT_THAT(report_->header, Contains(Pair("Mass", "58.0 kg")));
}

TEST_F(CaseReport, NoCellIsBlank) {
  std::vector<const ReportTable*> tables{&report_->bones, &report_->exam, &report_->muscles};
  for (const auto& annex : report_->annexes) tables.push_back(&annex);
  for (const auto* table : tables) {
    EXPECT_FALSE(table->rows.empty()) << table->title;
    for (const auto& row : table->rows) {
      ASSERT_EQ(row.size(), table->columns.size()) << table->title;
      for (const auto& cell : row) EXPECT_FALSE(cell.empty()) << table->title << ": " << rowText(row);
    }
  }
  for (const auto& [label, value] : report_->header) EXPECT_FALSE(value.empty()) << label;
  for (const auto& [label, value] : report_->footer) EXPECT_FALSE(value.empty()) << label;
}

TEST_F(CaseReport, BoneTableShowsTheFitsFigures) {
  for (const auto& f : case_->skeleton->figures) {
    if (f.quantity != "femur_length" || f.side != "r") continue;
    const std::string expected =
        numberText(f.value) + " (" + numberText(f.lower95) + " to " + numberText(f.upper95) + ")";
    EXPECT_THAT(rowText(report_->bones.rows.at(0)), HasSubstr(expected));
  }
}

TEST_F(CaseReport, ExamTableShowsBothSimulationsAndWhyATestIsMissing) {
  bool right = false, left = false;
  for (const auto& row : report_->exam.rows) {
    if (row[0] != "Unilateral popliteal angle") continue;
    if (row[1] == "Left") left = row[2] == "not measured: pain" && row[6] == "not measured";
    if (row[1] == "Right") {
      right = true;
      EXPECT_NE(row[4], row[5]) << "short hamstrings must change the simulated angle: " << rowText(row);
      EXPECT_LT(std::abs(std::stod(row[6])), 2.0) << rowText(row);
      EXPECT_EQ(row[7], numberText(50 * 58 / 73.0));
    }
  }
  EXPECT_TRUE(right && left);
}

TEST_F(CaseReport, AMeasurementBeyondItsNormIsMarkedLikeABone) {
  const ClinicalTests protocol = loadClinicalTests(test::resourceDir());
  const ClinicalTest& test = protocol.test("popliteal_unilateral");
  constexpr double kMean_deg = 33, kSd_deg = 11;
  const auto shown = [&](double beyond_sd, double error_sd) {
    ExamFit fit;
    fit.tests = {{.test = test.id,
                  .side = 'r',
                  .measured_deg = kMean_deg + beyond_sd * kSd_deg + error_sd * test.form->measurement_sd_deg,
                  .norm_mean_deg = kMean_deg,
                  .norm_sd_deg = kSd_deg}};
    return examTable(fit, {}, protocol).rows.at(0)[2];
  };
  EXPECT_THAT(shown(2, 2.1), HasSubstr("\u25B2"));
  EXPECT_THAT(shown(2, 1.8), Not(HasSubstr("\u25B2")));  // may well lie within
  EXPECT_THAT(shown(-2, -2.1), HasSubstr("\u25BC"));
  EXPECT_THAT(shown(0, 0), Not(testing::AnyOf(HasSubstr("\u25B2"), HasSubstr("\u25BC"))));
}

TEST_F(CaseReport, MuscleTableFindsTheShortHamstrings) {
  for (const auto& row : report_->muscles.rows)
    if (row[0] == "Hamstrings") {
      EXPECT_NEAR(std::stod(row[1]), 0.92, 0.03);        // right; the fitted skeleton is not quite the true one
      EXPECT_THAT(row[2], testing::StartsWith("1.00"));  // the unilateral test hurt, the bilateral one was done
      EXPECT_THAT(row[5], HasSubstr("popliteal"));
    }
}

TEST_F(CaseReport, FooterTellsWhereTheNumbersComeFrom) {
  EXPECT_THAT(report_->footer, Contains(Pair("Software", std::string{"Sinew "} + kVersion)));
  EXPECT_THAT(report_->footer, Contains(Pair("Model", HasSubstr(case_->model->sha256.substr(0, 12)))));
  EXPECT_THAT(report_->footer, Contains(Pair("Calibration", HasSubstr("bead phantom c0ffee, 0.21 px RMS"))));
  EXPECT_THAT(report_->disclaimer, HasSubstr("not a medical device"));
}

TEST_F(CaseReport, MomentCurvesMeetTheThresholdWhereTheModelStops) {
  for (const auto& plot : report_->passive_moments) {
    ASSERT_GT(plot.after.size(), 10u) << plot.title;
    EXPECT_GT(plot.threshold_Nm, 0);
  }
}

TEST_F(CaseReport, StaleStagesAreRefusedWithTheirNames) {
  Case stale = *case_;
  stale.sightings.front().uv_px.x() += 1;
  try {
    makeReport(stale, folder_->path(), *reference_, test::resourceDir());
    FAIL() << "a report was made from stale results";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("Landmarks: stale"));
    EXPECT_THAT(std::string{error.what()}, Not(HasSubstr("\n")));
  }
  EXPECT_THROW(makeReport(Case{}, folder_->path(), *reference_, test::resourceDir()), InputError);
}

TEST_F(CaseReport, AChangedImageFileIsRefused) {
  const auto file = folder_->path() / case_->images[0].file.path;
  const std::string content = readFile(file);
  writeFileAtomically(file, content + "x");
  EXPECT_THROW(makeReport(*case_, folder_->path(), *reference_, test::resourceDir()), InputError);
  writeFileAtomically(file, content);
}

TEST_F(CaseReport, WarningsOfEveryStageAreToldOnce) {
  Case warned = *case_;
  test::markDone(warned, Stage::Images, {{"a", "no laterality tag"}, {"b", "no laterality tag"}});
  const auto report = makeReport(warned, folder_->path(), *reference_, test::resourceDir());
  EXPECT_EQ(std::ranges::count(report.warnings, "Images: no laterality tag"), 1);
}

}  // namespace
}  // namespace sinew
