// The whole window on the "offscreen" platform: every page with an empty, a finished and an unusual case, what is
// typed and where it goes, and what it answers to bad files. The tour under a virtual X server shows the same with
// OpenGL.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QApplication>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QTableWidget>
#include <QTest>
#include <QTimer>
#include <cmath>
#include <set>
#include <thread>

#include "app/model/case_actions.h"
#include "app/model/stage_text.h"
#include "app/model/workspace.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/theme.h"
#include "app/widgets/explorer/explorer_page.h"
#include "app/widgets/retarget/retarget_page.h"
#include "app/widgets/shell/main_window.h"
#include "app/widgets/shell/patient_dialog.h"
#include "app/widgets/stages/calibration_page.h"
#include "app/widgets/stages/landmarks_page.h"
#include "app/widgets/views/radiograph_view.h"
#include "clinical/case/case_io.h"
#include "clinical/report/supported_bones.h"
#include "core/file.h"
#include "core/model/model.h"
#include "tests/app/gui_support.h"
#include "tests/support/finished_case.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using test::waitUntil;
using ::testing::HasSubstr;

class PagesTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!QApplication::instance()) {
      qputenv("QT_QPA_PLATFORM", "offscreen");
      static int argc = 1;
      static char name[] = "pages-test";
      static char* argv[] = {name, nullptr};
      installTheme(*new QApplication{argc, argv}, test::resourceDir());  // lives as long as the process
    }
    finished_folder_ = new test::TemporaryFolder;
    const Model reference = loadReferenceModel(test::resourceDir());
    saveCase(test::finishedCase(reference, finished_folder_->path()), finished_folder_->path());
  }
  static void TearDownTestSuite() {
    delete finished_folder_;
    finished_folder_ = nullptr;
  }
  PagesTest() : workspace_{test::resourceDir(), {}}, window_{workspace_, {}} {
    window_.resize(1280, 800);
    window_.show();
    QObject::connect(&workspace_, &Workspace::problem, [this](const QString& message) { problem_ = message; });
  }
  template <class T>
  T& find(const QString& object_name) {
    const auto all = window_.findChildren<T*>(object_name);
    const auto found = std::ranges::find_if(all, [](const T* control) { return control->isVisible(); });
    if (all.isEmpty()) throw std::runtime_error{"no control " + object_name.toStdString()};
    return found == all.end() ? *all.front() : **found;
  }
  void openFinished() {
    std::filesystem::copy(finished_folder_->path(), folder_ / "case", std::filesystem::copy_options::recursive);
    workspace_.openCase(folder_ / "case");
  }
  void openChanged(const std::function<void(Case&)>& change) {
    Case c = loadCase(finished_folder_->path());
    change(c);
    std::filesystem::copy(finished_folder_->path(), folder_ / "case", std::filesystem::copy_options::recursive);
    saveCase(c, folder_ / "case");
    workspace_.openCase(folder_ / "case");
  }
  void visitEveryPage() {
    ASSERT_TRUE(workspace_.document().isOpen()) << problem_.toStdString();
    for (const Stage stage : kStages) {
      workspace_.view().setStage(stage);
      QApplication::processEvents();
      const auto& page = find<QWidget>(QString::fromStdString(nameOf(stage)) + "_page");
      EXPECT_TRUE(page.isVisible()) << nameOf(stage);
      EXPECT_FALSE(window_.grab().isNull());
    }
    EXPECT_EQ(problem_, "");
  }
  void type(const QString& object_name, const QString& text) {
    auto& edit = find<QLineEdit>(object_name);
    edit.setText(text);
    QTest::keyClick(&edit, Qt::Key_Return);
  }
  const Case& current() { return workspace_.document().current(); }

  static inline test::TemporaryFolder* finished_folder_ = nullptr;
  test::TemporaryFolder folder_;
  Workspace workspace_;
  MainWindow window_;
  QString problem_;
};

