#include <algorithm>
#include <memory>

#include "app/cli/support/commands.h"
#include "app/cli/support/text_table.h"
#include "core/muscle/moment_references.h"

namespace sinew {
namespace {

const std::string& unitName(const Model& model, int unit) {
  return model.musculature.units[static_cast<std::size_t>(unit)].name;
}
const std::string& coordinateName(const Model& model, int coordinate) {
  return model.skeleton.coordinates[static_cast<std::size_t>(coordinate)].name;
}

/// "94.5 % (294 of 311)"
std::string rate(long part, long whole) {
  const double percent = whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0;
  return fixed(percent, 1) + " % (" + std::to_string(part) + " of " + std::to_string(whole) + ")";
}

struct Judgement {
  Json json;
  std::string text;
};

Judgement judgedArms(const Model& model, const std::vector<MomentArmReference>& references, bool all) {
  const auto verdicts = judgeMomentArms(model.skeleton, model.musculature, references);
  Json rows = Json::array();
  std::vector<std::vector<std::string>> table;
  for (std::size_t i = 0; i < references.size(); ++i) {
    const auto& [r, v] = std::tie(references[i], verdicts[i]);
    if (v.inside && !all) continue;
    const std::string &unit = unitName(model, r.unit), &coordinate = coordinateName(model, r.coordinate);
    rows.push_back({{"where", r.where},
                    {"muscle", unit},
                    {"coordinate", coordinate},
                    {"posture_deg", r.posture_deg},
                    {"arm_cm", v.arm_cm},
                    {"reference_cm", r.reference_cm},
                    {"min_cm", r.min_cm},
                    {"max_cm", r.max_cm},
                    {"inside", v.inside},
                    {"wrong_sign", v.wrong_sign}});
    table.push_back({unit, coordinate, fixed(r.posture_deg.at(coordinate), 0), fixed(v.arm_cm, 2),
                     fixed(r.reference_cm, 2), fixed(r.min_cm, 2) + " - " + fixed(r.max_cm, 2),
                     v.wrong_sign ? "wrong sign"
                     : v.inside   ? "inside"
                                  : "outside"});
  }
  const auto count = static_cast<long>(verdicts.size());
  const long inside = std::ranges::count(verdicts, true, &MomentArmVerdict::inside);
  const long wrong = std::ranges::count(verdicts, true, &MomentArmVerdict::wrong_sign);
  Judgement j;
  j.json = {{"rows", count}, {"inside", inside}, {"wrong_sign", wrong}, {"listed", rows}};
  if (!table.empty())
    j.text = textTable({"muscle", "about", "deg", "arm cm", "reference", "accepted", ""}, table) + "\n";
  j.text += "moment arms inside: " + rate(inside, count) + "; of wrong sign where the reference is " +
            fixed(kSignMatters_cm, 1) + " cm or more: " + std::to_string(wrong) + "\n";
  return j;
}

const char* nameOf(FunctionStrength strength) {
  return strength == FunctionStrength::Principal   ? "principal"
         : strength == FunctionStrength::Secondary ? "secondary"
                                                   : "posture_dependent";
}

/// A row is fulfilled by its sign at the test posture; a principal one over nine tenths of its range as well.
Judgement judgedFunctions(const Model& model, const std::vector<FunctionReference>& references, bool all) {
  constexpr double kKept = 0.9;
  const auto verdicts = judgeFunctions(model.skeleton, model.musculature, references);
  Judgement j;
  j.json = {{"rows", references.size()}};
  Json rows = Json::array();
  std::vector<std::vector<std::string>> table;
  std::string rates;
  for (const auto strength :
       {FunctionStrength::Principal, FunctionStrength::Secondary, FunctionStrength::PostureDependent}) {
    const bool principal = strength == FunctionStrength::Principal;
    long count = 0, right = 0, kept = 0;
    for (std::size_t i = 0; i < references.size(); ++i) {
      const auto& [r, v] = std::tie(references[i], verdicts[i]);
      if (r.strength != strength) continue;
      ++count;
      right += v.right;
      kept += v.share_of_range >= kKept;
      const bool fulfilled = v.right && (!principal || v.share_of_range >= kKept);
      if (fulfilled && !all && strength != FunctionStrength::PostureDependent) continue;
      const std::string &unit = unitName(model, r.unit), &coordinate = coordinateName(model, r.coordinate);
      const std::string sign = r.sign > 0 ? "+" : "-";
      rows.push_back({{"where", r.where},
                      {"muscle", unit},
                      {"coordinate", coordinate},
                      {"sign", sign},
                      {"strength", nameOf(strength)},
                      {"arm_cm", v.arm_cm},
                      {"right", v.right},
                      {"share_of_range", v.share_of_range}});
      table.push_back(
          {unit, coordinate, sign, nameOf(strength), fixed(v.arm_cm, 2),
           fixed(100 * v.share_of_range, 0) + " % of " + fixed(r.min_deg, 0) + " to " + fixed(r.max_deg, 0),
           v.right ? "" : "wrong"});
    }
    j.json[nameOf(strength)] = {{"rows", count}, {"right", right}, {"over_nine_tenths", kept}};
    rates += std::string{nameOf(strength)} + " functions right at the test posture: " + rate(right, count) +
             "; over nine tenths of the range: " + rate(kept, count) + "\n";
  }
  j.json["listed"] = rows;
  if (!table.empty())
    j.text = textTable({"muscle", "about", "sign", "strength", "arm cm", "right over deg", ""}, table) + "\n";
  j.text += rates;
  return j;
}

}  // namespace

void addMomentArmsCommand(CLI::App& parent, Commands& commands) {
  struct Options {
    std::string model;
    std::filesystem::path reference, functions;
    bool all = false;
  };
  auto o = std::make_shared<Options>();
  auto& command = addCommand(
      parent, "moment-arms", "moment arms and functions of a model against tables of published ones",
      "sinew model moment-arms reference --reference moment_arms.csv --functions muscle_functions.csv\n"
      "  moment_arms.csv: muscle,coordinate,other_posture_deg,angle_deg,reference_cm,min_cm,max_cm (or dof,\n"
      "  pose_other_dofs, accept_min_cm, accept_max_cm); positive = increases the coordinate.\n"
      "  muscle_functions.csv: muscle,coordinate,sign,strength,min_deg,max_deg,other_posture_deg (or dof, "
      "test_min_deg,\n"
      "  test_max_deg, test_pose). Postures: elbow_flexion=90;hip_flexion=45, the rest is 0. Names without side are "
      "right.");
  command.add_option("MODEL", o->model, "model file, or the word reference")->required();
  auto* arms = command.add_option("--reference", o->reference, "CSV file of published moment arms");
  auto* functions = command.add_option("--functions", o->functions, "CSV file of functions");
  command.add_flag("--all", o->all, "list every row, not those outside or wrong alone");
  command.callback([&commands, o, arms, functions] {
    commands.chosen = [&session = commands.session, o, with_arms = !arms->empty(),
                       with_functions = !functions->empty()] {
      if (!with_arms && !with_functions)
        throw InputError{{"sinew model moment-arms", "--reference", "a table, or one of --functions", "neither"}};
      const Model model = session.model(o->model);
      Json json{{"format", "sinew.moment_arm_judgement"}, {"version", 1}, {"model", o->model}};
      std::string text;
      const auto add = [&](const char* name, const Judgement& j) {
        json[name] = j.json;
        text += (text.empty() ? "" : "\n") + j.text;
      };
      if (with_arms)
        add("moment_arms",
            judgedArms(model, loadMomentArmReferences(o->reference, model.skeleton, model.musculature), o->all));
      if (with_functions)
        add("functions",
            judgedFunctions(model, loadFunctionReferences(o->functions, model.skeleton, model.musculature), o->all));
      session.result(json, text);
      return ExitStatus::Done;
    };
  });
}

}  // namespace sinew
