#include <memory>

#include "app/cli/support/commands.h"
#include "app/cli/support/text_table.h"
#include "app/plot/png_file.h"
#include "app/scene/rom_sphere.h"
#include "core/rom/maps/rom_map.h"
#include "core/skeleton/clinical_angles.h"
#include "core/text.h"

namespace sinew {
namespace {

struct RomCommandOptions {
  std::string model, joint, compare_model;
  std::vector<std::string> held, compare_held;  ///< "knee_flexion_r=90"
  bool no_joint_limits = false;
  std::filesystem::path output;
};

/// "knee_flexion_r=90" by name; later ones win.
std::map<std::string, double> coordinates_deg(const std::vector<std::string>& items, const std::string& option) {
  std::map<std::string, double> values;
  for (const std::string& item : items) {
    const auto equals = item.find('=');
    if (equals == std::string::npos)
      throw InputError{{"sinew rom", option, "COORDINATE=DEGREES, as knee_flexion_r=90", "'" + item + "'"}};
    values[item.substr(0, equals)] = parseNumber(item.substr(equals + 1), "sinew rom", option);
  }
  return values;
}

/// Lengths of alternate runs in the order of the cells; the first run is of cells that are not valid (may be 0).
Json runLengths(const std::vector<std::uint8_t>& valid) {
  Json runs = Json::array();
  std::uint8_t value = 0;
  int length = 0;
  for (const std::uint8_t cell : valid) {
    if (cell != value) {
      runs.push_back(length);
      value = cell;
      length = 0;
    }
    ++length;
  }
  runs.push_back(length);
  return runs;
}

std::string percent(double share) {
  return fixed(100 * share, 1) + " %";
}

ExitStatus makeMap(const RomCommandOptions& o, Session& session) {
  if (!o.output.empty()) requirePngName(o.output, "sinew rom");
  const Model model = session.model(o.model);
  const RomMapOptions options{.joint_limits = !o.no_joint_limits};
  const auto held_deg = coordinates_deg(o.held, "--with");
  const RomMap map = romMap(model, o.joint, postureFromDegrees(model.skeleton, held_deg), options);
  Json json{{"format", "sinew.rom_map"},    {"version", 1},
            {"joint", map.joint},           {"cells", RomMap::kCells},
            {"valid", map.validCount()},    {"joint_limits", options.joint_limits},
            {"map", runLengths(map.valid)}, {"compare", nullptr}};
  std::vector<std::vector<std::string>> rows = {
      {"valid cells", std::to_string(map.validCount()), percent(double(map.validCount()) / RomMap::kCells)}};
  if (!o.compare_model.empty() || !o.compare_held.empty()) {
    const Model other = o.compare_model.empty() ? model : session.model(o.compare_model);
    auto other_held_deg = held_deg;
    for (const auto& [name, value] : coordinates_deg(o.compare_held, "--compare-with")) other_held_deg[name] = value;
    const RomMap second = romMap(other, o.joint, postureFromDegrees(other.skeleton, other_held_deg), options);
    const RomDifference d = compare(map, second);
    json["compare"] = {{"valid", second.validCount()}, {"only_first", d.only_first}, {"only_second", d.only_second},
                       {"differing", d.differing()},   {"of_all", d.ofAll()},        {"of_union", d.ofUnion()}};
    rows.push_back({"valid cells of the other", std::to_string(second.validCount()),
                    percent(double(second.validCount()) / RomMap::kCells)});
    rows.push_back({"differing, of all cells", std::to_string(d.differing()), percent(d.ofAll())});
    rows.push_back({"differing, of those valid in either", std::to_string(d.differing()), percent(d.ofUnion())});
  }
  if (!o.output.empty()) writePng(renderRomSphere(map), o.output);
  session.result(json, textTable({map.joint, "cells", "share"}, rows));
  return ExitStatus::Done;
}

}  // namespace

void addRomCommand(Commands& commands) {
  auto o = std::make_shared<RomCommandOptions>();
  auto& command = addCommand(commands.app, "rom", "range-of-motion map of a ball joint: twist x direction cells",
                             "sinew rom reference --joint hip_r --compare-with knee_flexion_r=90");
  command.add_option("MODEL", o->model, "model file, or the word reference")->required();
  command.add_option("--joint", o->joint, "ball-and-socket joint, as hip_r")->required();
  command.add_option("--with", o->held, "COORDINATE=DEGREES held by another joint; may be repeated")
      ->allow_extra_args(false);
  command.add_option("--compare", o->compare_model, "another model, in the same posture");
  command.add_option("--compare-with", o->compare_held, "COORDINATE=DEGREES that the second map holds instead")
      ->allow_extra_args(false);
  command.add_option("-o,--output", o->output, "picture of the sphere, coloured by twist range: .png");
  command.add_flag("--no-joint-limits", o->no_joint_limits, "muscles alone, without bony and ligament stops");
  command.callback(
      [&commands, o] { commands.chosen = [&session = commands.session, o] { return makeMap(*o, session); }; });
}

}  // namespace sinew