TEST_F(PagesTest, EveryPageOpensWithAnEmptyCase) {
  saveCase(Case{}, folder_.path());
  workspace_.openCase(folder_.path());
  visitEveryPage();
  EXPECT_EQ(find<QLabel>("patient_name").text(), "Patient without a name");
}

TEST_F(PagesTest, EveryPageOpensWithAFinishedCase) {
  openFinished();
  visitEveryPage();
  for (const Stage stage : {Stage::Calibration, Stage::Landmarks, Stage::Skeleton, Stage::Exam})
    EXPECT_EQ(workspace_.document().stateOf(stage), StageState::Done) << nameOf(stage);
  EXPECT_EQ(stageLine(current(), Stage::Calibration), "Bead phantom, 0.21 px");
}

TEST_F(PagesTest, EveryPageOpensWithARigThatDoesNotKnowThePatientsAxes) {
  openChanged([](Case& c) {
    c.rig->patient_aligned = false;
    c.rig->calibration.method = "autoscoper";
    c.rig->calibration.rms_px = std::numeric_limits<double>::quiet_NaN();
    c.imported_rig = c.rig;
    c.phantom.reset();
    c.skeleton.reset();
    c.exam_fit.reset();
    c.model.reset();
    c.stages.clear();
  });
  visitEveryPage();
  workspace_.view().setStage(Stage::Calibration);
  EXPECT_THAT(find<QLabel>("calibration_method").text().toStdString(), HasSubstr("in the laboratory's axes"));
  EXPECT_EQ(find<QLabel>("calibration_rms").text(), "none");
}

TEST_F(PagesTest, TheSkeletonTableReadsLikeTheReportAndSaysWhatIsUndetermined) {
  openChanged([](Case& c) {
    for (auto& f : c.skeleton->figures)
      if (f.quantity == "tibial_torsion" && f.side == "l") f.determined = false;
  });
  workspace_.view().setStage(Stage::Skeleton);
  const auto& table = find<QTableWidget>("figure_table");
  QStringList titles;
  for (int row = 0; row < table.rowCount(); ++row) {
    titles << table.item(row, 0)->text();
    if (titles.back() != "Tibial torsion (external +)") continue;
    EXPECT_EQ(table.item(row, 3)->text(), "undetermined");
    EXPECT_EQ(table.item(row, 4)->text(), "");
    EXPECT_EQ(table.item(row, 5)->text(), "");  // no difference from what is not known
    EXPECT_NE(table.item(row, 1)->text(), "undetermined");
  }
  EXPECT_TRUE(titles.contains("Hip-knee-ankle angle (varus +, 0 = straight)")) << titles.join("; ").toStdString();
  EXPECT_TRUE(titles.contains("Tibial torsion (external +)"));
}

TEST_F(PagesTest, OnlyTheBonesThatTheImagesShowAreDrawnOverThem) {
  openFinished();
  std::set<std::string> names;
  for (const auto& bone : supportedBones(*workspace_.patientModel(), current().sightings)) names.insert(bone.bone);
  for (const char* seen : {"femur_r", "femur_l", "tibia_r", "patella_l"}) EXPECT_TRUE(names.contains(seen)) << seen;
  for (const std::string& name : names)
    for (const char* unseen : {"humerus", "skull", "rib", "ulna", "radius", "scapula"})
      EXPECT_FALSE(name.starts_with(unseen)) << name;
}

