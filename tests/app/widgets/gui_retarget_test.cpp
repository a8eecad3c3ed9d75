// The retargeting workspace by hand, with mouse and keyboard, on a real OpenGL window (run under a virtual X server).
// Leaves a screenshot of every state in SINEW_SCREENSHOT_DIR.
#include <QAbstractButton>
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QTabWidget>
#include <QTableView>
#include <QTableWidget>
#include <QTest>
#include <QTimer>
#include <QToolButton>
#include <algorithm>

#include "app/model/retarget/rom_handles.h"
#include "app/widgets/controls/range_bar.h"
#include "app/widgets/controls/range_slider.h"
#include "app/widgets/retarget/body_view.h"
#include "app/widgets/retarget/change_table.h"
#include "app/widgets/retarget/characters_view.h"
#include "app/widgets/retarget/retarget_page.h"
#include "app/widgets/retarget/rom_edit_panel.h"
#include "app/widgets/retarget/rom_edit_view.h"
#include "app/widgets/views/edit_sphere.h"
#include "app/widgets/views/model_view.h"
#include "app/widgets/views/vtk_view.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/retarget.h"
#include "tests/app/widgets/window_tour.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using test::letEventsRun;
using test::threadTime_ms;
using test::waitUntil;
using ::testing::HasSubstr;

constexpr int kLimit_ms = 180'000;  // processor time: a software renderer beside the work

/// The reference takes seconds to prepare: once for all tests.
std::shared_ptr<const RetargetReference> sharedReference() {
  static const auto reference = loadRetargetReference(test::resourceDir());
  return reference;
}

class RetargetTour : public test::WindowTour {
 protected:
  RetargetTour() {
    page().solver().load(sharedReference);
    click("welcome_retarget");
    settle();
    letEventsRun(200);
  }

  RetargetPage& page() { return find<RetargetPage>("retarget_page"); }
  const RetargetDesign& design() { return page().document().current(); }
  void trigger(const QString& action) { find<QAction>(action).trigger(); }
  void settle() {
    ASSERT_TRUE(waitUntil(
        [&] { return page().solver().isCurrent() && page().solver().body()->design == page().document().current(); },
        kLimit_ms))
        << page().solver().problem().toStdString();
    letEventsRun(150);
  }
  void drag(QWidget& widget, const QPoint& from, const QPoint& to, int steps = 6) {
    QTest::mousePress(&widget, Qt::LeftButton, {}, from);
    for (int i = 1; i <= steps; ++i) {
      QMouseEvent move{QEvent::MouseMove,
                       QPointF{from + (to - from) * i / steps},
                       QPointF{widget.mapToGlobal(from + (to - from) * i / steps)},
                       Qt::NoButton,
                       Qt::LeftButton,
                       Qt::NoModifier};
      QApplication::sendEvent(&widget, &move);
      letEventsRun(15);
    }
    QTest::mouseRelease(&widget, Qt::LeftButton, {}, to);
  }

  test::TemporaryFolder folder_;
  void screenshot(const QString& name) { WindowTour::screenshot("retarget-" + name, test::usualSizes()); }
};

