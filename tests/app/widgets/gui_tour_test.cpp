// The whole demo case by hand, with mouse and keyboard, on a real OpenGL window (run under a virtual X server).
// Leaves a screenshot of every stage in SINEW_SCREENSHOT_DIR.
#include <QAbstractButton>
#include <QApplication>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QTableWidget>
#include <QTest>
#include <QTimer>
#include <QWheelEvent>
#include <algorithm>
#include <fstream>

#include "app/model/case_actions.h"
#include "app/model/stage_text.h"
#include "app/widgets/stages/report_pages.h"
#include "app/widgets/views/model_view.h"
#include "app/widgets/views/radiograph_view.h"
#include "app/widgets/views/vtk_view.h"
#include "clinical/case/case_io.h"
#include "core/file.h"
#include "tests/app/widgets/window_tour.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using test::letEventsRun;
using test::waitUntil;

constexpr int kStageLimit_ms = 240'000;  // processor time: a software renderer beside the stage

class Tour : public test::WindowTour {
 protected:
  Tour() : WindowTour{printReport, renderReportPages} {}

  void type(const QString& object_name, const QString& text) {
    auto& edit = find<QLineEdit>(object_name);
    QTest::mouseClick(&edit, Qt::LeftButton);
    edit.selectAll();
    QTest::keyClick(&edit, Qt::Key_Delete);
    QTest::keyClicks(&edit, text);
    QTest::keyClick(&edit, Qt::Key_Return);
  }
  void pressKeys(Qt::Key key, Qt::KeyboardModifiers modifiers) {
    QApplication::setActiveWindow(&window_);  // there is no window manager to give it back after a dialog
    QTest::keyClick(&window_, key, modifiers);
  }
  void goTo(Stage stage) {
    click("stage_" + QString::fromStdString(nameOf(stage)));
    letEventsRun(100);
    EXPECT_TRUE(find<QWidget>(QString::fromStdString(nameOf(stage)) + "_page").isVisible());
  }
  /// Presses the page's run button and waits until it is done.
  void run(Stage stage) {
    goTo(stage);
    click("run_" + QString::fromStdString(nameOf(stage)));
    ASSERT_TRUE(waitUntil([&] { return !workspace_.jobs().isBusy(); }, kStageLimit_ms));
    EXPECT_EQ(workspace_.document().stateOf(stage), StageState::Done)
        << nameOf(stage) << ": " << problems_.join("; ").toStdString();
  }
  /// Zooms in with the wheel, clicks the pixel, and zooms out again.
  void pick(const QString& view_name, const Eigen::Vector2d& uv_px) {
    auto& view = find<RadiographView>(view_name);
    view.fit();
    for (int i = 0; i < 24 && view.zoom() < 4; ++i) {
      const QPointF at = view.toWidget({uv_px.x(), uv_px.y()});
      QWheelEvent wheel{at,   view.mapToGlobal(at), {}, {0, 120}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase,
                        false};
      QApplication::sendEvent(&view, &wheel);
    }
    QTest::mouseClick(&view, Qt::LeftButton, {}, view.toWidget({uv_px.x(), uv_px.y()}).toPoint());
    view.fit();
  }
  void selectRow(const QString& table_name, const QString& text) {
    auto& table = find<QTableWidget>(table_name);
    for (int row = 0; row < table.rowCount(); ++row)
      if (table.item(row, 0)->text() == text) {
        table.scrollToItem(table.item(row, 0));
        QTest::mouseClick(table.viewport(), Qt::LeftButton, {}, table.visualItemRect(table.item(row, 0)).center());
        return;
      }
    FAIL() << "no row " << text.toStdString();
  }
  const Case& current() { return workspace_.document().current(); }

  test::TemporaryFolder folder_;
  void screenshot(const QString& name) { WindowTour::screenshot(name, {{1280, 800}, {1920, 1080}}); }

  void placeLandmarksByHand();
  void dragALandmarkAndTakeItBack();
  void enterTheExamination();
  void exportTheReport();
};

void Tour::placeLandmarksByHand() {
  goTo(Stage::Landmarks);
  const Case demo = current();
  int placed = 0;
  for (const auto& s : demo.sightings) {
    if (s.view != 0 || !findSighting(demo, s.name, 1) || placed == 3) continue;
    ++placed;
    const Sighting lateral = *findSighting(demo, s.name, 1);
    workspace_.view().setLandmark(s.name);
    letEventsRun(30);
    EXPECT_GE(find<QTableWidget>("landmark_table").currentRow(), 0);
    click("remove_landmark");
    EXPECT_EQ(findSighting(current(), s.name, 0), nullptr);
    EXPECT_EQ(findSighting(current(), s.name, 1), nullptr);
    pick("frontal_view", s.uv_px);
    pick("lateral_view", lateral.uv_px);
    for (const Sighting& wanted : {s, lateral}) {
      const Sighting* got = findSighting(current(), s.name, wanted.view);
      ASSERT_NE(got, nullptr) << s.name;
      EXPECT_LT((got->uv_px - wanted.uv_px).norm(), 0.3) << s.name;  // half a screen pixel at zoom 4, both ways
    }
  }
  EXPECT_EQ(placed, 3);
  EXPECT_EQ(current().sightings.size(), demo.sightings.size());
}

