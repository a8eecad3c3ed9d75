#include <algorithm>
#include <memory>

#include "app/cli/support/commands.h"
#include "core/foreign/foreign_evaluate.h"
#include "core/posture/controllability.h"
#include "core/posture/evaluate.h"
#include "core/skeleton/posture_file.h"
#include "core/text.h"

namespace sinew {
namespace {

constexpr std::size_t kLimitingMuscles = 10;
constexpr const char* kDefaultWhat = "lengths,validity,limiting_muscle";
const std::vector<std::string> kQuantities = {"lengths",        "moment_arms",      "validity",    "limiting_muscle",
                                              "passive_torque", "structure_torque", "peak_torque", "fiber_lengths",
                                              "passive_forces", "controllability"};
/// Of these a foreign model knows nothing: it has no flexibility, and its coordinates are not ours.
const std::vector<std::string> kOwnQuantities = {"validity", "limiting_muscle", "controllability"};

/// What results are written with, of our model or a foreign one.
struct Names {
  const Musculature& musculature;
  std::vector<std::string> coordinates;
  std::vector<bool> translational;
};

template <class Coordinates>
Names namesOf(const Musculature& musculature, const Coordinates& coordinates) {
  Names names{musculature, {}, {}};
  for (const auto& c : coordinates) {
    names.coordinates.push_back(c.name);
    names.translational.push_back(c.translational);
  }
  return names;
}

std::vector<std::string> chosenQuantities(const std::string& list) {
  std::vector<std::string> chosen = splitCsvLine(list);
  for (const auto& name : chosen)
    if (std::ranges::find(kQuantities, name) == kQuantities.end())
      throw InputError{{"sinew evaluate", "--what", "quantities of 'sinew evaluate --help', separated by commas",
                        "'" + name + "'" + didYouMean(name, kQuantities)}};
  return chosen;
}

Json byUnit(const Musculature& musculature, const Eigen::VectorXd& values) {
  Json json = Json::object();
  for (std::size_t i = 0; i < musculature.units.size(); ++i)
    json[musculature.units[i].name] = numberOrNull(values[static_cast<Eigen::Index>(i)]);
  return json;
}

/// Arms about the coordinates that the unit spans; the others are zero and left out.
Json momentArmsJson(const Names& names, const Eigen::MatrixXd& arms) {
  Json json = Json::object();
  for (Eigen::Index i = 0; i < arms.rows(); ++i) {
    Json unit = Json::object();
    for (Eigen::Index k = 0; k < arms.cols(); ++k)
      if (arms(i, k) != 0) unit[names.coordinates[static_cast<std::size_t>(k)]] = arms(i, k);
    json[names.musculature.units[static_cast<std::size_t>(i)].name] = unit;
  }
  return json;
}

Json limitingJson(const Musculature& musculature, const PostureEvaluation& e) {
  Json list = Json::array();
  for (std::size_t i = 0; i < std::min(e.margins.size(), kLimitingMuscles); ++i)
    list.push_back({{"name", musculature.units[static_cast<std::size_t>(e.margins[i].unit)].name},
                    {"margin_m", e.margins[i].margin_m}});
  return list;
}

Json torqueJson(const Names& names, const Eigen::VectorXd& torque) {
  Json json = Json::object();
  for (std::size_t k = 0; k < names.coordinates.size(); ++k)
    if (!names.translational[k]) json[names.coordinates[k]] = torque[static_cast<Eigen::Index>(k)];
  return json;
}

/// Both ways of every rotation.
Json peakTorqueJson(const Names& names, const IsometricTorque& torque) {
  Json json = Json::object();
  for (std::size_t k = 0; k < names.coordinates.size(); ++k)
    if (const auto i = static_cast<Eigen::Index>(k); !names.translational[k])
      json[names.coordinates[k]] = {{"increasing", torque.increasing_Nm[i]}, {"decreasing", torque.decreasing_Nm[i]}};
  return json;
}

/// Both ways of every coordinate but the root's.
Json controllabilityJson(const Model& model, const Posture& posture) {
  Json json = Json::object();
  for (const auto& control : controllability(model.skeleton, model.musculature, posture))
    json[model.skeleton.coordinates[static_cast<std::size_t>(control.coordinate)].name] = {
        {"increasing_residual", control.increasing.residual},
        {"increasing_strength_Nm", control.increasing.strength_Nm},
        {"decreasing_residual", control.decreasing.residual},
        {"decreasing_strength_Nm", control.decreasing.strength_Nm}};
  return json;
}

/// What was asked for, except kOwnQuantities.
Json evaluationJson(const Names& names, const PostureEvaluation& e, const std::vector<std::string>& what) {
  const Musculature& musculature = names.musculature;
  Json json = Json::object();
  for (const auto& quantity : what) {
    if (quantity == "lengths") json["lengths_m"] = byUnit(musculature, e.length_m);
    if (quantity == "moment_arms") json["moment_arms_m"] = momentArmsJson(names, e.moment_arm_m);
    if (quantity == "passive_torque") json["passive_torque_Nm"] = torqueJson(names, e.passive_torque);
    if (quantity == "structure_torque") json["structure_torque_Nm"] = torqueJson(names, e.structure_torque);
    if (quantity == "peak_torque") json["peak_torque_Nm"] = peakTorqueJson(names, isometricTorque(musculature, e));
    if (quantity == "fiber_lengths")
      json["normalized_fiber_lengths"] = byUnit(musculature, e.normalized_fiber_length);
    if (quantity == "passive_forces") json["passive_forces_N"] = byUnit(musculature, e.passive_force_N);
  }
  return json;
}

Json postureJson(const Model& model, const NamedPosture& posture, const std::vector<std::string>& what) {
  const PostureEvaluation e =
      evaluatePosture(model.skeleton, model.musculature, posture.posture, model.passive_moments);
  const Names names = namesOf(model.musculature, model.skeleton.coordinates);
  Json json{{"name", posture.name}};
  for (const auto& quantity : what) {
    if (quantity == "validity") {
      json["valid"] = e.valid;
      json["coordinates_beyond_envelope"] = e.coordinates_beyond_envelope;
    }
    if (quantity == "limiting_muscle") json["limiting"] = limitingJson(model.musculature, e);
    if (quantity == "controllability") json["controllability"] = controllabilityJson(model, posture.posture);
    json.update(evaluationJson(names, e, {quantity}));
  }
  return json;
}

Json postureJson(const ForeignModel& model, const NamedForeignPosture& posture,
                 const std::vector<std::string>& what) {
  Json json{{"name", posture.name}};
  json.update(
      evaluationJson(namesOf(model.musculature, model.coordinates), evaluatePosture(model, posture.posture), what));
  return json;
}

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
  std::string text = "\"";
  for (const char c : cell) text += c == '"' ? std::string{"\"\""} : std::string(1, c);
  return text + "\"";
}

/// One line a value: posture, quantity, name, coordinate, value.
void appendCsv(const std::string& posture, const std::string& quantity, const Json& value, const std::string& name,
               const std::string& coordinate, std::string& csv) {
  if (value.is_object() && value.contains("margin_m"))
    return appendCsv(posture, quantity, value["margin_m"], value["name"], "", csv);
  if (value.is_array())
    for (const auto& item : value)
      item.is_string() ? appendCsv(posture, quantity, 1, item, "", csv)
                       : appendCsv(posture, quantity, item, "", "", csv);
  else if (value.is_object())
    for (const auto& [key, item] : value.items())
      appendCsv(posture, quantity, item, name.empty() ? key : name, name.empty() ? "" : key, csv);
  else
    csv += quoted(posture) + "," + quantity + "," + quoted(name) + "," + coordinate + "," + value.dump() + "\n";
}

std::string asCsv(const Json& postures) {
  std::string csv = "posture,quantity,name,coordinate,value\n";
  for (const auto& posture : postures)
    for (const auto& [quantity, value] : posture.items())
      if (quantity != "name") appendCsv(posture["name"], quantity, value, "", "", csv);
  return csv;
}

struct EvaluateOptions {
  std::string model, what;
  std::filesystem::path postures;
};

/// One result a posture; nullopt if it was cancelled.
template <class AnyModel, class Postures>
std::optional<Json> evaluated(const AnyModel& model, const Postures& wanted, const std::vector<std::string>& what,
                              const Job& job) {
  Json postures = Json::array();
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (job.cancelled()) return std::nullopt;
    job.report(static_cast<double>(i) / static_cast<double>(wanted.size()), "evaluating postures");
    postures.push_back(postureJson(model, wanted[i], what));
  }
  return postures;
}