TEST_F(PagesTest, EveryFieldOfTheExaminationIsStoredAndReadBack) {
  openFinished();
  workspace_.view().setStage(Stage::Exam);
  type("examiner", "B. Reader");
  type("exam_date", "2024-05-07");  // a day that is past by every clock
  for (const ClinicalTest* row : workspace_.protocol().form())
    for (const char side : {'r', 'l'}) {
      const ClinicalTest& test = *row;
      const QString name = QString::fromStdString(test.id) + '_' + side;
      const double value_deg = std::round((test.form->entry_min_deg + test.form->entry_max_deg) / 2);
      type("measured_" + name, QString::number(value_deg) + "°");
      type("stop_" + name, side == 'r' ? "22,5" : "31");
      type("note_" + name, "firm " + name);
    }
  EXPECT_EQ(problem_, "");
  workspace_.saveCase();
  const Case stored = loadCase(folder_ / "case");
  EXPECT_EQ(stored.exam.examiner, "B. Reader");
  EXPECT_EQ(stored.exam.date, "2024-05-07");
  for (const ClinicalTest* row : workspace_.protocol().form())
    for (const char side : {'r', 'l'}) {
      const ClinicalTest& test = *row;
      const ExamEntry* entry = findExamEntry(stored, test.id, side);
      ASSERT_NE(entry, nullptr) << test.id << side;
      EXPECT_EQ(entry->measured_deg, std::round((test.form->entry_min_deg + test.form->entry_max_deg) / 2))
          << test.id << side;
      EXPECT_EQ(entry->threshold_Nm, side == 'r' ? 22.5 : 31) << test.id << side;
      EXPECT_EQ(entry->note, "firm " + test.id + '_' + side);
    }
  // Another window shows what was stored; an emptied field is not measured.
  workspace_.openCase(folder_ / "case");
  const QString first = QString::fromStdString(workspace_.protocol().form().front()->id) + "_r";
  EXPECT_EQ(find<QLineEdit>("stop_" + first).text(), "22.5");
  EXPECT_EQ(find<QLineEdit>("note_" + first).text(), "firm " + first);
  type("measured_" + first, "");
  EXPECT_FALSE(findExamEntry(current(), workspace_.protocol().form().front()->id, 'r')->measured_deg.has_value());
}

TEST_F(PagesTest, AnImpossibleStopTorqueIsRefusedAndTheFieldShowsTheStoredOne) {
  openFinished();
  workspace_.view().setStage(Stage::Exam);
  const std::string id = workspace_.protocol().form().front()->id;
  const QString name = "stop_" + QString::fromStdString(id) + "_r";
  for (const char* typed : {"900", "-3", "strong"}) {
    problem_.clear();
    type(name, typed);
    EXPECT_THAT(problem_.toStdString(), HasSubstr("stop torque")) << typed;
    EXPECT_EQ(find<QLineEdit>(name).text(), "") << typed;
    EXPECT_FALSE(findExamEntry(current(), id, 'r')->threshold_Nm.has_value());
  }
  EXPECT_TRUE(find<QLabel>("banner_text").isVisible());
}

TEST_F(PagesTest, TheFormOfTheExaminationFitsTheSmallestScreen) {
  openFinished();
  workspace_.view().setStage(Stage::Exam);
  QApplication::processEvents();
  const auto& form = find<QWidget>("exam_form");
  for (const auto* child : form.findChildren<QWidget*>()) {
    const auto* label = qobject_cast<const QLabel*>(child);
    if (!child->isVisibleTo(&form) || !(label || qobject_cast<const QLineEdit*>(child))) continue;
    EXPECT_LE(child->mapTo(&form, QPoint{child->width(), 0}).x(), form.width()) << child->objectName().toStdString();
    if (label && !label->wordWrap()) {
      EXPECT_GE(label->width(), label->sizeHint().width()) << label->text().toStdString();
    }
  }
}

TEST_F(PagesTest, ALongDiagnosisEndsInAnEllipsis) {
  openChanged([](Case& c) { c.patient.diagnosis = "spastic diplegia "; });
  auto& details = find<ElidedLabel>("patient_details");
  QApplication::processEvents();
  EXPECT_FALSE(details.isElided());
  workspace_.document().edit("Diagnosis", [](Case& c) {
    for (int i = 0; i < 4; ++i) c.patient.diagnosis += c.patient.diagnosis;
  });
  QApplication::processEvents();
  EXPECT_TRUE(details.isElided());
  EXPECT_THAT(details.text().toStdString(), HasSubstr(current().patient.diagnosis));  // all of it in the tool tip
}