void Tour::dragALandmarkAndTakeItBack() {
  const Sighting before = current().sightings.back();
  auto& view = find<RadiographView>(before.view == 0 ? "frontal_view" : "lateral_view");
  view.zoomTo({before.uv_px.x(), before.uv_px.y()}, 2);
  workspace_.view().setLandmark(before.name);
  const QPoint at = view.toWidget({before.uv_px.x(), before.uv_px.y()}).toPoint();
  QTest::mousePress(&view, Qt::LeftButton, {}, at);
  for (int i = 1; i <= 10; ++i) QTest::mouseMove(&view, at + QPoint{2 * i, 0});
  EXPECT_NEAR(findSighting(current(), before.name, before.view)->uv_px.x(), before.uv_px.x() + 10, 0.6);  // live
  QTest::mouseRelease(&view, Qt::LeftButton, {}, at + QPoint{20, 0});
  EXPECT_NEAR(findSighting(current(), before.name, before.view)->uv_px.x(), before.uv_px.x() + 10, 0.6);
  screenshot("landmark-zoomed");
  pressKeys(Qt::Key_Z, Qt::ControlModifier);  // one step, whatever the number of moves
  EXPECT_EQ(findSighting(current(), before.name, before.view)->uv_px, before.uv_px);
  pressKeys(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_NE(findSighting(current(), before.name, before.view)->uv_px, before.uv_px);
  pressKeys(Qt::Key_Z, Qt::ControlModifier);
  view.fit();
}

void Tour::enterTheExamination() {
  goTo(Stage::Exam);
  const Case demo = current();
  const auto& protocol = workspace_.protocol();
  const ClinicalTest& test = *protocol.form().front();
  const QString name = "measured_" + QString::fromStdString(test.id) + "_r";
  type(name, "400");
  ASSERT_FALSE(problems_.isEmpty());
  EXPECT_TRUE(find<QLabel>("banner_text").isVisible());
  EXPECT_EQ(current().exam, demo.exam);  // refused; the field shows the truth again
  problems_.clear();
  click("banner_close");
  type(name, "41");
  EXPECT_EQ(findExamEntry(current(), test.id, 'r')->measured_deg, 41);
  type("note_" + QString::fromStdString(test.id) + "_r", "firm end-feel");
  EXPECT_EQ(findExamEntry(current(), test.id, 'r')->note, "firm end-feel");
  // back to what the synthetic patient gave
  for (int i = 0; i < 2; ++i) pressKeys(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(current().exam, demo.exam);
}

void Tour::exportTheReport() {
  goTo(Stage::Report);
  ASSERT_TRUE(waitUntil([&] { return window_.findChild<QLabel*>("report_page_1") != nullptr; }, 60'000));
  letEventsRun(200);
  screenshot("7-report");
  const auto pdf = folder_ / "exported.pdf";
  answerFileDialog(pdf);
  click("export_report");
  ASSERT_TRUE(std::filesystem::exists(pdf));
  EXPECT_TRUE(readFile(pdf).starts_with("%PDF"));
}

TEST_F(Tour, TheDemoPatientFromRadiographsToReport) {
  screenshot("0-welcome");
  const auto case_folder = folder_ / "demo";
  std::filesystem::create_directory(case_folder);
  answerFileDialog(case_folder);
  click("welcome_demo");
  waitUntil([&] { return workspace_.document().isOpen() || !problems_.isEmpty(); }, kStageLimit_ms);
  ASSERT_TRUE(workspace_.document().isOpen()) << problems_.join("; ").toStdString();
  ASSERT_TRUE(waitUntil([&] { return !workspace_.jobs().isBusy(); }));

  EXPECT_FALSE(window_.windowTitle().contains("Demo"));  // no patient in the title
  EXPECT_TRUE(find<QLabel>("patient_name").text().contains("Demo"));
  ASSERT_NE(find<RadiographView>("frontal_view").radiograph(), nullptr);

  run(Stage::Images);
  screenshot("1-images");
  run(Stage::Calibration);
  ASSERT_TRUE(current().rig.has_value());
  screenshot("2-calibration");
  placeLandmarksByHand();
  dragALandmarkAndTakeItBack();
  run(Stage::Landmarks);
  screenshot("3-landmarks");
  run(Stage::Skeleton);
  letEventsRun(400);
  EXPECT_GT(find<VtkView>("skeleton_model_canvas").renderCount(), 0);
  click("skeleton_model_oblique");
  screenshot("4-skeleton");
  run(Stage::Musculature);
  type("muscle_search", "soleus");
  selectRow("muscle_table", readableName("soleus_medial_r"));
  EXPECT_EQ(workspace_.view().muscle(), "soleus_medial_r");
  screenshot("5-musculature");
  enterTheExamination();
  run(Stage::Exam);
  screenshot("6-examination");
  run(Stage::Report);
  exportTheReport();

  EXPECT_TRUE(workspace_.document().isModified());
  pressKeys(Qt::Key_S, Qt::ControlModifier);
  EXPECT_FALSE(workspace_.document().isModified());
  EXPECT_EQ(loadCase(case_folder), current());

  // A changed pick makes everything after it stale, and the report refuses.
  goTo(Stage::Landmarks);
  workspace_.document().edit("Move", [](Case& c) { c.sightings.front().uv_px.x() += 1; });
  for (const Stage stage : {Stage::Landmarks, Stage::Skeleton, Stage::Report})
    EXPECT_NE(workspace_.document().stateOf(stage), StageState::Done) << nameOf(stage);
  goTo(Stage::Skeleton);
  screenshot("8-stale");
  EXPECT_THAT(problems_, ::testing::IsEmpty()) << problems_.join("; ").toStdString();
  workspace_.saveCase();
}

TEST_F(Tour, NoQt5IsInTheProcess) {
  std::ifstream maps{"/proc/self/maps"};
  std::string line;
  int qt6 = 0;
  while (std::getline(maps, line)) {
    EXPECT_THAT(line, ::testing::Not(::testing::HasSubstr("libQt5")));
    qt6 += line.find("libQt6Widgets") != std::string::npos;
  }
  EXPECT_GT(qt6, 0);  // the map was read
}

}  // namespace
}  // namespace sinew
