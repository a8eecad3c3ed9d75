#include <unistd.h>

#include <memory>

#include "app/cli/support/commands.h"
#include "app/cli/support/resource_folder.h"

namespace sinew {
namespace {

struct BenchCommandOptions {
  std::vector<int> rows;
  std::string windows, window_s, out;
};

/// Becomes sinew-bench, which is a program of its own so that this one does not load what it compares with.
ExitStatus becomeBench(const BenchCommandOptions& o, Session& session) {
  const auto program = executablePath().parent_path() / "sinew-bench";
  if (!std::filesystem::exists(program))
    throw InputError{
        {"sinew bench", "", program.string() + " (built where Google Benchmark is installed)", "nothing"}};
  std::vector<std::string> arguments = {program.string(), "--resources", session.resourceDir().string()};
  for (const int row : o.rows) arguments.insert(arguments.end(), {"--row", std::to_string(row)});
  const auto pass = [&](const std::string& option, const std::string& value) {
    if (!value.empty()) arguments.insert(arguments.end(), {option, value});
  };
  pass("--windows", o.windows);
  pass("--window-seconds", o.window_s);
  pass("--out", o.out);
  if (session.options.json) arguments.push_back("--json");
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  ::execv(argv[0], argv.data());
  throw InputError{{"sinew bench", "", program.string(), "a program that cannot be started"}};
}

}  // namespace

void addBenchCommand(Commands& commands) {
  auto o = std::make_shared<BenchCommandOptions>();
  auto& command =
      addCommand(commands.app, "bench",
                 "speed of kinematics, lengths, gradients, range-of-motion map, sweep and retargeting, and "
                 "of DART and MuJoCo on the same model where they are installed",
                 "sinew bench --row 3 --out bench.json");
  command.add_option("--row", o->rows, "row of the table, 1 to 8 or 14; may be repeated; all if not given")
      ->allow_extra_args(false)
      ->check(CLI::IsMember({1, 2, 3, 4, 5, 6, 7, 8, 14}));
  command.add_option("--windows", o->windows, "measurements of each, 9 if not given")->check(CLI::Range(1, 1000));
  command.add_option("--window-seconds", o->window_s, "shortest time of one, 0.1 if not given")
      ->check(CLI::PositiveNumber);
  command.add_option("--out", o->out, "file for the JSON document");
  command.callback(
      [&commands, o] { commands.chosen = [&session = commands.session, o] { return becomeBench(*o, session); }; });
}

}  // namespace sinew