TEST_F(PagesTest, ThePatientCanBeChangedAtAnyTimeAndUndone) {
  openFinished();
  const Patient before = current().patient;
  PatientDialog dialog{workspace_.document(), &window_};
  const auto enter = [&](const char* field, const char* text) {
    dialog.findChild<QLineEdit*>(QString{"patient_"} + field)->setText(text);
  };
  EXPECT_EQ(dialog.findChild<QLineEdit*>("patient_height")->text(), "171");
  EXPECT_EQ(dialog.findChild<QComboBox*>("patient_sex")->currentData().toString(), "M");
  for (const char* wrong : {"2008-02-30", "2099-01-01", "2026-05-30", "soon"}) {  // the exam was on 2026-05-06
    enter("birth_date", wrong);
    dialog.accept();
    EXPECT_THAT(dialog.findChild<QLabel*>("patient_problem")->text().toStdString(), HasSubstr("birth date")) << wrong;
    EXPECT_EQ(current().patient, before) << wrong;
  }
  enter("birth_date", "20120229");
  enter("mass", "54");
  dialog.accept();
  EXPECT_EQ(current().patient.birth_date, "2012-02-29");
  EXPECT_EQ(current().patient.mass_kg, 54);
  EXPECT_EQ(workspace_.document().stateOf(Stage::Skeleton), StageState::Done);
  EXPECT_EQ(workspace_.document().stateOf(Stage::Exam), StageState::Stale);
  workspace_.document().undo();
  EXPECT_EQ(current().patient, before);
  EXPECT_EQ(workspace_.document().stateOf(Stage::Exam), StageState::Done);
}

