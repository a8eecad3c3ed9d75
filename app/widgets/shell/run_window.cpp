#include "app/widgets/shell/run_window.h"

#include <QApplication>
#include <QScreen>
#include <QSurfaceFormat>
#include <QTimer>
#include <cstdio>

#include "app/model/workspace.h"
#include "app/plot/gui_application.h"
#include "app/widgets/controls/theme.h"
#include "app/widgets/shell/main_window.h"
#include "app/widgets/stages/report_pages.h"
#include "app/widgets/views/vtk_view.h"
#include "core/error.h"

namespace sinew {

int runWindow(int argc, char** argv, const std::filesystem::path& resource_dir) {
  if (argc > 1 && !std::filesystem::is_regular_file(std::filesystem::path{argv[1]} / "case.json"))
    throw InputError{{argv[1], "case folder", "a folder with case.json", "none"}};
  QSurfaceFormat::setDefaultFormat(VtkView::defaultFormat());
  QApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
  QApplication application{argc, argv};
  useDecimalPoints();
  QApplication::setApplicationName("Sinew");
  QApplication::setQuitOnLastWindowClosed(true);
  try {
    installTheme(application, resource_dir);
    Workspace workspace{resource_dir, printReport};
    MainWindow window{workspace, renderReportPages};
    const QSize screen = application.primaryScreen()->availableSize();
    window.resize(std::min(1680, screen.width()), std::min(1020, screen.height()));
    window.show();
    if (argc > 1) workspace.openCase(argv[1]);
    return QApplication::exec();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sinew: %s\n", error.what());
    return 1;
  }
}

}  // namespace sinew