std::optional<Json> evaluatedForeign(const ForeignModel& model, const EvaluateOptions& o, const Job& job) {
  for (const auto& quantity : chosenQuantities(o.what))
    if (std::ranges::find(kOwnQuantities, quantity) != kOwnQuantities.end())
      throw InputError{{"sinew evaluate", "--what", "a quantity that a model of another program has",
                        "'" + quantity + "', which needs the joints and limits of our own"}};
  return evaluated(model, loadForeignPostures(o.postures, model), chosenQuantities(o.what), job);
}

ExitStatus evaluate(EvaluateOptions o, Session& session) {
  const auto foreign = session.foreignModel(o.model);
  if (o.what.empty()) o.what = foreign ? "lengths" : kDefaultWhat;
  const auto what = chosenQuantities(o.what);
  std::optional<Json> postures;
  if (foreign) {
    postures = evaluatedForeign(*foreign, o, session.job());
  } else {
    const Model model = session.model(o.model);
    postures = evaluated(model, loadPostures(o.postures, model.skeleton), what, session.job());
  }
  if (!postures) return ExitStatus::NotConverged;
  session.result({{"format", "sinew.evaluation"}, {"version", 1}, {"postures", *postures}}, asCsv(*postures));
  return ExitStatus::Done;
}

}  // namespace

void addEvaluateCommand(Commands& commands) {
  auto o = std::make_shared<EvaluateOptions>();
  auto& command = addCommand(
      commands.app, "evaluate", "muscle lengths, moment arms, torques at any postures; CSV, or JSON with --json",
      "sinew evaluate reference --postures postures.json --what lengths,moment_arms --json\n"
      "  postures.json: [{\"name\": \"squat\", \"coordinates_deg\": {\"knee_flexion_r\": 90}}]; what is not named is "
      "0\n"
      "  (in a model of another program its default), translations in metres. A moment arm is positive if the "
      "muscle\n"
      "  increases the coordinate.");
  command
      .add_option("MODEL", o->model,
                  "model file, or reference, reference:athlete; or an OpenSim file (.osim), of which validity, "
                  "limiting_muscle and controllability are not known")
      ->required();
  command.add_option("--postures", o->postures, "JSON file of postures")->required();
  command.add_option(
      "--what", o->what,
      "of lengths, moment_arms, validity, limiting_muscle, passive_torque (muscles, capsules and ligaments), "
      "structure_torque (capsules and ligaments alone), peak_torque (isometric, every "
      "muscle that turns that way fully active), fiber_lengths, passive_forces, controllability (can "
      "activations turn every coordinate both ways, alone: residual 0 to 1, strength) [" +
          std::string{kDefaultWhat} + "; of an OpenSim file lengths]");
  command.callback(
      [&commands, o] { commands.chosen = [&session = commands.session, o] { return evaluate(*o, session); }; });
}

}  // namespace sinew