TEST_F(RetargetTour, PresetsAreRetargetedRankedAndCompared) {
  EXPECT_FALSE(workspace_.document().isOpen());  // no case is needed
  screenshot("1-open");
  trigger("preset_alien");
  settle();
  EXPECT_EQ(design().body.name, "alien");
  EXPECT_THAT(find<QLabel>("retarget_state").text().toStdString(), HasSubstr("Retargeted muscles"));
  auto& list = find<QTableView>("change_list");
  ASSERT_EQ(list.model()->rowCount(), int(sharedReference()->model().musculature.units.size()));
  // Ranked: the largest change of function stands first, and retargeting takes most of it away.
  const auto energy = [&](int row, int column) {
    return list.model()->index(row, column).data(Qt::UserRole).toDouble();
  };
  EXPECT_GE(energy(0, ChangeTable::Naive), energy(10, ChangeTable::Naive));
  EXPECT_LT(energy(0, ChangeTable::Retargeted), energy(0, ChangeTable::Naive));
  QTest::mouseClick(list.viewport(), Qt::LeftButton, {}, list.visualRect(list.model()->index(0, 0)).center());
  EXPECT_FALSE(page().bodyView().muscle().empty());
  letEventsRun(200);
  EXPECT_NE(find<QLabel>("family_title").text(), "No muscle chosen");
  screenshot("2-alien");
  find<QComboBox>("retarget_colouring").setCurrentIndex(1);
  letEventsRun(150);
  screenshot("3-alien-change");
  find<QComboBox>("retarget_colouring").setCurrentIndex(0);
  trigger("preset_hulk");
  settle();
  auto& search = find<QLineEdit>("retarget_search");
  QTest::keyClicks(&search, "deltoid");
  EXPECT_GT(list.model()->rowCount(), 0);
  EXPECT_LT(list.model()->rowCount(), 40);
  QTest::keyClick(&search, Qt::Key_Return);
  EXPECT_THAT(page().bodyView().muscle(), HasSubstr("deltoid"));
  letEventsRun(150);
  screenshot("4-hulk");
  click("undo_button");
  EXPECT_EQ(design().body.name, "alien");
  click("redo_button");
  EXPECT_EQ(design().body.name, "hulk");
  settle();
}

TEST_F(RetargetTour, ASliderMovesTheBonesAtOnceAndTheMusclesWhenItIsLetGo) {
  auto& slider = find<RangeSlider>("slider_femur_r_elongation");
  auto& canvas = find<VtkView>("retarget_view_canvas");
  const int drawn = canvas.renderCount();
  drag(slider, {slider.width() / 2, 11}, {slider.width() * 3 / 4, 11});
  const double elongation = design().body.shape.sides[0].femur.elongation;
  EXPECT_GT(elongation, 1.1);
  EXPECT_EQ(design().body.shape.sides[1].femur.elongation, elongation);  // linked
  settle();
  EXPECT_GT(canvas.renderCount(), drawn);
  click("undo_button");  // one step, whatever the number of moves
  EXPECT_EQ(design().body.shape, ShapeParameters{});

  click("link_shape_sides");
  find<QDoubleSpinBox>("value_femur_r_elongation").setValue(1.25);
  find<QDoubleSpinBox>("value_tibia_r_torsion").setValue(25);
  find<QDoubleSpinBox>("value_humerus_l_elongation").setValue(0.7);
  settle();
  EXPECT_EQ(design().body.shape.sides[1].femur.elongation, 1);
  page().bodyView().setMuscle("rectus_femoris_r");
  letEventsRun(200);
  screenshot("5-asymmetrical");
  click("link_shape_sides");  // on again: the left side takes the right one's shape
  EXPECT_EQ(design().body.shape.sides[1].femur.elongation, 1.25);
  settle();
}

TEST_F(RetargetTour, MassesAndStrengthsFollowTheirFactors) {
  trigger("preset_dwarf");
  settle();
  find<QTabWidget>("retarget_left").setCurrentIndex(1);
  auto& name = find<QComboBox>("strength_name");
  name.setCurrentIndex(name.findData("quadriceps"));
  click("strength_add");
  find<QDoubleSpinBox>("strength_quadriceps").setValue(1.5);
  EXPECT_EQ(design().body.physics.strength_factors.at("quadriceps"), 1.5);
  EXPECT_EQ(find<QComboBox>("mass_rule_femur").currentIndex(), 2);
  settle();
  EXPECT_THAT(find<QLabel>("whole_mass").text().toStdString(), HasSubstr("kg"));
  screenshot("6-factors");
  answerFileDialog(folder_ / "body.json");
  trigger("save_body");
  EXPECT_EQ(loadBodyDescription(folder_ / "body.json").physics, design().body.physics);
  answerFileDialog(folder_ / "model.json");
  trigger("save_model");
  ASSERT_TRUE(waitUntil([&] { return std::filesystem::exists(folder_ / "model.json"); }, kLimit_ms));
  const Model saved = loadModel(folder_ / "model.json", sharedReference()->model());
  EXPECT_EQ(saved.shape, design().body.shape);
  for (const char* exported : {"model.xml", "model.osim"}) {
    answerFileDialog(folder_ / exported);
    trigger("export_model");
    EXPECT_TRUE(waitUntil([&] { return std::filesystem::exists(folder_ / exported); }, kLimit_ms)) << exported;
  }
}

