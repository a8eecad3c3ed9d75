#include <memory>

#include "app/cli/commands.h"
#include "core/file.h"
#include "core/io/mjcf.h"

namespace sinew {

void addExportCommand(Commands& commands) {
  struct Options {
    std::string model, format = "mjcf";
    std::filesystem::path output;
  };
  auto o = std::make_shared<Options>();
  auto& command = addCommand(commands.app, "export", "the model for another program",
                             "sinew export reference --format mjcf -o reference.xml");
  command.add_option("MODEL", o->model, "model file, or the word reference")->required();
  command.add_option("--format", o->format, "mjcf: MuJoCo XML")
      ->check(CLI::IsMember({"mjcf"}))
      ->capture_default_str();
  command.add_option("-o,--output", o->output, "file to write")->required();
  command.callback([&commands, o] {
    commands.chosen = [&session = commands.session, o] {
      writeFileAtomically(o->output, mjcfText(session.model(o->model)));
      session.result({{"format", "sinew.export"},
                      {"version", 1},
                      {"model", o->model},
                      {"exported_format", o->format},
                      {"file", o->output.string()}},
                     "written " + o->output.string() + "\n");
      return ExitStatus::Done;
    };
  });
}

}  // namespace sinew
