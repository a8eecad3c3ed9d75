#include <algorithm>
#include <memory>

#include "app/cli/support/commands.h"
#include "app/cli/support/text_table.h"
#include "core/model/rom_preset.h"
#include "core/passive/structures.h"
#include "core/rom/tests/rom_report.h"

namespace sinew {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& w : words) text += (text.empty() ? "" : ", ") + w;
  return text;
}

std::string normText(const TestNorm& norm) {
  if (!norm.known()) return "-";
  if (std::isnan(norm.mean_deg))
    return norm.accept_min_deg == norm.accept_max_deg
               ? fixed(norm.accept_min_deg, 0)
               : fixed(norm.accept_min_deg, 0) + " .. " + fixed(norm.accept_max_deg, 0);
  return fixed(norm.mean_deg, 0) + (std::isnan(norm.sd_deg) ? "" : " +- " + fixed(norm.sd_deg, 0));
}

Json normJson(const TestNorm& norm) {
  return {{"mean_deg", numberOrNull(norm.mean_deg)},
          {"sd_deg", numberOrNull(norm.sd_deg)},
          {"accept_deg", {numberOrNull(norm.accept_min_deg), numberOrNull(norm.accept_max_deg)}}};
}

Json reportJson(const RomReport& report, const std::string& model, const std::string& preset, double mass_kg) {
  Json tests = Json::array(), couplings = Json::array();
  for (const auto& l : report.tests)
    tests.push_back({{"test", l.test->id},
                     {"title", l.test->title},
                     {"simulated_deg", numberOrNull(l.reading.angle_deg)},
                     {"threshold_Nm", l.threshold_Nm},
                     {"moment_Nm", numberOrNull(l.reading.moment_Nm)},
                     {"structures_Nm", numberOrNull(l.reading.structures_Nm)},
                     {"norm", normJson(l.norm)},
                     {"difference_deg", numberOrNull(l.off_deg)},
                     {"accepted", l.accepted},
                     {"stopped_by_joint", l.reading.stopped_by_joint},
                     {"limited_by", l.reading.limited_by},
                     {"expected_limit", l.test->limited_by},
                     {"source", l.test->source},
                     {"confidence", l.test->confidence}});
  for (const auto& l : report.couplings)
    couplings.push_back({{"coupling", l.coupling->id},
                         {"title", l.coupling->title},
                         {"simulated_deg", numberOrNull(l.difference_deg)},
                         {"norm", normJson(l.norm)},
                         {"difference_deg", numberOrNull(l.off_deg)},
                         {"right_way", l.right_way}});
  return {{"format", "sinew.rom_tests"}, {"version", 1},   {"model", model},        {"norms", preset},
          {"mass_kg", mass_kg},          {"tests", tests}, {"couplings", couplings}};
}

std::string reportText(const RomReport& report, const std::string& preset) {
  std::vector<std::vector<std::string>> tests, couplings;
  std::size_t accepted = 0;
  for (const auto& l : report.tests) {
    accepted += l.accepted;
    tests.push_back({l.test->id, fixed(l.reading.angle_deg, 1), normText(l.norm), fixed(l.off_deg, 1),
                     l.accepted ? "" : "outside", fixed(l.threshold_Nm, 0), joined(l.reading.limited_by)});
  }
  for (const auto& l : report.couplings)
    couplings.push_back({l.coupling->id, fixed(l.difference_deg, 1), normText(l.norm), fixed(l.off_deg, 1),
                         l.right_way ? "" : "wrong way"});
  return "norms: " + preset + "\n" + textTable({"test", "simulated", "norm", "off", "", "N m", "held by"}, tests) +
         std::to_string(accepted) + " of " + std::to_string(tests.size()) + " inside the accepted range\n\n" +
         textTable({"coupling", "simulated", "norm", "off", ""}, couplings);
}

}  // namespace

void addRomTestsCommand(Commands& commands) {
  struct Options {
    std::string model, preset;
    double mass_kg = 0;
  };
  auto o = std::make_shared<Options>();
  auto& command = addCommand(
      commands.app, "rom-tests", "clinical range-of-motion tests simulated on a model, against published norms",
      "sinew rom-tests reference:athlete\n"
      "  Degrees in the signs of the coordinates. A test ends where the passive moment reaches "
      "its threshold\n  or the joint its stop; thresholds scale with body mass. Norms: those of the model's preset, "
      "else of the "
      "average adult.");
  command.add_option("MODEL", o->model, "model file, or reference, reference:athlete")->required();
  command.add_option("--norms", o->preset, "average-adult or athlete");
  auto* mass = command.add_option("--mass-kg", o->mass_kg,
                                  "body mass: the examiner's torque grows with it (the model's own unless given)");
  command.callback([&commands, o, mass] {
    commands.chosen = [&session = commands.session, o, mass_given = mass->count() > 0] {
      if (mass_given && !(o->mass_kg >= 1 && o->mass_kg <= 400))
        throw InputError{{"sinew rom-tests", "--mass-kg", "1 ... 400", std::to_string(o->mass_kg)}};
      const Model model = session.model(o->model);
      const double mass_kg = mass_given ? o->mass_kg : bodyMass_kg(model.skeleton);
      const std::string preset =
          o->preset.empty() ? presetOf(model.name).value_or(std::string{kDefaultPreset}) : o->preset;
      loadRomPreset(session.resourceDir(), preset, model.skeleton);  // must exist
      const ClinicalTests tests = loadClinicalTests(session.resourceDir(), model.skeleton);
      const RomReport report = romReport(model, tests, preset, mass_kg, session.job());
      session.result(reportJson(report, o->model, preset, mass_kg), reportText(report, preset));
      return statusOf(report.outcome);
    };
  });
}

}  // namespace sinew