TEST_F(RetargetTour, TheRangeOfTheHipIsEditedOnItsSphere) {
  find<QTabWidget>("retarget_left").setCurrentIndex(2);
  auto& sphere = find<EditSphere>("rom_wanted");
  ASSERT_TRUE(waitUntil([&] { return sphere.hasMap(); }, kLimit_ms));
  letEventsRun(400);
  screenshot("7-rom-before");
  auto& canvas = find<VtkView>("rom_wanted_canvas");
  const auto pixel = [&](const Eigen::Vector3d& direction_J) {
    const Eigen::Vector2d at = sphere.scene()->pixelOf(direction_J);
    return QPoint{int(at.x()), int(canvas.height() - at.y())};
  };
  const auto& study = find<RomEditView>("rom_edit_view").study();
  const BallRange before = study.picture()->ball_before;
  const Eigen::Vector3d border_J = sphere.scene()->borderHandle_J();
  drag(canvas, pixel(border_J), pixel((border_J + 0.6 * before.centre_J).normalized()));
  ASSERT_EQ(design().rom.size(), 1U);
  EXPECT_LT(design().rom[0].cone_factor, 0.9);
  EXPECT_GT(design().rom[0].cone_factor, 0.3);
  settle();
  const Eigen::Vector3d forward_J = (before.centre_J + 0.3 * Eigen::Vector3d::UnitX()).normalized();
  drag(canvas, pixel(before.centre_J), pixel(forward_J));
  EXPECT_GT(design().rom[0].tilt.angle_rad, 0.1);
  settle();
  ASSERT_TRUE(
      waitUntil([&] { return study.picture()->reached && find<QLabel>("rom_edit_error").text().contains("differ"); },
                kLimit_ms));
  letEventsRun(300);
  EXPECT_GT(find<QTableWidget>("rom_changes").rowCount(), 5);
  screenshot("8-rom-edited");
  auto& twist = find<RangeBar>("rom_twist_bar");
  twist.setFocus();
  for (int i = 0; i < 3; ++i) QTest::keyClick(&twist, Qt::Key_Left, Qt::ShiftModifier);
  EXPECT_LT(design().rom[0].twist_factor, 1);
  find<RomEditPanel>("rom_edit_panel").chooseJoint("knee_r");
  letEventsRun(300);
  find<QDoubleSpinBox>("rom_range").setValue(0.7);
  settle();
  letEventsRun(400);
  screenshot("9-rom-knee");
  answerFileDialog(folder_ / "ranges.json");
  click("rom_save");
  const RomEdits kept = design().rom;
  click("rom_reset_all");
  EXPECT_TRUE(design().rom.empty());
  answerFileDialog(folder_ / "ranges.json");
  click("rom_load");
  ASSERT_EQ(design().rom.size(), kept.size());
  EXPECT_EQ(design().rom[1].range_factor, kept[1].range_factor);
  settle();
}

TEST_F(RetargetTour, TheCharactersStandSideBySide) {
  click("characters_button");
  auto& view = find<CharactersView>("characters_view");
  ASSERT_TRUE(waitUntil([&] { return !view.picture().isNull() && !view.isBusy(); }, kLimit_ms));
  letEventsRun(200);
  screenshot("10-characters");
  answerFileDialog(folder_ / "characters.png");
  click("characters_save");
  EXPECT_EQ(QImage{QString::fromStdString((folder_ / "characters.png").string())}.size(), view.picture().size());
}

TEST_F(RetargetTour, IsReachedFromEverywhereAndLeftAgain) {
  click("retarget_close");
  EXPECT_TRUE(find<QWidget>("welcome_page").isVisible());
  letEventsRun(100);
  screenshot("0-welcome");
  QTest::keyClick(&window_, Qt::Key_T, Qt::ControlModifier);
  EXPECT_TRUE(page().isVisible());
  QTest::keyClick(&window_, Qt::Key_M, Qt::ControlModifier);
  EXPECT_FALSE(page().isVisible());
  click("open_retargeting");
  EXPECT_TRUE(page().isVisible());
  // Undo belongs to what is looked at.
  trigger("preset_child");
  EXPECT_TRUE(find<QAbstractButton>("undo_button").isEnabled());
  click("retarget_close");
  EXPECT_FALSE(find<QAbstractButton>("undo_button").isEnabled());
  click("open_retargeting");
  settle();
}

