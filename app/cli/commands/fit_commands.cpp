#include <cmath>
#include <memory>

#include "app/cli/support/commands.h"
#include "app/cli/support/text_table.h"
#include "clinical/case/case_results_json.h"
#include "clinical/exam/physical_exam.h"
#include "clinical/pipeline/patient_fit.h"
#include "clinical/report/figure_texts.h"
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
  };
  auto o = std::make_shared<Options>();
  auto& command = addCommand(commands.app, "fit", "shape and posture of the skeleton from landmark picks",
                             "sinew fit --rig rig.json --sightings picks.csv -o patient.json --json");
  command.add_option("--rig", o->rig, "rig file")->required();
  command.add_option("--sightings", o->sightings, "CSV file of picks: name,view,u_px,v_px[,sigma_px]")->required();
  command.add_option("-o,--output", o->output, "model file of the fitted shape");
  command.callback([&commands, o] {
    commands.chosen = [&session = commands.session, o] {
      const BiplanarRig rig = loadRig(o->rig);
      const auto sightings = loadSightings(o->sightings);
      const auto fit = fitPatient(session.reference().skeleton, rig, sightings, session.resourceDir(), session.job());
      session.warn(fit.warnings);
      std::string text =
          figureTable(fit.figures) + "\n" + std::string{nameOf(fit.outcome)} + ", reprojection RMS " +
          fixed(fit.rms_px, 2) + " px, " + std::to_string(fit.undetermined.size()) + " parameters undetermined\n" +
          figureRemarks(fit, loadNorms(session.resourceDir()), loadLandmarkProtocol(session.resourceDir()));
      if (fit.outcome == Outcome::Converged && !o->output.empty()) {
        saveModel(deformedModel(session.reference(), fit.shape), o->output);
        text += "written " + o->output + "\n";
      }
      Json json{{"format", "sinew.fit"}, {"version", 1}};
      json.update(skeletonFitToJson(fit));
      session.result(json, text);
      return statusOf(fit.outcome);
    };
  });
}

/// The contract of `exam`.
Json examJson(const ExamFit& fit) {
  Json tests = Json::array();
  for (const auto& t : fit.tests) {
    Json changed = Json::array();
    for (const auto& c : t.changed) changed.push_back({{"muscle", c.muscle}, {"length_factor", c.factor}});
    tests.push_back({{"test", t.test},
                     {"side", std::string(1, t.side)},
                     {"measured_deg", numberOrNull(t.measured_deg)},
                     {"simulated_before_deg", numberOrNull(t.simulated_before_deg)},
                     {"simulated_after_deg", numberOrNull(t.simulated_after_deg)},
                     {"residual_deg", numberOrNull(t.residual_deg)},
                     {"threshold_Nm", t.threshold_Nm},
                     {"stopped_by_joint", t.stopped_by_joint},
                     {"limiting_muscles", t.limiting_muscles},
                     {"changed", changed}});
  }
  return {{"format", "sinew.exam_fit"},
          {"version", 1},
          {"outcome", nameOf(fit.outcome)},
          {"tests", tests},
          {"warnings", warningsToJson(fit.warnings)}};
}

std::string examTable(const ExamFit& fit) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& t : fit.tests)
    rows.push_back({t.test, std::string(1, t.side), t.measured_deg ? fixed(*t.measured_deg, 1) : "not measured",
                    fixed(t.simulated_before_deg, 1), fixed(t.simulated_after_deg, 1), fixed(t.residual_deg, 1),
                    t.limiting_muscles.empty() ? (t.stopped_by_joint ? "joint" : "") : t.limiting_muscles.front()});
  return textTable({"test", "side", "measured deg", "before deg", "after deg", "residual deg", "limited by"}, rows);
}

void addExam(Commands& commands) {
  struct Options {
    std::string model, exam, output;
    double mass_kg = 75;
  };
  auto o = std::make_shared<Options>();
  auto& command =
      addCommand(commands.app, "exam", "muscle lengths that make the simulated examination meet the measured one",
                 "sinew exam reference --exam exam.json --mass-kg 42 -o patient.json --json\n"
                 "  Without --exam: what the simulated examination of the model gives.");
  command.add_option("MODEL", o->model, "model file, or reference, reference:athlete")->required();
  command.add_option("--exam", o->exam, "physical examination (JSON)");
  command.add_option("--mass-kg", o->mass_kg, "body mass: the examiner's torque grows with it")
      ->capture_default_str();
  command.add_option("-o,--output", o->output, "model file with the new lengths");
  command.callback([&commands, o] {
    commands.chosen = [&session = commands.session, o] {
      if (!(o->mass_kg >= 1 && o->mass_kg <= 400))
        throw InputError{{"sinew exam", "--mass-kg", "1 ... 400", std::to_string(o->mass_kg)}};
      const auto protocol = loadExamProtocol(session.resourceDir());
      const PhysicalExam exam = o->exam.empty() ? PhysicalExam{} : loadExam(o->exam);
      const Model model = session.model(o->model);
      const auto fit = applyExam(model, exam, protocol, o->mass_kg, session.job());
      session.warn(fit.warnings);
      std::string text = examTable(fit);
      if (fit.outcome == Outcome::Converged && !o->output.empty()) {
        saveModel(withLengthFactors(model, fit.length_factors), o->output);
        text += "\nwritten " + o->output + "\n";
      }
      session.result(examJson(fit), text);
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
