#include <algorithm>
#include <memory>

#include "app/cli/support/commands.h"
#include "app/cli/support/text_table.h"
#include "core/io/foreign/foreign_json.h"

namespace sinew {
namespace {

Json importInfo(const ForeignModel& model) {
  double mass_kg = 0;
  for (const auto& body : model.bodies) mass_kg += body.mass_kg;
  std::size_t points = 0, moving = 0, conditional = 0, wraps = 0;
  for (const auto& path : model.paths) {
    points += path.points.size();
    moving += static_cast<std::size_t>(std::ranges::count_if(path.points, &ForeignPathPoint::moves));
    conditional += static_cast<std::size_t>(
        std::ranges::count_if(path.points, [](const ForeignPathPoint& p) { return p.condition.has_value(); }));
    wraps += path.wraps.size();
  }
  return {{"format", "sinew.import"},
          {"version", 1},
          {"name", model.name},
          {"source", model.source},
          {"bodies", model.bodies.size()},
          {"joints", model.joints.size()},
          {"coordinates", model.coordinates.size()},
          {"coupled_coordinates", model.couplings.size()},
          {"muscles", model.paths.size()},
          {"path_points", points},
          {"moving_points", moving},
          {"conditional_points", conditional},
          {"wrap_objects", model.wrap_objects.size()},
          {"wraps", wraps},
          {"mass_kg", mass_kg}};
}

}  // namespace

void addImportCommand(Commands& commands) {
  struct Options {
    std::string file;
    std::filesystem::path output;
  };
  auto o = std::make_shared<Options>();
  auto& command =
      addCommand(commands.app, "import", "what a model of another program holds, and what is not used of it",
                 "sinew import arm26.osim -o arm26.json");
  command.add_option("FILE", o->file, "OpenSim model (.osim), or what an earlier import stored")->required();
  command.add_option("-o,--output", o->output,
                     "store it as JSON (sinew.foreign_model), for evaluate and curve; a name that ends in .json");
  command.callback([&commands, o] {
    commands.chosen = [&session = commands.session, o] {
      if (!o->output.empty() && o->output.extension() != ".json")
        throw InputError{{"sinew import", "--output", "a name that ends in .json", "'" + o->output.string() + "'"}};
      const auto model = session.foreignModel(o->file);
      if (!model)
        throw InputError{{"sinew import", "FILE", "a file that ends in .osim, or JSON of 'sinew.foreign_model'",
                          "'" + o->file + "'"}};
      Json info = importInfo(*model);
      std::vector<std::vector<std::string>> rows;
      for (const auto& [key, value] : info.items())
        if (key != "format" && key != "version")
          rows.push_back({key, value.is_string()         ? value.get<std::string>()
                               : value.is_number_float() ? fixed(value.get<double>(), 2)
                                                         : value.dump()});
      std::string text = textTable({"", ""}, rows).substr(1);
      if (!o->output.empty()) {
        saveForeignModel(*model, o->output);
        text += "written " + o->output.string() + "\n";
      }
      info["file"] = o->output.empty() ? Json{} : Json(o->output.string());
      info["warnings"] = warningsToJson(model->warnings);
      session.result(info, text);
      return ExitStatus::Done;
    };
  });
}

}  // namespace sinew
