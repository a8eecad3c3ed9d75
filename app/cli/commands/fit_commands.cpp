#include <cmath>
#include <memory>

#include "app/cli/support/commands.h"
#include "app/cli/support/swap_sides.h"
#include "app/cli/support/text_table.h"
#include "clinical/case/case_results_json.h"
#include "clinical/exam/physical_exam_json.h"
#include "clinical/pipeline/patient_fit.h"
#include "clinical/report/figure_texts.h"
#include "core/passive/structures.h"
#include "imaging/rig/biplanar_rig.h"

namespace sinew {
namespace {

/// Every figure with the same one the other way: fitted beside triangulated.
std::string figureTable(const std::vector<BoneFigure>& figures) {
  std::vector<std::vector<std::string>> rows;
  const auto interval = [](double lower, double upper) { return fixed(lower, 1) + " ... " + fixed(upper, 1); };
  for (const auto& f : figures)
    rows.push_back(
        {f.quantity, f.side, f.unit, fixed(f.value, 1), interval(f.lower95, f.upper95),
         f.triangulated ? "picks" : "model",
         std::isfinite(f.other) ? fixed(f.other, 1) + " (" + interval(f.other_lower95, f.other_upper95) + ")" : "",
         f.determined ? "" : "undetermined"});
  return textTable({"quantity", "side", "unit", "estimate", "95 % interval", "from", "the other way", ""}, rows);
}

/// What is taken from the picks and why, and what further landmarks would determine.
std::string figureRemarks(const SkeletonFit& fit, const NormTable& norms,
                          const std::vector<ProtocolLandmark>& protocol) {
  std::string text;
  for (const auto& line : triangulatedTexts(fit.figures, norms)) text += line + "\n";
  const auto advice = adviceTexts(fit.advice, norms, protocol);
  if (!advice.empty()) text += "\nNot determined yet:\n";
  for (const auto& line : advice) text += "  " + line + "\n";
  return text;
}

void addFit(Commands& commands) {
  struct Options {
    std::string rig, sightings, output;
    bool swap = false;
  };
  auto o = std::make_shared<Options>();
  auto& command = addCommand(commands.app, "fit", "shape and posture of the skeleton from landmark picks",
                             "sinew fit --rig rig.json --sightings picks.csv -o patient.json --json");
  command.add_option("--rig", o->rig, "rig file")->required();
  command.add_option("--sightings", o->sightings, "CSV file of picks: name,view,u_px,v_px[,sigma_px]")->required();
  command.add_option("-o,--output", o->output, "model file of the fitted shape");
  command.add_flag("--swap", o->swap, "exchange left and right where they are found exchanged");
  command.callback([&commands, o] {
    commands.chosen = [&session = commands.session, o] {
      const BiplanarRig rig = loadRig(o->rig);
      auto sightings = loadSightings(o->sightings);
      const auto exchanges = examineAndSwap(session, rig, sightings, o->swap);
      auto fit = fitPatient(session.reference().skeleton, rig, sightings, session.resourceDir(), session.job());
      session.warn(fit.warnings);
      if (fit.outcome == Outcome::Converged && disagreeGrossly(fit, exchanges)) {
        fit.outcome = Outcome::NotConverged;
        fit.figures.clear();  // withheld: they would be believed
      }
      std::string text =
          figureTable(fit.figures) + "\n" + std::string{nameOf(fit.outcome)} + ", reprojection RMS " +
          fixed(fit.rms_px, 2) + " px, " + std::to_string(fit.undetermined.size()) + " parameters undetermined\n" +
          figureRemarks(fit, loadNorms(session.resourceDir()), loadLandmarkProtocol(session.resourceDir()));
      if (fit.figures.empty()) text = "the picks disagree grossly: no figure is to be used\n" + text;
      if (fit.outcome == Outcome::Converged && !o->output.empty()) {
        saveModel(deformedModel(session.reference(), fit.shape), o->output);
        text += "written " + o->output + "\n";
      }
      Json json{{"format", "sinew.fit"}, {"version", 1}};
      json.update(skeletonFitToJson(fit));
      json["exchanged_sides"] = exchangesToJson(exchanges);
      session.result(json, text);
      return statusOf(fit.outcome);
    };
  });
}

/// The contract of `exam`.
Json examJson(const ExamFit& fit, double mass_kg) {
  Json json = examFitToJson(fit);
  Json result{{"format", "sinew.exam_fit"}, {"version", 1}, {"mass_kg", mass_kg}};
  for (auto& [key, value] : json.items())
    if (key != "seconds") result[key] = value;
  return result;
}

std::string examTable(const ExamFit& fit) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& t : fit.tests)
    rows.push_back(
        {t.test, std::string(1, t.side), t.measured_deg ? fixed(*t.measured_deg, 1) : "not measured",
         std::isfinite(t.norm_mean_deg) ? fixed(t.norm_mean_deg, 0) + " +- " + fixed(t.norm_sd_deg, 0) : "-",
         fixed(t.simulated_before_deg, 1), fixed(t.simulated_after_deg, 1), fixed(t.residual_deg, 1),
         fixed(t.threshold_Nm, 1), t.limited_by.empty() ? "" : t.limited_by.front()});
  return textTable(
      {"test", "side", "measured deg", "norm deg", "before deg", "after deg", "residual deg", "N m", "held by"},
      rows);
}

