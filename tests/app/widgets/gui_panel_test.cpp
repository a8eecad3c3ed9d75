// Views and panels on the "offscreen" platform: no display, no OpenGL.
#include <gtest/gtest.h>

#include <QApplication>
#include <QMouseEvent>
#include <QSignalSpy>
#include <QTest>
#include <QWheelEvent>

#include "app/widgets/controls/curve_plot.h"
#include "app/widgets/controls/theme.h"
#include "app/widgets/views/radiograph_pane.h"
#include "app/widgets/views/radiograph_view.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

/// A slope from dark to bright, 800 x 600.
std::shared_ptr<const Radiograph> slope() {
  auto r = std::make_shared<Radiograph>();
  r->width_px = 800;
  r->height_px = 600;
  r->window_center = 400;
  r->window_width = 800;
  auto pixels = std::make_shared<std::vector<std::uint16_t>>();
  for (int v = 0; v < 600; ++v)
    for (int u = 0; u < 800; ++u) pixels->push_back(std::uint16_t(u));
  r->pixels = pixels;
  return r;
}

class PanelTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (QApplication::instance()) return;
    qputenv("QT_QPA_PLATFORM", "offscreen");
    static int argc = 1;
    static char name[] = "panel-test";
    static char* argv[] = {name, nullptr};
    auto* const application =
        new QApplication{argc, argv};  // lives as long as the process: Qt's own statics go before
    installTheme(*application, test::resourceDir());
  }
  void SetUp() override {
    view_.resize(400, 300);
    view_.setRadiograph(slope());
    view_.show();
  }
  RadiographView view_;
};

TEST_F(PanelTest, FitShowsTheWholeImage) {
  EXPECT_DOUBLE_EQ(view_.zoom(), 0.5);
  const QPointF corner = view_.toWidget({-0.5, -0.5});  // outer corner of the top-left pixel
  EXPECT_NEAR(corner.x(), 0, 1e-9);
  EXPECT_NEAR(corner.y(), 0, 1e-9);
}

TEST_F(PanelTest, ImageAndWidgetCoordinatesAreInverse) {
  view_.zoomTo({123.25, 77.5}, 3.7);
  const QPointF there = view_.toWidget({200, 100});
  EXPECT_NEAR(view_.toImage(there).x(), 200, 1e-9);
  EXPECT_NEAR(view_.toImage(there).y(), 100, 1e-9);
}

TEST_F(PanelTest, TheWheelKeepsThePointUnderTheCursor) {
  const QPointF cursor{90, 60};
  const QPointF before = view_.toImage(cursor);
  QWheelEvent wheel{cursor,         view_.mapToGlobal(cursor), {},   {0, 360}, Qt::NoButton,
                    Qt::NoModifier, Qt::NoScrollPhase,         false};
  QApplication::sendEvent(&view_, &wheel);
  EXPECT_GT(view_.zoom(), 0.5);
  EXPECT_NEAR(view_.toImage(cursor).x(), before.x(), 1e-9);
  EXPECT_NEAR(view_.toImage(cursor).y(), before.y(), 1e-9);
}

TEST_F(PanelTest, AClickPlacesWhereItIsAndADragOnFreeGroundDoesNot) {
  view_.setTool(RadiographView::Tool::Place);
  QSignalSpy placed{&view_, &RadiographView::placed};
  QTest::mouseClick(&view_, Qt::LeftButton, {}, {100, 50});
  ASSERT_EQ(placed.size(), 1);
  const QPointF uv_px = placed[0][0].toPointF();
  EXPECT_NEAR(uv_px.x(), 100 / 0.5 - 0.5, 1e-9);
  EXPECT_NEAR(uv_px.y(), 50 / 0.5 - 0.5, 1e-9);

  const QPointF before = view_.toImage({0, 0});
  QTest::mousePress(&view_, Qt::LeftButton, {}, {100, 50});
  QTest::mouseMove(&view_, {130, 50});
  QTest::mouseRelease(&view_, Qt::LeftButton, {}, {130, 50});
  EXPECT_EQ(placed.size(), 1);
  EXPECT_NEAR(view_.toImage({0, 0}).x(), before.x() - 60, 1e-9);  // 30 logical pixels at half size
}

TEST_F(PanelTest, AMarkFollowsTheHandAndIsDroppedOnce) {
  view_.setMarks({{"asis_r", {200, 100}, Qt::red, false, {}}}, "asis_r");
  QSignalSpy dragged{&view_, &RadiographView::markDragged}, dropped{&view_, &RadiographView::markDropped};
  const QPoint at = view_.toWidget({200, 100}).toPoint();
  QTest::mousePress(&view_, Qt::LeftButton, {}, at);
  QTest::mouseMove(&view_, at + QPoint{5, 0});
  QTest::mouseMove(&view_, at + QPoint{10, 4});
  QTest::mouseRelease(&view_, Qt::LeftButton, {}, at + QPoint{10, 4});
  EXPECT_GE(dragged.size(), 2);
  ASSERT_EQ(dropped.size(), 1);
  EXPECT_NEAR(dropped[0][1].toPointF().x(), 220, 1e-6);  // 10 logical pixels at half size
  EXPECT_NEAR(dropped[0][1].toPointF().y(), 108, 1e-6);
}

TEST_F(PanelTest, RightDragWidensTheWindowAndInversionTurnsTheGreys) {
  QSignalSpy changed{&view_, &RadiographView::displayChanged};
  QTest::mousePress(&view_, Qt::RightButton, {}, {100, 100});
  QTest::mouseMove(&view_, {160, 100});
  QTest::mouseRelease(&view_, Qt::RightButton, {}, {160, 100});
  ASSERT_GE(changed.size(), 1);
  EXPECT_GT(view_.windowWidth(), 800);
  EXPECT_NEAR(view_.windowCenter(), 400, 1e-9);

  view_.setDisplay({});
  const QImage plain = view_.grab().toImage();
  view_.setDisplay({{}, {}, true});
  const QImage inverted = view_.grab().toImage();
  EXPECT_LT(qGray(plain.pixel(40, 100)), 60);  // left of the slope: dark
  EXPECT_GT(qGray(inverted.pixel(40, 100)), 195);
}

TEST_F(PanelTest, TheRangeOfGreysIgnoresTheTails) {
  const auto [low, high] = greyRange(*slope(), 0.25, 0.75);
  EXPECT_NEAR(low, 200, 4);  // the slope holds every grey equally often; every seventh pixel is counted
  EXPECT_NEAR(high, 600, 4);
}

}  // namespace
}  // namespace sinew
