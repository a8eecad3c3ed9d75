#include <algorithm>
#include <memory>

#include "app/cli/commands.h"
#include "core/muscle/controllability.h"
#include "core/muscle/evaluate.h"
#include "core/skeleton/posture_file.h"
#include "core/text.h"

namespace sinew {
namespace {

constexpr std::size_t kLimitingMuscles = 10;
const std::vector<std::string> kQuantities = {"lengths",         "moment_arms",    "validity",
                                              "limiting_muscle", "passive_torque", "peak_torque",
                                              "fiber_lengths",   "passive_forces", "controllability"};

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
Json momentArmsJson(const Model& model, const Eigen::MatrixXd& arms) {
  Json json = Json::object();
  for (Eigen::Index i = 0; i < arms.rows(); ++i) {
    Json unit = Json::object();
    for (Eigen::Index k = 0; k < arms.cols(); ++k)
      if (arms(i, k) != 0) unit[model.skeleton.coordinates[static_cast<std::size_t>(k)].name] = arms(i, k);
    json[model.musculature.units[static_cast<std::size_t>(i)].name] = unit;
  }
  return json;
}

Json limitingJson(const Model& model, const PostureEvaluation& e) {
  Json list = Json::array();
  for (std::size_t i = 0; i < std::min(e.margins.size(), kLimitingMuscles); ++i)
    list.push_back({{"name", model.musculature.units[static_cast<std::size_t>(e.margins[i].unit)].name},
                    {"margin_m", e.margins[i].margin_m}});
  return list;
}

Json torqueJson(const Model& model, const Eigen::VectorXd& torque) {
  Json json = Json::object();
  for (std::size_t k = 0; k < model.skeleton.coordinates.size(); ++k)
    if (!model.skeleton.coordinates[k].translational)
      json[model.skeleton.coordinates[k].name] = torque[static_cast<Eigen::Index>(k)];
  return json;
}

/// Both ways of every rotation.
Json peakTorqueJson(const Model& model, const IsometricTorque& torque) {
  Json json = Json::object();
  for (std::size_t k = 0; k < model.skeleton.coordinates.size(); ++k)
    if (const auto i = static_cast<Eigen::Index>(k); !model.skeleton.coordinates[k].translational)
      json[model.skeleton.coordinates[k].name] = {{"increasing", torque.increasing_Nm[i]},
                                                  {"decreasing", torque.decreasing_Nm[i]}};
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

Json postureJson(const Model& model, const NamedPosture& posture, const std::vector<std::string>& what) {
  const PostureEvaluation e = evaluatePosture(model.skeleton, model.musculature, posture.posture);
  Json json{{"name", posture.name}};
  for (const auto& quantity : what) {
    if (quantity == "lengths") json["lengths_m"] = byUnit(model.musculature, e.length_m);
    if (quantity == "moment_arms") json["moment_arms_m"] = momentArmsJson(model, e.moment_arm_m);
    if (quantity == "validity") {
      json["valid"] = e.valid;
      json["coordinates_beyond_envelope"] = e.coordinates_beyond_envelope;
    }
    if (quantity == "limiting_muscle") json["limiting"] = limitingJson(model, e);
    if (quantity == "passive_torque") json["passive_torque_Nm"] = torqueJson(model, e.passive_torque);
    if (quantity == "peak_torque")
      json["peak_torque_Nm"] = peakTorqueJson(model, isometricTorque(model.musculature, e));
    if (quantity == "fiber_lengths")
      json["normalized_fiber_lengths"] = byUnit(model.musculature, e.normalized_fiber_length);
    if (quantity == "controllability") json["controllability"] = controllabilityJson(model, posture.posture);
    if (quantity == "passive_forces") json["passive_forces_N"] = byUnit(model.musculature, e.passive_force_N);
  }
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

}  // namespace

void addEvaluateCommand(Commands& commands) {
  struct Options {
    std::string model, what = "lengths,validity,limiting_muscle";
    std::filesystem::path postures;
  };
  auto o = std::make_shared<Options>();
  auto& command = addCommand(
      commands.app, "evaluate", "muscle lengths, moment arms, torques at any postures; CSV, or JSON with --json",
      "sinew evaluate reference --postures postures.json --what lengths,moment_arms --json\n"
      "  postures.json: [{\"name\": \"squat\", \"coordinates_deg\": {\"knee_flexion_r\": 90}}]; what is not named is "
      "0,\n"
      "  translations in metres. A moment arm is positive if the muscle increases the coordinate.");
  command.add_option("MODEL", o->model, "model file, or reference, reference:athlete")->required();
  command.add_option("--postures", o->postures, "JSON file of postures")->required();
  command
      .add_option("--what", o->what,
                  "of lengths, moment_arms, validity, limiting_muscle, passive_torque, peak_torque (isometric, every "
                  "muscle that turns that way fully active), fiber_lengths, passive_forces, controllability (can "
                  "activations turn "
                  "every coordinate both ways, alone: residual 0 to 1, strength)")
      ->capture_default_str();
  command.callback([&commands, o] {
    commands.chosen = [&session = commands.session, o] {
      const auto what = chosenQuantities(o->what);
      const Model model = session.model(o->model);
      Json postures = Json::array();
      const auto wanted = loadPostures(o->postures, model.skeleton);
      const Job job = session.job();
      for (std::size_t i = 0; i < wanted.size(); ++i) {
        if (job.cancelled()) return ExitStatus::NotConverged;
        job.report(static_cast<double>(i) / static_cast<double>(wanted.size()), "evaluating postures");
        postures.push_back(postureJson(model, wanted[i], what));
      }
      session.result({{"format", "sinew.evaluation"}, {"version", 1}, {"postures", postures}}, asCsv(postures));
      return ExitStatus::Done;
    };
  });
}

}  // namespace sinew
