#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QStringList>
#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "app/model/workspace.h"
#include "app/widgets/shell/main_window.h"
#include "app/widgets/stages/report_page.h"
#include "tests/app/gui_support.h"

namespace sinew::test {

/// Processor time of this thread: what a loaded machine does not change.
double threadTime_ms();

/// The window by hand, with mouse and keyboard, on a real OpenGL display. Any problem that the window tells fails the
/// test.
class WindowTour : public ::testing::Test {
 protected:
  explicit WindowTour(Workspace::ReportWriter write_report = {}, ReportStagePage::Renderer render_report = {});
  ~WindowTour() override;

  /// The control of a name; of several (radiographs of all pages share theirs) the one that is seen.
  template <class T>
  T& find(const QString& object_name) {
    const auto all = window_.findChildren<T*>(object_name);
    if (all.isEmpty()) throw std::runtime_error{"no control " + object_name.toStdString()};
    const auto seen = std::ranges::find_if(all, [](const T* control) {
      if constexpr (std::is_base_of_v<QWidget, T>) return control->isVisible();
      return true;
    });
    return seen == all.end() ? *all.front() : **seen;
  }
  void click(const QString& object_name);
  /// Answers the next file dialog with a path, as a person who types it.
  void answerFileDialog(const std::filesystem::path& path);
  /// NAME-WIDTHxHEIGHT.png of the window in SINEW_SCREENSHOT_DIR, in every one of the sizes.
  void screenshot(const QString& name, const std::vector<QSize>& sizes);

  Workspace workspace_;
  MainWindow window_;
  QStringList problems_;
};

/// 1280 x 800, and with SINEW_ALL_SIZES set a large one as well.
std::vector<QSize> usualSizes();

}  // namespace sinew::test
