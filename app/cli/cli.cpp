#include "app/cli/cli.h"

#include <spdlog/spdlog.h>

#include <exception>
#include <filesystem>

#include "app/cli/support/commands.h"
#include "app/cli/support/resource_folder.h"
#include "core/text.h"
#include "core/version.h"

namespace sinew {
namespace {

constexpr const char* kAbout =
    "Sinew builds one patient's musculoskeletal model from two calibrated radiographs and a physical examination.\n"
    "Without arguments it opens the window; `sinew window CASE` opens it with a case.";
constexpr const char* kExample =
    "Exit status: 0 done; 2 unusable input or usage; 3 did not converge or was cancelled; 1 a fault of ours.\n"
    "Example:\n  sinew demo --out demo && sinew status demo\n\n"
    "Research use only - not a medical device, not a basis for treatment.";

std::vector<std::string> commandNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const auto* sub : app.get_subcommands([](const CLI::App*) { return true; })) names.push_back(sub->get_name());
  return names;
}

/// The command of `parent` that `word` names. @throws InputError with the nearest ones.
const CLI::App* commandNamed(const CLI::App& parent, const std::string& word, const std::string& where) {
  const auto names = commandNames(parent);
  for (const auto* sub : parent.get_subcommands([](const CLI::App*) { return true; }))
    if (sub->get_name() == word) return sub;
  throw InputError{
      {where, "command", "a command of '" + where + " --help'", "'" + word + "'" + didYouMean(word, names)}};
}

/// "sinew rig info"
std::string fullName(const CLI::App& command) {
  const auto* parent = command.get_parent();
  return parent == nullptr ? command.get_name() : fullName(*parent) + " " + command.get_name();
}

/// The chain of commands that the arguments name, as far as it is a chain.
const CLI::App* deepestCommand(const CLI::App& app, int argc, const char* const* argv) {
  const CLI::App* command = &app;
  std::string where = "sinew";
  for (int i = 1; i < argc && !commandNames(*command).empty(); ++i) {
    const std::string word = argv[i];
    if (word == "--resources") ++i;
    if (word.starts_with("-")) continue;
    command = commandNamed(*command, word, where);
    where += " " + word;
  }
  return command;
}

/// An option that nobody knows, answered with the nearest; nullopt if all are known.
std::optional<InputError::Detail> unknownOption(const CLI::App& command, int argc, const char* const* argv) {
  std::vector<std::string> known;
  for (const auto* app = &command; app != nullptr; app = app->get_parent())
    for (const auto* option : app->get_options())
      for (const auto& name : option->get_lnames()) known.push_back("--" + name);
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const std::string name = word.substr(0, word.find('='));
    if (!name.starts_with("--") || name == "--" || std::ranges::find(known, name) != known.end()) continue;
    return InputError::Detail{fullName(command), "option", "an option of --help",
                              "'" + name + "'" + didYouMean(name, known)};
  }
  return std::nullopt;
}

void addGlobalOptions(CLI::App& app, GlobalOptions& options) {
  app.add_flag("--json", options.json, "print exactly one JSON document on stdout");
  app.add_flag("-q,--quiet", options.quiet, "no progress and no warnings on stderr");
  app.add_flag("-v,--verbose", options.verbose, "diagnostics on stderr");
  app.add_option("--resources", options.resources, "folder of the reference data (default: beside the program)");
  app.set_version_flag("--version", std::string{"sinew "} + kVersion);
}

void addCommands(Commands& commands) {
  addRunCommands(commands);
  addNewCommand(commands);
  addPatientCommand(commands);
  addStatusCommand(commands);
  addRigCommands(commands);
  addTriangulateCommand(commands);
  addFitCommand(commands);
  addExamCommand(commands);
  addModelCommands(commands);
  addEvaluateCommand(commands);
  addCurveCommand(commands);
  addRomCommand(commands);
  addRetargetCommand(commands);
  addExperimentCommand(commands);
  addRomEditCommand(commands);
  addExportCommand(commands);
  addImportCommand(commands);
  addBenchCommand(commands);
  addRomTestsCommand(commands);
  addPosesCommands(commands);
  // Listed in the help; app/main.cpp opens the window.
  auto& window =
      addCommand(commands.app, "window", "open the window, with a case if one is named", "sinew window mycase");
  window.add_option("CASE", "case folder");
  window.callback([&commands] {
    commands.chosen = []() -> ExitStatus {
      throw InputError{{"sinew window", "", "'window' as the first word", "options before it"}};
    };
  });
}

ExitStatus parseAndRun(Session& session, int argc, const char* const* argv) {
  CLI::App app{kAbout, "sinew"};
  app.footer(kExample);
  app.require_subcommand(1);
  app.fallthrough();
  addGlobalOptions(app, session.options);
  Commands commands{app, session, {}};
  addCommands(commands);
  // Known before parsing, so that usage errors come in the form that was asked for.
  for (int i = 1; i < argc; ++i) session.options.json = session.options.json || std::string_view{argv[i]} == "--json";
  try {
    const CLI::App* command = nullptr;
    try {
      app.parse(argc, argv);
    } catch (const CLI::Success& help) {
      app.exit(help);
      return ExitStatus::Done;
    } catch (const CLI::ParseError& error) {
      command = deepestCommand(app, argc, argv);
      if (const auto unknown = unknownOption(*command, argc, argv)) throw InputError{*unknown};
      throw InputError{{fullName(*command), "", "usage as in '" + fullName(*command) + " --help'", error.what()}};
    }
    session.start();
    return commands.chosen();
  } catch (const InputError& error) {
    session.failure(error.detail(), error.what());
    return ExitStatus::Unusable;
  } catch (const std::filesystem::filesystem_error& error) {  // a disk that is full or not ours is no fault of ours
    const InputError refused{{error.path1().string(), "", "a folder that can be written", error.code().message()}};
    session.failure(refused.detail(), refused.what());
    return ExitStatus::Unusable;
  }
}

}  // namespace

CLI::App& addCommand(CLI::App& parent, const std::string& name, const std::string& description,
                     const std::string& example) {
  CLI::App* command = parent.add_subcommand(name, description);
  command->footer("With every command: --json, --quiet, --verbose, --resources DIR (see sinew --help)\nExample:\n  " +
                  example);
  command->fallthrough();
  return *command;
}

int runCli(int argc, const char* const* argv, ReportWriter write_report) {
  Session session{executablePath(), std::move(write_report)};
  try {
    return static_cast<int>(parseAndRun(session, argc, argv));
  } catch (const std::exception& fault) {
    session.failure({"sinew", "", "", ""}, std::string{"internal error: "} + fault.what());
  } catch (...) {
    session.failure({"sinew", "", "", ""}, "internal error");
  }
  return static_cast<int>(ExitStatus::Fault);
}

}  // namespace sinew
