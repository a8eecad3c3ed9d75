// The model explorer by hand, with mouse and keyboard, on a real OpenGL window (run under a virtual X server). Leaves
// a screenshot of every state in SINEW_SCREENSHOT_DIR.
#include <QAbstractButton>
#include <QApplication>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QLineEdit>
#include <QScrollArea>
#include <QScrollBar>
#include <QSlider>
#include <QTabWidget>
#include <QTableView>
#include <QTest>
#include <algorithm>

#include "app/widgets/controls/range_slider.h"
#include "app/widgets/explorer/explorer_page.h"
#include "app/widgets/views/model_view.h"
#include "app/widgets/views/vtk_view.h"
#include "core/angle.h"
#include "tests/app/widgets/window_tour.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

using test::letEventsRun;
using test::threadTime_ms;
using test::waitUntil;
using ::testing::HasSubstr;

constexpr int kLimit_ms = 120'000;  // processor time: a software renderer beside the work

class ExplorerTour : public test::WindowTour {
 protected:
  ExplorerTour() {
    click("welcome_explorer");
    EXPECT_TRUE(waitUntil([&] { return explorer().model() != nullptr; }, kLimit_ms));
    letEventsRun(300);
  }

  Explorer& explorer() { return find<ExplorerPage>("explorer_page").explorer(); }
  void choose(const QString& object_name, int index) {
    auto& combo = find<QComboBox>(object_name);
    combo.setCurrentIndex(index);
    emit combo.activated(index);
    letEventsRun(80);
  }
  void takePosture(const QString& name) {
    const int index = find<QComboBox>("preset_posture").findText(name);
    ASSERT_GT(index, 0) << name.toStdString();
    choose("preset_posture", index);
    ASSERT_TRUE(waitUntil([&] { return explorer().rangesAreCurrent(); }, kLimit_ms));
    letEventsRun(100);
  }
  double degrees(const char* coordinate) {
    return explorer().clinical()[explorer().model()->skeleton.coordinateIndex(coordinate)] / kRadPerDeg;
  }

  void screenshot(const QString& name) { WindowTour::screenshot("explorer-" + name, test::usualSizes()); }
};

TEST_F(ExplorerTour, FindsAMuscleAndShowsItsCardAndCurves) {
  EXPECT_FALSE(workspace_.document().isOpen());  // no case is needed
  screenshot("1-open");
  auto& search = find<QLineEdit>("explorer_search");
  QTest::keyClicks(&search, "semitendinosus");
  auto& list = find<QTableView>("explorer_list");
  EXPECT_EQ(list.model()->rowCount(), 2);
  QTest::keyClick(&search, Qt::Key_Return);
  EXPECT_EQ(explorer().muscle(), "semitendinosus_r");
  letEventsRun(150);
  const QString card = find<QLabel>("card_facts").text();
  EXPECT_THAT(card.toStdString(), HasSubstr("Knee flexion"));
  EXPECT_THAT(card.toStdString(), HasSubstr("Hip extension"));
  EXPECT_THAT(card.toStdString(), HasSubstr("N/cm"));
  screenshot("2-card");
  find<QTabWidget>("explorer_right").setCurrentIndex(1);
  screenshot("3-curves");
  search.clear();
  QTest::keyClicks(&search, "semitendonosis");
  EXPECT_THAT(find<QLabel>("explorer_count").text().toStdString(), HasSubstr("Nearest"));
  EXPECT_GT(list.model()->rowCount(), 0);
  screenshot("4-nearest");
}

TEST_F(ExplorerTour, AClickInTheModelChoosesTheMuscle) {
  auto& canvas = find<VtkView>("explorer_view_canvas");
  ASSERT_TRUE(waitUntil([&] { return canvas.renderCount() > 0; }, kLimit_ms));
  // Somewhere on the thighs there is a muscle in front of everything.
  for (int y = canvas.height() / 2; y < canvas.height() * 7 / 10 && explorer().muscle().empty(); y += 6)
    for (int x = canvas.width() / 4; x < canvas.width() * 3 / 4 && explorer().muscle().empty(); x += 6)
      QTest::mouseClick(&canvas, Qt::LeftButton, {}, {x, y});
  EXPECT_FALSE(explorer().muscle().empty());
  letEventsRun(150);
  EXPECT_NE(find<QLabel>("card_title").text(), "No muscle chosen");
}