TEST_F(RetargetTour, ACancelledSolutionLeavesTheNaiveMuscles) {
  trigger("preset_alien");
  ASSERT_TRUE(waitUntil([&] { return page().solver().isSolving(); }, kLimit_ms));
  click("retarget_cancel");
  ASSERT_TRUE(waitUntil([&] { return !page().solver().isSolving(); }, kLimit_ms));
  EXPECT_FALSE(page().solver().isCurrent());
  EXPECT_THAT(find<QLabel>("retarget_state").text().toStdString(), HasSubstr("Cancelled"));
  EXPECT_EQ(page().solver().naive()->shape, design().body.shape);
  find<QDoubleSpinBox>("value_neck_elongation").setValue(1.9);
  settle();
}

TEST_F(RetargetTour, ThePictureIsSmoothAgainAfterADrag) {
  auto& canvas = find<VtkView>("retarget_view_canvas");
  auto& slider = find<RangeSlider>("slider_femur_r_elongation");
  ASSERT_TRUE(waitUntil([&] { return canvas.isSmooth(); }, kLimit_ms));
  letEventsRun(500);
  const QImage before = canvas.grabFramebuffer();
  const int start = slider.value();
  slider.setSliderDown(true);
  for (const int value : {start + 20, start + 40, start + 20, start}) {
    slider.setValue(value);
    letEventsRun(30);
  }
  slider.setSliderDown(false);
  settle();
  ASSERT_TRUE(waitUntil([&] { return canvas.isSmooth(); }, kLimit_ms));
  letEventsRun(500);
  EXPECT_EQ(canvas.grabFramebuffer(), before);
}

/// Not limits: figures to read.
TEST_F(RetargetTour, PrintsTheTimesOfADragAndOfASolution) {
  auto& canvas = find<VtkView>("retarget_view_canvas");
  auto& slider = find<RangeSlider>("slider_femur_r_elongation");
  constexpr int kSteps = 15;
  double set_ms = 0, longest_set_ms = 0, drawn_ms = 0, naive_ms = 0, blocked_ms = 0;
  const double cpu_before_ms = threadTime_ms();
  slider.setSliderDown(true);
  for (int i = 0; i < kSteps; ++i) {
    const int before = canvas.renderCount();
    const auto shown = page().solver().naive();
    QElapsedTimer clock;
    clock.start();
    slider.setValue(20 * i + 20);
    const double this_ms = double(clock.nsecsElapsed()) / 1e6;
    set_ms += this_ms;
    longest_set_ms = std::max(longest_set_ms, this_ms);
    double last_ms = this_ms;
    ASSERT_TRUE(waitUntil(
        [&] {
          const double now_ms = double(clock.nsecsElapsed()) / 1e6;
          blocked_ms = std::max(blocked_ms, now_ms - last_ms);
          last_ms = now_ms;
          return page().solver().naive() != shown && canvas.renderCount() > before;
        },
        kLimit_ms));
    drawn_ms += double(clock.nsecsElapsed()) / 1e6;
    naive_ms += 1000 * page().solver().naive_s();
  }
  std::printf("processor time of the GUI thread: %.1f ms a step\n", (threadTime_ms() - cpu_before_ms) / kSteps);
  slider.setSliderDown(false);
  QElapsedTimer clock;
  clock.start();
  settle();
  std::printf(
      "a step of a shape slider: %.1f ms to set (longest %.1f), %.1f ms to deform, %.1f ms until drawn; "
      "longest round of the GUI thread %.1f ms\n",
      set_ms / kSteps, longest_set_ms, naive_ms / kSteps, drawn_ms / kSteps, blocked_ms);
  std::printf("solution of long thighs: %.2f s, on the screen %.2f s after the slider was let go\n",
              page().solver().body()->solve_s, double(clock.elapsed()) / 1000);
}

}  // namespace
}  // namespace sinew
