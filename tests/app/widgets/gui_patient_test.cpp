// Whose body is looked at, by hand, on a real OpenGL window (run under a virtual X server): explorer and retargeting
// with a case open, and what is known of the patient. Leaves a screenshot of every state in SINEW_SCREENSHOT_DIR.
#include <QApplication>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QTest>
#include <QTimer>

#include "app/widgets/explorer/explorer_page.h"
#include "app/widgets/retarget/retarget_page.h"
#include "app/widgets/shell/patient_dialog.h"
#include "clinical/case/case_io.h"
#include "core/retarget/prepared/reference.h"
#include "tests/app/widgets/window_tour.h"
#include "tests/support/finished_case.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using test::letEventsRun;
using test::waitUntil;
using ::testing::HasSubstr;

constexpr int kLimit_ms = 300'000;  // a loaded machine with a software renderer

class PatientTour : public test::WindowTour {
 protected:
  PatientTour() {
    const Model reference = loadReferenceModel(test::resourceDir());
    saveCase(test::finishedCase(reference, folder_.path()), folder_.path());
    workspace_.openCase(folder_.path());
    letEventsRun(100);
  }
  void screenshot(const QString& name) { WindowTour::screenshot("patient-" + name, test::usualSizes()); }

  test::TemporaryFolder folder_;
};

TEST_F(PatientTour, TheExplorerBeginsWithThisPatient) {
  QTest::keyClick(&window_, Qt::Key_M, Qt::ControlModifier);
  auto& page = find<ExplorerPage>("explorer_page");
  ASSERT_TRUE(waitUntil([&] { return page.explorer().model() == workspace_.patientModel(); }, kLimit_ms));
  letEventsRun(400);
  EXPECT_FALSE(find<QLabel>("explorer_whose").isVisible());
  screenshot("1-explorer-this-patient");
  auto& models = find<QComboBox>("explorer_model");
  emit models.activated(models.findText("Reference model"));
  ASSERT_TRUE(waitUntil([&] { return page.explorer().model()->name == "reference"; }, kLimit_ms));
  letEventsRun(400);
  EXPECT_TRUE(find<QLabel>("explorer_whose").isVisible());
  screenshot("2-explorer-reference");
}

TEST_F(PatientTour, RetargetingBeginsWithThisPatient) {
  QTest::keyClick(&window_, Qt::Key_T, Qt::ControlModifier);
  auto& page = find<RetargetPage>("retarget_page");
  ASSERT_TRUE(waitUntil([&] { return page.solver().isCurrent(); }, kLimit_ms))
      << page.solver().problem().toStdString();
  letEventsRun(300);
  EXPECT_EQ(page.document().current().body.shape, workspace_.document().current().skeleton->shape);
  EXPECT_THAT(find<QLabel>("retarget_body").text().toStdString(), HasSubstr("This patient"));
  screenshot("3-retargeting-this-patient");
}

TEST_F(PatientTour, WhatIsKnownIsChangedInADialog) {
  QTimer::singleShot(300, &window_, [this] {
    auto* dialog = window_.findChild<PatientDialog*>("patient_dialog");
    ASSERT_NE(dialog, nullptr);
    dialog->findChild<QLineEdit*>("patient_birth_date")->setText("2012-02-30");
    dialog->accept();
    letEventsRun(100);
    dialog->grab().save(QString{SINEW_SCREENSHOT_DIR} + "/patient-4-dialog.png");
    dialog->findChild<QLineEdit*>("patient_birth_date")->setText("2012-02-29");
    dialog->findChild<QLineEdit*>("patient_mass")->setText("54");
    dialog->accept();
  });
  click("patient_button");
  letEventsRun(200);
  EXPECT_EQ(workspace_.document().current().patient.mass_kg, 54);
  screenshot("5-after-the-change");
}

}  // namespace
}  // namespace sinew
