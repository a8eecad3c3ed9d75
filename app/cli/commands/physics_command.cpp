#include <memory>
#include <optional>

#include "app/cli/support/commands.h"
#include "app/cli/support/text_table.h"
#include "core/model/physical_scaling.h"
#include "core/muscle/unit_selection.h"
#include "core/skeleton/shape/shape_json.h"
#include "core/text.h"

namespace sinew {
namespace {

struct ShapeOptions {
  std::string shape;
  std::filesystem::path output;
};

struct PhysicsOptions {
  std::string model;
  std::vector<std::string> masses, mass_ratios, strengths, curves;
  std::optional<double> age_years;
  std::filesystem::path output;
};

/// "trunk=1.2" -> {"trunk", 1.2}. @throws InputError naming the option.
std::pair<std::string, double> assignment(const std::string& command, const std::string& option,
                                          const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError{{command, option, "NAME=NUMBER", "'" + text + "'"}};
  return {text.substr(0, equals),
          parseNumber(text.substr(equals + 1), command, option + " " + text.substr(0, equals))};
}

/// Masses of a model beside the reference's, and how far F_max changed.
Json physicsJson(const Model& model, const Model& reference) {
  Json segments = Json::array(), strengths = Json::object();
  double mass_kg = 0;
  for (int i = 0; i < model.skeleton.movingSegmentCount(); ++i) {
    const Segment& s = model.skeleton.segments[std::size_t(i)];
    const int own = reference.skeleton.segmentIndex(s.name);
    segments.push_back({{"segment", s.name},
                        {"mass_kg", s.mass_kg},
                        {"mass_ratio", s.mass_kg / reference.skeleton.segments[std::size_t(own)].mass_kg}});
    mass_kg += s.mass_kg;
  }
  for (const auto& unit : model.musculature.units)
    strengths[unit.name] = unit.max_isometric_force_N / reference.musculature.unit(unit.name).max_isometric_force_N;
  return {{"mass_kg", mass_kg}, {"segments", segments}, {"strength_ratios", strengths}};
}

std::string physicsText(const Json& physics) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& s : physics["segments"])
    rows.push_back({s["segment"], fixed(s["mass_kg"], 3), fixed(s["mass_ratio"], 3)});
  double low = 1e9, high = 0;
  for (const auto& [name, ratio] : physics["strength_ratios"].items())
    low = std::min(low, ratio.get<double>()), high = std::max(high, ratio.get<double>());
  return textTable({"segment", "mass kg", "of the reference's"}, rows) + "\nbody " + fixed(physics["mass_kg"], 2) +
         " kg; maximal muscle forces " + fixed(low, 3) + " to " + fixed(high, 3) + " of the reference's\n";
}

ExitStatus showShape(const ShapeOptions& o, Session& session) {
  const BodyDescription body = loadBody(o.shape, session.resourceDir());
  const Model& reference = session.reference();
  Model model = withPhysics(deformedModel(reference, body.shape), reference, body.physics);
  model.name = body.name;
  if (!o.output.empty()) saveModel(model, o.output);
  Json json{{"format", "sinew.shape_info"}, {"version", 1}, {"body", bodyToJson(body)}};
  json.update(physicsJson(model, reference));
  json["file"] = o.output.empty() ? Json(nullptr) : Json(o.output.string());
  std::string text = body.name + (body.about.empty() ? "" : ": " + body.about) + "\n" + physicsText(json);
  if (!o.output.empty()) text += "written " + o.output.string() + "\n";
  session.result(json, text);
  return ExitStatus::Done;
}

/// What the options add to the factors that the model has already; a segment has a factor or a ratio.
PhysicsFactors editedFactors(const PhysicsOptions& o, PhysicsFactors factors) {
  const std::string command = "sinew model physics";
  const auto each = [&](const std::string& option, const std::vector<std::string>& texts, const auto& apply) {
    for (const auto& text : texts) {
      const auto [name, value] = assignment(command, option, text);
      if (!(value >= 0.01 && value <= 100))
        throw InputError{{command, option + " " + name, "a factor from 0.01 to 100", std::to_string(value)}};
      apply(name, value);
    }
  };
  const auto mass = [&](const std::string& option, const std::vector<std::string>& texts, auto& set, auto& other) {
    each(option, texts, [&](const std::string& part, double value) {
      const auto segments = segmentsOfPart(part);
      if (segments.empty())
        throw InputError{{command, option, "a part of the body", "'" + part + "'" + didYouMean(part, massParts())}};
      for (const auto& segment : segments) {
        set[segment] = value;
        other.erase(segment);
      }
    });
  };
  mass("--mass", o.masses, factors.mass_factors, factors.mass_ratios);
  mass("--mass-ratio", o.mass_ratios, factors.mass_ratios, factors.mass_factors);
  each("--strength", o.strengths,
       [&](const std::string& units, double value) { factors.strength_factors[units] = value; });
  if (o.age_years) factors.age_years = o.age_years;
  return factors;
}