std::string factorTable(const ExamFit& fit, const ClinicalTests& tests) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& g : fit.groups)
    if (g.tested)
      rows.push_back({tests.group(g.group).title, std::string(1, g.side), fixed(g.factor, 3),
                      fixed(g.lower95, 2) + " ... " + fixed(g.upper95, 2), g.determined ? "" : "undetermined",
                      fixed(g.fiber_only_factor, 3)});
  if (rows.empty()) return "";
  return "\n" + textTable({"muscles", "side", "length factor", "95 % interval", "", "fibre only"}, rows) +
         (fit.left_in_norm
              ? "Inside the norm of the age, or within their SD of its mean, measurements change nothing "
                "(--solve-in-norm: they do).\n"
              : "Every measurement counts as it stands, inside the norm too.\n");
}

std::string reasonText(const ExamFit& fit) {
  std::string text;
  for (const auto& t : fit.tests)
    if (!t.reason.empty())
      text += t.test + " " + t.side + ": off by " + fixed(t.residual_deg, 1) + " deg, " + t.reason + "\n";
  return text.empty() ? text : "\n" + text;
}

void addExam(Commands& commands) {
  struct Options {
    std::string model, exam, output, sex;
    double mass_kg = 0, age_y = 0;
    bool solve_in_norm = false;
  };
  auto o = std::make_shared<Options>();
  auto& command =
      addCommand(commands.app, "exam", "muscle lengths that make the simulated examination meet the measured one",
                 "sinew exam reference --exam exam.json --mass-kg 42 --age-y 9 -o patient.json --json\n"
                 "  Without --exam: what the simulated examination of the model gives.");
  command.add_option("MODEL", o->model, "model file, or reference, reference:athlete")->required();
  command.add_option("--exam", o->exam, "physical examination (JSON)");
  auto* mass = command.add_option("--mass-kg", o->mass_kg,
                                  "body mass: the examiner's torque grows with it (the model's own unless given)");
  auto* age = command.add_option("--age-y", o->age_y, "age in years: whose norms count (an adult's unless given)");
  command.add_option("--sex", o->sex, "F or M: whose norms count");
  command.add_flag("--solve-in-norm", o->solve_in_norm,
                   "measurements inside the norm change lengths too; otherwise they leave them");
  command.callback([&commands, o, mass, age] {
    commands.chosen = [&session = commands.session, o, mass_given = mass->count() > 0, age_given = age->count() > 0] {
      if (mass_given && !(o->mass_kg >= 1 && o->mass_kg <= 400))
        throw InputError{{"sinew exam", "--mass-kg", "1 ... 400", std::to_string(o->mass_kg)}};
      if (age_given && !(o->age_y >= 0 && o->age_y <= 120))
        throw InputError{{"sinew exam", "--age-y", "0 ... 120", std::to_string(o->age_y)}};
      if (!o->sex.empty() && o->sex != "F" && o->sex != "M")
        throw InputError{{"sinew exam", "--sex", "F or M", o->sex}};
      const auto tests = loadClinicalTests(session.resourceDir());
      PhysicalExam exam = o->exam.empty() ? PhysicalExam{} : loadExam(o->exam);
      if (o->solve_in_norm) exam.leave_in_norm = false;
      const Model model = session.model(o->model);
      const ExamSubject subject{mass_given ? o->mass_kg : bodyMass_kg(model.skeleton),
                                age_given ? std::optional{o->age_y} : std::nullopt, o->sex};
      const auto fit = applyExam(model, exam, tests, subject, session.job());
      session.warn(fit.warnings);
      std::string text = examTable(fit) + factorTable(fit, tests) + reasonText(fit);
      if (fit.outcome == Outcome::Converged && !o->output.empty()) {
        saveModel(withLengthFactors(model, fit.length_factors), o->output);
        text += "\nwritten " + o->output + "\n";
      }
      session.result(examJson(fit, subject.mass_kg), text);
      return statusOf(fit.outcome);
    };
  });
}

}  // namespace

void addFitCommand(Commands& commands) {
  addFit(commands);
}
void addExamCommand(Commands& commands) {
  addExam(commands);
}

}  // namespace sinew