TEST_F(PagesTest, TheExplorerShowsThisPatientFirstAndNamesAnyOtherBody) {
  openFinished();
  workspace_.view().setExplorer(true);
  auto& page = find<ExplorerPage>("explorer_page");
  auto& models = find<QComboBox>("explorer_model");
  ASSERT_TRUE(page.explorer().model());
  EXPECT_EQ(page.explorer().model(), workspace_.patientModel());
  EXPECT_EQ(models.currentIndex(), 0);
  EXPECT_EQ(models.currentText(), "This patient");
  EXPECT_FALSE(find<QLabel>("explorer_whose").isVisible());
  workspace_.document().edit("Mass", [](Case& c) { c.patient.mass_kg = 54; });  // the examination is out of date
  EXPECT_EQ(models.currentText().left(12), "This patient");
  EXPECT_NE(models.currentText(), "This patient");
  EXPECT_EQ(page.explorer().model(), workspace_.patientModel());

  emit models.activated(models.findText("Reference model"));
  ASSERT_TRUE(waitUntil([&] { return page.explorer().model()->name == "reference"; }, 60'000));
  EXPECT_EQ(models.currentText(), "Reference model");
  EXPECT_TRUE(find<QLabel>("explorer_whose").isVisible());
  EXPECT_EQ(find<QLabel>("explorer_whose").text(), "Not this patient");
  workspace_.document().undo();  // a body chosen by hand stays
  EXPECT_EQ(page.explorer().model()->name, "reference");
}

TEST_F(PagesTest, NoBodyIsShownUnderTheNameOfAnotherPatient) {
  openFinished();
  workspace_.view().setExplorer(true);
  workspace_.view().setRetargeting(true);
  auto& page = find<ExplorerPage>("explorer_page");
  auto& retarget = find<RetargetPage>("retarget_page");
  EXPECT_EQ(retarget.document().current().body.shape, current().skeleton->shape);
  EXPECT_THAT(find<QLabel>("retarget_body").text().toStdString(), HasSubstr("This patient"));
  retarget.document().edit("Longer", [](RetargetDesign& d) { d.body.shape.trunk_elongation *= 1.1; });
  EXPECT_THAT(find<QLabel>("retarget_body").text().toStdString(), HasSubstr("This patient, changed"));

  const test::TemporaryFolder other;
  saveCase(Case{}, other.path());
  workspace_.openCase(other.path());
  EXPECT_EQ(retarget.document().current(), RetargetDesign{});
  EXPECT_FALSE(retarget.document().canUndo());
  workspace_.view().setExplorer(true);
  ASSERT_TRUE(waitUntil([&] { return page.explorer().model()->name == "reference"; }, 60'000));
  EXPECT_THAT(find<QLabel>("explorer_whose").text().toStdString(), HasSubstr("bones are not fitted"));
  workspace_.view().setRetargeting(true);
  EXPECT_THAT(find<QLabel>("retarget_body").text().toStdString(), HasSubstr("Not this patient"));
}

TEST_F(PagesTest, TheDemoRefusesAFolderThatHoldsOtherThings) {
  writeFileAtomically(folder_ / "work/thesis.txt", "years of work");
  workspace_.makeDemo(folder_ / "work", false);
  EXPECT_THAT(problem_.toStdString(), HasSubstr("an empty folder or an earlier demo"));
  EXPECT_FALSE(workspace_.document().isOpen());
  std::filesystem::copy(finished_folder_->path(), folder_ / "case", std::filesystem::copy_options::recursive);
  workspace_.makeDemo(folder_ / "case", false);  // a case, but no demo
  EXPECT_FALSE(workspace_.document().isOpen());
  EXPECT_FALSE(workspace_.jobs().isBusy());
}

TEST_F(PagesTest, PresetsOfTheGreyWindow) {
  openFinished();  // one grey value, 900, window 1500 +- 1500 in the file
  workspace_.view().setStage(Stage::Images);
  QApplication::processEvents();
  auto& presets = find<QComboBox>("frontal_preset");
  auto& view = find<RadiographView>("frontal_view");
  EXPECT_NEAR(view.windowCenter(), 1500, 0.5);
  EXPECT_NEAR(view.windowWidth(), 3000, 1);
  const auto choose = [&](int index) {
    presets.setCurrentIndex(index);
    emit presets.activated(index);
  };
  choose(int(presets.findText("Full range")));
  EXPECT_NEAR(view.windowCenter(), 900, 2);  // the film holds nothing else
  EXPECT_LT(view.windowWidth(), 10);
  choose(int(presets.findText("From file")));
  EXPECT_NEAR(view.windowCenter(), 1500, 0.5);
}

TEST_F(PagesTest, SightingsAreReadFromATableAndABadOneIsRefused) {
  openFinished();
  workspace_.view().setStage(Stage::Landmarks);
  auto& page = find<LandmarksPage>("landmarks_page");
  const auto before = current().sightings;
  writeFileAtomically(folder_ / "bad.csv", "name,view,u_px,v_px\nasis_r,1,12,abc\n");
  page.importSightings(folder_ / "bad.csv");
  EXPECT_THAT(problem_.toStdString(), HasSubstr("abc"));
  EXPECT_TRUE(find<QLabel>("banner_text").isVisible());
  EXPECT_EQ(find<QLabel>("banner_text").text(), problem_);
  EXPECT_EQ(current().sightings.size(), before.size());
  page.importSightings(folder_ / "nowhere.csv");
  EXPECT_THAT(problem_.toStdString(), HasSubstr("nowhere.csv"));

  page.exportSightings(folder_ / "out.csv");
  workspace_.document().edit("Clear", [](Case& c) { c.sightings.clear(); });
  page.importSightings(folder_ / "out.csv");
  ASSERT_EQ(current().sightings.size(), before.size());
  EXPECT_NEAR(current().sightings[3].uv_px.x(), before[3].uv_px.x(), 1e-3);
}

TEST_F(PagesTest, ATextCalibrationIsNamedByTheFormatThatWasChosen) {
  openFinished();
  workspace_.view().setStage(Stage::Calibration);
  auto& page = find<CalibrationPage>("calibration_page");
  const std::vector<std::filesystem::path> files{folder_ / "1.txt", folder_ / "2.txt"};
  const auto write = [&](const char* pose_of_view_2) {
    const std::string camera = "image size\n1000,1000\n\ncamera matrix\n5000,0,500\n0,5000,500\n0,0,1\n\nrotation\n";
    writeFileAtomically(files[0], camera + "1,0,0\n0,1,0\n0,0,1\n\ntranslation\n0\n0\n-1000\n");
    writeFileAtomically(files[1], camera + pose_of_view_2);
  };
  write("0,0,1\n0,1,0\n-1,0,0\n\ntranslation\n0\n0\n-1000\n");
  for (const char* method : {"autoscoper", "mayacam"}) {
    page.importRig(files, method);
    ASSERT_EQ(problem_, "") << method;
    ASSERT_TRUE(current().imported_rig.has_value());
    EXPECT_EQ(current().imported_rig->calibration.method, method);
  }
  page.importRig(files, "json");
  EXPECT_THAT(problem_.toStdString(), HasSubstr("1.txt"));
  EXPECT_EQ(current().imported_rig->calibration.method, "mayacam");
}

TEST_F(PagesTest, ClosingAsksForUnsavedChanges) {
  openFinished();
  workspace_.document().edit("Set examiner", [](Case& c) { c.exam.examiner = "C. D."; });
  const auto closeAnswering = [&](QMessageBox::StandardButton answer) {
    bool asked = false;
    QTimer::singleShot(0, [&] {
      auto* question = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      asked = question && question->objectName() == "unsaved_question";
      if (question) question->button(answer)->click();
    });
    const bool closed = window_.close();
    EXPECT_TRUE(asked);
    return closed;
  };
  EXPECT_FALSE(closeAnswering(QMessageBox::Cancel));
  EXPECT_TRUE(window_.isVisible());
  EXPECT_NE(loadCase(folder_ / "case").exam.examiner, "C. D.");
  EXPECT_TRUE(closeAnswering(QMessageBox::Save));
  EXPECT_EQ(loadCase(folder_ / "case").exam.examiner, "C. D.");
  window_.show();
  workspace_.document().edit("Set examiner", [](Case& c) { c.exam.examiner = "E. F."; });
  EXPECT_TRUE(closeAnswering(QMessageBox::Discard));
  EXPECT_EQ(loadCase(folder_ / "case").exam.examiner, "C. D.");
}

TEST_F(PagesTest, TheCancelButtonStopsALongComputation) {
  openFinished();
  auto& cancel = find<QPushButton>("cancel_job");
  EXPECT_FALSE(cancel.isVisible());
  ASSERT_TRUE(workspace_.jobs().start("Long work", [](const Job& job) -> JobRunner::Finish {
    while (!job.cancelled()) {
      job.report(0.5, "half way");
      std::this_thread::sleep_for(std::chrono::milliseconds{2});
    }
    return {};
  }));
  ASSERT_TRUE(waitUntil([&] { return cancel.isVisible() && find<QLabel>("status_text").text() == "half way"; }));
  EXPECT_FALSE(find<QPushButton>("run_all").isEnabled());
  QTest::mouseClick(&cancel, Qt::LeftButton);
  ASSERT_TRUE(waitUntil([&] { return !workspace_.jobs().isBusy(); }));
  EXPECT_FALSE(cancel.isVisible());
  EXPECT_EQ(find<QLabel>("status_text").text(), "Ready");
  EXPECT_EQ(find<QLabel>("banner_text").text(), "Cancelled: Long work");
}

}  // namespace
}  // namespace sinew
