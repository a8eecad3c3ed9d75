#include <chrono>
#include <cmath>
#include <memory>

#include "app/cli/support/commands.h"
#include "app/cli/support/text_table.h"
#include "app/experiments/rom_edit_experiment.h"
#include "core/angle.h"
#include "core/model/rom_preset.h"
#include "core/rom/edit/rom_edit_json.h"
#include "core/rom/maps/rom_limits.h"
#include "core/text.h"

namespace sinew {
namespace {

constexpr char kWhere[] = "sinew rom-edit";

struct RomEditCommandOptions {
  std::string model, preset, method = "sinew", tilt;
  double scale = 1, shift_deg = 0, cone = 1, twist_scale = 1, twist_shift_deg = 0;
  std::string joint;
  std::filesystem::path edits_file, output, edits_output;
};

/// "forward=30"
RomTilt tiltFrom(const std::string& text) {
  if (text.empty()) return {};
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError{{kWhere, "--tilt", "DIRECTION=DEGREES, as forward=30", "'" + text + "'"}};
  return {.towards = text.substr(0, equals),
          .angle_rad = parseNumber(text.substr(equals + 1), kWhere, "--tilt") / kDegPerRad};
}

/// Those of the file, then the one of the options.
RomEdits editsFrom(const RomEditCommandOptions& o, const Skeleton& skeleton) {
  RomEdits edits;
  if (!o.edits_file.empty()) edits = loadRomEdits(o.edits_file, skeleton);
  const RomEdit edit{.joint = o.joint,
                     .range_factor = o.scale,
                     .shift_rad = o.shift_deg / kDegPerRad,
                     .cone_factor = o.cone,
                     .tilt = tiltFrom(o.tilt),
                     .twist_factor = o.twist_scale,
                     .twist_shift_rad = o.twist_shift_deg / kDegPerRad};
  if (o.joint.empty() && !edit.isIdentity()) throw InputError{{kWhere, "--joint", "the joint to be edited", "none"}};
  if (!o.joint.empty()) edits.push_back(edit);
  if (edits.empty()) throw InputError{{kWhere, "", "--joint with what changes, or --edits FILE", "neither"}};
  checkRomEdits(skeleton, edits, kWhere);
  return edits;
}

std::string percent(double share) {
  return fixed(100 * share, 1) + " %";
}

Json cellsJson(const std::vector<RomEditCells>& cells) {
  Json list = Json::array();
  for (const RomEditCells& c : cells)
    list.push_back(
        {{"joint", c.joint},
         {"held", c.held},
         {"cells", c.cells},
         {"muscles",
          {{"wanted", c.wanted}, {"differing", c.differing}, {"of_all", c.ofAll()}, {"of_union", c.ofUnion()}}},
         {"muscles_and_stops",
          {{"wanted", c.wanted_in_stops},
           {"differing", c.differing_in_stops},
           {"of_all", c.ofAllInStops()},
           {"of_union", c.ofUnionInStops()}}}});
  return list;
}

Json degreesJson(double low_rad, double high_rad) {
  return Json::array({numberOrNull(low_rad * kDegPerRad), numberOrNull(high_rad * kDegPerRad)});
}

/// What ends each coordinate of the edited joints, before and after.
struct Limits {
  std::vector<RomLimit> before, after;
};

Limits limitsOf(const Model& before, const Model& after, const RomTransform& transform) {
  Limits limits;
  for (const int joint : transform.joints())
    for (auto [model, list] : {std::pair{&before, &limits.before}, std::pair{&after, &limits.after}}) {
      const auto of_joint = romLimits(*model, joint, zeroPosture(model->skeleton));
      list->insert(list->end(), of_joint.begin(), of_joint.end());
    }
  return limits;
}

Json resultJson(const RomEditCommandOptions& o, const RomEdits& edits, const RomEditResult& result,
                const Limits& limits, double seconds) {
  Json changed = Json::array(), stops = Json::array(), limited = Json::array();
  for (const auto& c : result.changed) changed.push_back({{"muscle", c.unit}, {"length_factor", c.length_factor}});
  for (const auto& s : result.stops)
    stops.push_back({{"coordinate", s.coordinate},
                     {"before_deg", degreesJson(s.before_min_rad, s.before_max_rad)},
                     {"after_deg", degreesJson(s.after_min_rad, s.after_max_rad)}});
  for (std::size_t i = 0; i < limits.after.size(); ++i) {
    const RomLimit &b = limits.before[i], &a = limits.after[i];
    limited.push_back({{"coordinate", a.coordinate},
                       {"before_deg", degreesJson(b.low_rad, b.high_rad)},
                       {"before_limited_by", {b.low_by, b.high_by}},
                       {"after_deg", degreesJson(a.low_rad, a.high_rad)},
                       {"after_limited_by", {a.low_by, a.high_by}}});
  }
  return {{"format", "sinew.rom_edit_result"},
          {"version", 1},
          {"model", o.model},
          {"method", o.method},
          {"edits", romEditsToJson(edits)},
          {"outcome", nameOf(result.outcome)},
          {"cells", cellsJson(result.cells)},
          {"changed", changed},
          {"stops", stops},
          {"limits", limited},
          {"seconds", seconds},
          {"file", o.output.empty() ? Json(nullptr) : Json(o.output.string())}};
}

std::string range(double low_rad, double high_rad) {
  if (!(low_rad <= high_rad)) return "none";
  return fixed(low_rad * kDegPerRad, 0) + " .. " + fixed(high_rad * kDegPerRad, 0);
}

std::string resultText(const RomEdits& edits, const RomEditResult& result, const Limits& limits) {
  std::string text;
  for (const RomEdit& e : edits) text += inWords(e) + "\n";
  std::vector<std::vector<std::string>> rows;
  for (const RomEditCells& c : result.cells)
    rows.push_back({c.joint, c.held, percent(c.ofAll()), percent(c.ofUnion()), percent(c.ofAllInStops()),
                    percent(c.ofUnionInStops())});
  text += "\n" +
          textTable({"cells not as wanted", "held", "muscles, of all", "of union", "with stops, of all", "of union"},
                    rows);
  rows.clear();
  for (std::size_t i = 0; i < limits.after.size(); ++i) {
    const RomLimit &b = limits.before[i], &a = limits.after[i];
    rows.push_back({a.coordinate, range(b.low_rad, b.high_rad), b.low_by + ", " + b.high_by,
                    range(a.low_rad, a.high_rad), a.low_by + ", " + a.high_by});
  }
  text += "\n" + textTable({"from standing, deg", "before", "ended by", "after", "ended by"}, rows);
  rows.clear();
  for (const auto& c : result.changed) rows.push_back({c.unit, fixed(c.length_factor, 3)});
  text += "\n" +
          (rows.empty() ? std::string{"no muscle length changes\n"} : textTable({"muscle", "length factor"}, rows));
  return text;
}

ExitStatus editRom(const RomEditCommandOptions& o, Session& session) {
  const Model model = session.model(o.model);
  const RomEdits edits = editsFrom(o, model.skeleton);
  const std::string preset = o.preset.empty() ? presetOf(model.name).value_or(std::string{kDefaultPreset}) : o.preset;
  const Job job = session.job();
  job.report(0, "pose set of " + preset);
  RomEditSolver solver = romEditSolver(model, session.resourceDir(), preset);
  job.report(0.7, "muscle lengths");
  const auto begin = std::chrono::steady_clock::now();
  RomEditResult result =
      solver.solve(edits, {.method = o.method == "paper" ? RomEditMethod::Paper : RomEditMethod::Sinew}, job);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (result.outcome != Outcome::Converged) {
    session.failure({kWhere, "", "", ""}, "the edit was cancelled");
    return ExitStatus::NotConverged;
  }
  job.report(1, "done");
  session.warn(result.warnings);
  if (!o.output.empty()) {
    if (!isIdentity(edits)) result.model.name = o.output.stem().string();
    saveModel(result.model, o.output);
  }
  if (!o.edits_output.empty()) saveRomEdits(edits, o.edits_output);
  const Limits limits = limitsOf(model, result.model, solver.transform(edits));
  session.result(resultJson(o, edits, result, limits, seconds), resultText(edits, result, limits));
  return ExitStatus::Done;
}

}  // namespace

void addRomEditCommand(Commands& commands) {
  auto o = std::make_shared<RomEditCommandOptions>();
  auto& command = addCommand(commands.app, "rom-edit",
                             "widen, narrow, shift or tilt the range of motion of a joint; muscle lengths follow",
                             "sinew rom-edit reference --joint hip_r --tilt forward=30 --cone 0.63 -o edited.json");
  command.add_option("MODEL", o->model, "model file, or the word reference")->required();
  command.add_option("--joint", o->joint, "joint to be edited, as hip_r");
  command.add_option("--scale", o->scale, "hinge: width of its range, 0.8 is narrower");
  command.add_option("--shift", o->shift_deg, "hinge: range moved by so many degrees");
  command.add_option("--cone", o->cone, "ball joint: width of the cone of its shaft's directions, 0.63 is narrower");
  command.add_option("--tilt", o->tilt, "ball joint: DIRECTION=DEGREES, as forward=30 or hip_flexion=30");
  command.add_option("--twist-scale", o->twist_scale, "ball joint: width of the turn about its shaft");
  command.add_option("--twist-shift", o->twist_shift_deg,
                     "ball joint: turn about its shaft moved by so many degrees");
  command.add_option("--edits", o->edits_file, "file of edits (sinew.rom_edits), done first");
  command.add_option("--method", o->method, "how muscle lengths are found")
      ->check(CLI::IsMember({"sinew", "paper"}))
      ->capture_default_str();
  command.add_option("--preset", o->preset, "pose set: average-adult or athlete; the model's own by default");
  command.add_option("--write-edits", o->edits_output, "keep the edits as a file");
  command.add_option("-o,--output", o->output, "model file to be written");
  command.callback(
      [&commands, o] { commands.chosen = [&session = commands.session, o] { return editRom(*o, session); }; });
}

}  // namespace sinew