/// "soleus.active_width=0.5"
std::vector<CurveEdit> curveEdits(const PhysicsOptions& o) {
  std::vector<CurveEdit> edits;
  for (const auto& text : o.curves) {
    const auto [name, value] = assignment("sinew model physics", "--curve", text);
    const auto dot = name.find('.');
    if (dot == std::string::npos)
      throw InputError{{"sinew model physics", "--curve", "MUSCLE.PARAMETER=NUMBER", "'" + text + "'"}};
    edits.push_back({name.substr(0, dot), name.substr(dot + 1), value});
  }
  return edits;
}

ExitStatus editPhysics(const PhysicsOptions& o, Session& session) {
  const Model before = session.model(o.model);
  const auto edits = curveEdits(o);
  Model model = before;
  if (!(o.masses.empty() && o.mass_ratios.empty() && o.strengths.empty() && !o.age_years) || edits.empty())
    model = withPhysics(model, session.reference(), editedFactors(o, before.physics.value_or(PhysicsFactors{})));
  model.musculature = withCurves(model.musculature, edits);
  saveModel(model, o.output);
  std::size_t edited = 0;
  for (const auto& unit : model.musculature.units) edited += unit.curves != HillParameters{};
  Json json{{"format", "sinew.model_physics"}, {"version", 1}, {"model", o.output.string()}};
  json["factors"] = model.physics ? physicsFactorsToJson(*model.physics) : Json(nullptr);
  json["edited_curves"] = edited;
  json.update(physicsJson(model, session.reference()));
  session.result(json, physicsText(json) + std::to_string(edited) + " units have curves of their own\nwritten " +
                           o.output.string() + "\n");
  return ExitStatus::Done;
}

}  // namespace

void addShapeCommand(CLI::App& parent, Commands& commands) {
  auto o = std::make_shared<ShapeOptions>();
  auto& command =
      addCommand(parent, "shape", "a body of another shape: masses, strengths; its model, not yet retargeted",
                 "sinew model shape alien -o alien.json");
  command.add_option("SHAPE", o->shape, "shape file, or human, alien, hulk, dwarf, child")->required();
  command.add_option("-o,--output", o->output, "model file: muscles ride on their bones");
  command.callback(
      [&commands, o] { commands.chosen = [&session = commands.session, o] { return showShape(*o, session); }; });
}

void addPhysicsCommand(CLI::App& parent, Commands& commands) {
  auto o = std::make_shared<PhysicsOptions>();
  auto& command = addCommand(
      parent, "physics", "masses, strengths, age and muscle curves of a model: by the scaling rules and by factors",
      "sinew model physics reference --mass trunk=1.2 --strength quadriceps=0.8 --curve "
      "soleus.active_width=0.5 -o M");
  command.add_option("MODEL", o->model, "model file, or reference, reference:athlete")->required();
  command.add_option("--mass", o->masses, "PART=FACTOR on the mass of the deformed volume");
  command.add_option("--mass-ratio", o->mass_ratios, "PART=RATIO to the mass of the reference");
  command.add_option("--strength", o->strengths, "MUSCLE|GROUP=RATIO to the force of the reference");
  command.add_option("--age-years", o->age_years, "joints as lax as at this age")->check(CLI::Range(0.0, 120.0));
  command.add_option("--curve", o->curves,
                     "MUSCLE|GROUP.PARAMETER=NUMBER: active_width, passive_strain, passive_shape, tendon_strain, "
                     "max_velocity_1_s, max_lengthening");
  command.add_option("-o,--output", o->output, "model file")->required();
  command.callback(
      [&commands, o] { commands.chosen = [&session = commands.session, o] { return editPhysics(*o, session); }; });
}

}  // namespace sinew
