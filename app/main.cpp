// Boots: without arguments, or with `window`, the window; with any other command the headless command line.
#include <cstdio>
#include <string_view>

#include "app/cli/cli.h"
#include "app/cli/support/exit_status.h"
#include "app/cli/support/resource_folder.h"
#include "app/report/report_pdf.h"
#include "app/widgets/shell/run_window.h"
#include "core/error.h"

namespace {

int openWindow(int argc, char** argv) {
  try {
    return sinew::runWindow(argc, argv, sinew::findResourceFolder(sinew::executablePath(), {}));
  } catch (const sinew::InputError& error) {
    std::fprintf(stderr, "sinew: %s\n", error.what());
    return static_cast<int>(sinew::ExitStatus::Unusable);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 1) return openWindow(argc, argv);
  const bool asks_for_help = argc > 2 && std::string_view{argv[2]}.starts_with("-");
  if (std::string_view{argv[1]} == "window" && !asks_for_help) return openWindow(argc - 1, argv + 1);
  const sinew::ReportWriter write_report = [](const auto& c, const auto& case_dir, const auto& pdf,
                                              const auto& reference, const auto& resource_dir) {
    sinew::writeReportPdf(c, case_dir, pdf, reference, resource_dir);
  };
  return sinew::runCli(argc, argv, write_report);
}
