#include "app/plot/gui_application.h"

#include <QDir>
#include <QFile>
#include <QGuiApplication>
#include <clocale>

#include "core/error.h"

namespace sinew {
namespace {

/// Qt complains on stderr when no login session made a folder for sockets; nothing here needs one.
void provideRuntimeFolder() {
  if (!qEnvironmentVariableIsEmpty("XDG_RUNTIME_DIR")) return;
  const QString folder = QDir::tempPath() + "/runtime-" + qEnvironmentVariable("USER", "sinew");
  QDir{}.mkpath(folder);
  QFile::setPermissions(folder, QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
  qputenv("XDG_RUNTIME_DIR", QFile::encodeName(folder));
}

}  // namespace

void useDecimalPoints() {
  std::setlocale(LC_NUMERIC, "C");
}

void haveGuiApplication() {
  if (QCoreApplication::instance()) {
    require(qobject_cast<QGuiApplication*>(QCoreApplication::instance()) != nullptr,
            "drawing needs a QGuiApplication; this program made a QCoreApplication");
    return;
  }
  provideRuntimeFolder();
  static int argument_count = 3;
  static char name[] = "sinew", option[] = "-platform", platform[] = "offscreen";
  static char* arguments[] = {name, option, platform, nullptr};
  static auto* const application = new QGuiApplication{argument_count, arguments};
  Q_UNUSED(application);
  useDecimalPoints();
}

}  // namespace sinew
