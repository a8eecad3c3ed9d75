#include <algorithm>

#include "app/cli/experiments/experiment.h"
#include "app/cli/support/retarget_json.h"
#include "app/cli/support/text_table.h"
#include "app/plot/svg_charts.h"
#include "app/scene/model_scene.h"
#include "core/file.h"
#include "core/foreign/foreign_from_model.h"
#include "core/io/mjcf/mjcf.h"
#include "core/io/osim/osim_writer.h"
#include "core/skeleton/shape/shape_json.h"

namespace sinew {
namespace {

bool validAtRest(const Character& c) {
  return std::ranges::all_of(c.at_rest, [](const RestingVerdict& v) { return v.valid; });
}

/// "psoas_r 0.41, ..."
std::string worstUnits(const Character& c, std::size_t count) {
  std::vector<const UnitRouting*> order;
  for (const UnitRouting& unit : c.retargeted.routing) order.push_back(&unit);
  std::ranges::stable_sort(order, [](auto* a, auto* b) { return a->end.total({}) > b->end.total({}); });
  std::string text;
  for (std::size_t i = 0; i < std::min(count, order.size()); ++i)
    if (order[i]->end.total({}) > 0.001)
      text += (i ? ", " : "") + order[i]->unit + " " + fixed(order[i]->end.total({}), 2);
  return text;
}

Json characterJson(const Character& c) {
  const EnergyTotals e = energyTotals(c.retargeted.routing);
  Json rest = Json::array();
  for (const RestingVerdict& v : c.at_rest)
    rest.push_back({{"posture", v.posture}, {"valid", v.valid}, {"first_to_fail", v.first_to_fail}});
  return {
      {"name", c.body.name},
      {"body", bodyToJson(c.body)},
      {"height_m", c.height_m},
      {"mass_kg", c.mass_kg},
      {"energy", {{"start", e.start}, {"end", e.end}, {"paper_start", e.paper_start}, {"paper_end", e.paper_end}}},
      {"relaxed", c.retargeted.lengths.relaxed},
      {"at_rest", rest}};
}

/// All in one scale, on one floor. Empty if this machine cannot draw.
std::string drawn(const std::vector<Character>& characters, Session& session) {
  double tallest_m = 0;
  for (const Character& c : characters) tallest_m = std::max(tallest_m, c.height_m);
  std::vector<CaptionedPicture> pictures;
  try {
    for (const Character& c : characters) {
      const Model& model = c.retargeted.model;
      const Posture standing = zeroPosture(model.skeleton);
      const auto X_WB = segmentPoses(model.skeleton, standing);
      double floor_m = 1e9;
      for (const BoneMesh& bone : *model.bones)
        for (const auto& p_B : bone.mesh.vertices)
          floor_m = std::min(floor_m, (X_WB[std::size_t(bone.segment)] * p_B).y());
      ModelPicture picture;
      picture.width_px = 360, picture.height_px = 720;
      picture.mechanical_axes = false;
      picture.focus = PictureFocus{{0, floor_m + 0.5 * tallest_m, 0}, 0.53 * tallest_m};
      pictures.push_back({renderModel(model, standing, picture),
                          {c.body.name, fixed(c.height_m, 2) + " m, " + fixed(c.mass_kg, 0) + " kg"}});
    }
  } catch (const InputError& cannot_draw) {
    session.note(std::string{"no picture of the characters: "} + cannot_draw.what());
    return "";
  }
  return picturesSvg("The characters of Ryu et al., muscles retargeted", pictures);
}

std::string textOf(const std::vector<Character>& characters) {
  std::vector<std::vector<std::string>> rows, times;
  std::string rest;
  for (const Character& c : characters) {
    const EnergyTotals e = energyTotals(c.retargeted.routing);
    rows.push_back({c.body.name, fixed(c.height_m, 2), fixed(c.mass_kg, 1), fixed(e.start, 1), fixed(e.end, 1),
                    fixed(e.paper_start, 1), fixed(e.paper_end, 1), std::to_string(c.retargeted.lengths.relaxed),
                    validAtRest(c) ? "valid" : "not valid"});
    const std::string worst = worstUnits(c, 5);
    if (!worst.empty()) rest += c.body.name + ", highest energies left: " + worst + "\n";
    for (const RestingVerdict& v : c.at_rest)
      if (!v.valid) rest += c.body.name + " cannot take '" + v.posture + "': " + v.first_to_fail + "\n";
  }
  return textTable(
             {"", "height m", "mass kg", "energy", "retargeted", "paper's part", "retargeted", "relaxed", "at rest"},
             rows) +
         rest;
}

}  // namespace

ExperimentReport charactersReport(ExperimentContext& context) {
  const auto* characters = context.characters();
  if (!characters) return {.outcome = Outcome::Cancelled};
  ExperimentReport report{.outcome = Outcome::Converged};
  const auto folder = context.folder() / "characters";
  std::filesystem::create_directories(folder);
  bool sound = true;
  Json list = Json::array();
  std::size_t files = 0;
  for (const Character& c : *characters) {
    sound = sound && validAtRest(c);
    list.push_back(characterJson(c));
    const auto file = folder / (c.body.name + ".json"), mjcf = folder / (c.body.name + ".xml"),
               osim = folder / (c.body.name + ".osim");
    saveModel(c.retargeted.model, file);
    writeFileAtomically(mjcf, mjcfText(c.retargeted.model));
    writeFileAtomically(osim, osimText(foreignFromModel(c.retargeted.model)));
    // What was written is what a user gets: it has to load.
    files += loadModel(file, context.session().reference()).musculature.units.size() ==
             c.retargeted.model.musculature.units.size();
    report.models.insert(report.models.end(), {file, mjcf, osim});
  }
  report.result = {{"characters", list}};
  report.text = textOf(*characters);
  report.verdicts = {
      {"characters built by one command", "4", "4", std::to_string(characters->size()), characters->size() == 4},
      {"valid standing, weightless, arms sideways", "", "all", sound ? "all" : "not all", sound},
      {"exported: model JSON that loads back, MuJoCo, OpenSim", "simulated", "4", std::to_string(files), files == 4}};
  const std::string picture = drawn(*characters, context.session());
  if (!picture.empty()) report.figures = {{"characters", picture}};
  return report;
}

}  // namespace sinew