TEST_F(ExplorerTour, JointsFollowSliderTypedValuePresetMirrorAndLink) {
  find<QTabWidget>("explorer_left").setCurrentIndex(1);
  letEventsRun(100);
  ASSERT_TRUE(waitUntil([&] { return explorer().rangesAreCurrent(); }, kLimit_ms));
  screenshot("5-joints");
  auto& value = find<QDoubleSpinBox>("value_hip_flexion_r");
  value.setValue(70);
  EXPECT_NEAR(degrees("hip_flexion_r"), 70, 1e-9);
  EXPECT_EQ(degrees("hip_flexion_l"), 0);
  auto& slider = find<RangeSlider>("slider_hip_flexion_r");
  EXPECT_EQ(slider.value(), 700);
  slider.setFocus();
  QTest::keyClick(&slider, Qt::Key_Right);
  EXPECT_NEAR(degrees("hip_flexion_r"), 71, 1e-9);
  ASSERT_TRUE(waitUntil([&] { return explorer().rangesAreCurrent(); }, kLimit_ms));
  EXPECT_FALSE(find<QLabel>("range_knee_flexion_r").text().isEmpty());
  screenshot("6-straight-leg-raise");

  click("mirror_posture");
  EXPECT_NEAR(degrees("hip_flexion_l"), 71, 1e-9);
  EXPECT_NEAR(degrees("hip_flexion_r"), 0, 1e-9);
  click("link_sides");
  value.setValue(20);
  EXPECT_NEAR(degrees("hip_flexion_l"), 20, 1e-9);
  click("reset_posture");
  EXPECT_EQ(explorer().clinical().norm(), 0);
  takePosture("Squat");
  screenshot("7-squat");
}

TEST_F(ExplorerTour, ColoursSayActivationLengthAndForce) {
  takePosture("Straight-leg raise, right");
  explorer().setMuscle("semitendinosus_r");
  choose("explorer_colouring", int(MuscleColouring::FiberLength));
  click("explorer_view_side");
  screenshot("8-fibre-length");
  choose("explorer_colouring", int(MuscleColouring::PassiveForce));
  screenshot("9-passive-force");
  auto& target = find<QComboBox>("activation_target");
  target.setCurrentIndex(target.findText("All for knee extension, right"));
  find<QSlider>("activation_slider").setValue(80);
  EXPECT_EQ(explorer().colouring(), MuscleColouring::Activation);
  letEventsRun(100);
  EXPECT_THAT(find<QLabel>("activation_effect").text().toStdString(), HasSubstr("N m"));
  screenshot("10-activation");
  click("relax_all");
  EXPECT_EQ(*std::ranges::max_element(explorer().activation()), 0);
}

TEST_F(ExplorerTour, TheRangeOfTheHipIsComparedWithABentKnee) {
  find<QTabWidget>("explorer_right").setCurrentIndex(2);
  auto& summary = find<QLabel>("rom_summary");
  ASSERT_TRUE(waitUntil([&] { return summary.text().contains("cells differ"); }, kLimit_ms));
  letEventsRun(300);
  screenshot("11-rom");
  choose("rom_on_body", 2);
  EXPECT_NEAR(degrees("knee_flexion_r"), 90, 1e-9);  // the body stands as the map says
  letEventsRun(300);
  screenshot("12-rom-on-body");
  auto& joint = find<QComboBox>("rom_joint");
  const QString before = find<QLabel>("rom_first_caption").text();
  joint.setCurrentIndex(joint.findText("Shoulder, right"));
  ASSERT_TRUE(waitUntil([&] { return find<QLabel>("rom_first_caption").text() != before; }, kLimit_ms));
  letEventsRun(300);
  screenshot("13-rom-shoulder");
}

/// Not a limit: figures to read. What one step of a drag costs on the GUI thread, and until it is drawn.
TEST_F(ExplorerTour, PrintsTheTimeOfAFrame) {
  find<QTabWidget>("explorer_left").setCurrentIndex(1);
  letEventsRun(300);
  auto& canvas = find<VtkView>("explorer_view_canvas");
  auto& slider = find<RangeSlider>("slider_knee_flexion_r");
  constexpr int kSteps = 20;
  qint64 set_us = 0, frame_us = 0;
  const double cpu_before_ms = threadTime_ms();
  for (int i = 0; i < kSteps; ++i) {
    const int before = canvas.renderCount();
    QElapsedTimer clock;
    clock.start();
    slider.setValue(30 * i + 30);
    set_us += clock.nsecsElapsed() / 1000;
    ASSERT_TRUE(waitUntil([&] { return canvas.renderCount() > before; }, kLimit_ms));
    frame_us += clock.nsecsElapsed() / 1000;
  }
  std::printf("a step of a slider: %.1f ms to set, %.1f ms until drawn, %.1f ms processor time of the GUI thread\n",
              set_us / 1000.0 / kSteps, frame_us / 1000.0 / kSteps, (threadTime_ms() - cpu_before_ms) / kSteps);
  QElapsedTimer clock;
  clock.start();
  explorer().setPosture(explorer().posture());
  std::printf("posture change: %.1f ms\n", clock.nsecsElapsed() / 1e6);
  clock.restart();
  explorer().evaluation();
  std::printf("evaluation: %.1f ms\n", clock.nsecsElapsed() / 1e6);
  waitUntil([&] { return explorer().rangesAreCurrent(); }, kLimit_ms);
  std::printf("ranges of all coordinates, beside the window: %.1f ms\n", clock.nsecsElapsed() / 1e6);
}

}  // namespace
}  // namespace sinew
