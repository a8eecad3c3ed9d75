#include "tests/app/widgets/window_tour.h"

#include <QApplication>
#include <QDir>
#include <QFileDialog>
#include <QLineEdit>
#include <QSurfaceFormat>
#include <QTest>
#include <QTimer>
#include <ctime>

#include "app/widgets/controls/theme.h"
#include "app/widgets/views/vtk_view.h"
#include "tests/support/resources.h"

namespace sinew::test {

double threadTime_ms() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * double(t.tv_sec) + 1e-6 * double(t.tv_nsec);
}

std::vector<QSize> usualSizes() {
  std::vector<QSize> sizes{{1280, 800}};
  if (qEnvironmentVariableIsSet("SINEW_ALL_SIZES")) sizes.push_back({1600, 1000});
  return sizes;
}

WindowTour::WindowTour(Workspace::ReportWriter write_report, ReportStagePage::Renderer render_report)
    : workspace_{resourceDir(), std::move(write_report)}, window_{workspace_, std::move(render_report)} {
  window_.resize(1280, 800);
  window_.show();
  EXPECT_TRUE(QTest::qWaitForWindowExposed(&window_));
  QApplication::setActiveWindow(&window_);  // there is no window manager to do it
  QObject::connect(&workspace_, &Workspace::problem, [this](const QString& message) { problems_ << message; });
}

WindowTour::~WindowTour() {
  EXPECT_THAT(problems_, ::testing::IsEmpty()) << problems_.join("; ").toStdString();
}

void WindowTour::click(const QString& object_name) {
  auto& button = find<QAbstractButton>(object_name);
  EXPECT_TRUE(button.isVisible() && button.isEnabled()) << object_name.toStdString();
  QTest::mouseClick(&button, Qt::LeftButton, {}, button.rect().center());
}

void WindowTour::answerFileDialog(const std::filesystem::path& path) {
  QTimer::singleShot(300, [path] {
    auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
    ASSERT_NE(dialog, nullptr);
    dialog->findChild<QLineEdit*>("fileNameEdit")->setText(QString::fromStdString(path.string()));
    QMetaObject::invokeMethod(dialog, "accept");
  });
}

void WindowTour::screenshot(const QString& name, const std::vector<QSize>& sizes) {
  const QDir folder{SINEW_SCREENSHOT_DIR};
  folder.mkpath(".");
  for (const QSize size : sizes) {
    window_.resize(size);
    letEventsRun(250);
    ASSERT_TRUE(
        window_.grab().save(folder.filePath(QString{"%1-%2x%3.png"}.arg(name).arg(size.width()).arg(size.height()))));
  }
  window_.resize(1280, 800);
  letEventsRun(150);
}

}  // namespace sinew::test

int main(int argc, char** argv) {
  ::testing::InitGoogleMock(&argc, argv);
  QSurfaceFormat::setDefaultFormat(sinew::VtkView::defaultFormat());
  QApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
  QApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
  QApplication application{argc, argv};
  sinew::installTheme(application, sinew::test::resourceDir());
  return RUN_ALL_TESTS();
}
