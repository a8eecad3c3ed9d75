#include <chrono>
#include <memory>

#include "app/cli/experiments/experiment.h"
#include "app/cli/support/commands.h"
#include "app/cli/support/text_table.h"
#include "app/plot/svg_to_png.h"
#include "core/file.h"
#include "core/text.h"

namespace sinew {
namespace {

constexpr double kPngScale = 1.5;

struct ExperimentOptions {
  std::string name, reference = "reference";
  std::filesystem::path folder = "experiments";
  bool quick = false;
};

std::vector<const Experiment*> chosenExperiments(const std::string& name) {
  std::vector<const Experiment*> chosen;
  std::vector<std::string> known = {"all"};
  for (const Experiment& experiment : experiments()) {
    if (name == "all" || name == experiment.name) chosen.push_back(&experiment);
    known.push_back(experiment.name);
  }
  if (chosen.empty()) {
    std::string names;
    for (const auto& k : known) names += (names.empty() ? "" : ", ") + k;
    throw InputError{{"sinew experiment", "NAME", names, "'" + name + "'" + didYouMean(name, known)}};
  }
  return chosen;
}

std::string metText(const Verdict& v) {
  return !v.met ? "" : *v.met ? "yes" : "NO";
}

std::string verdictTable(const std::vector<Verdict>& verdicts) {
  std::vector<std::vector<std::string>> rows;
  for (const Verdict& v : verdicts) rows.push_back({v.what, v.paper, v.target, v.ours, metText(v)});
  return textTable({"", "paper", "ours must reach", "ours", "met"}, rows);
}

/// Writes figures and JSON of one experiment. @returns its entry of the document.
Json written(const Experiment& experiment, const ExperimentReport& report, double seconds,
             const ExperimentOptions& o) {
  Json verdicts = Json::array(), files = Json::array();
  for (const Verdict& v : report.verdicts)
    verdicts.push_back({{"what", v.what},
                        {"paper", v.paper},
                        {"target", v.target},
                        {"ours", v.ours},
                        {"met", v.met ? Json(*v.met) : Json(nullptr)}});
  for (const ExperimentFigure& figure : report.figures) {
    const auto svg = o.folder / (figure.name + ".svg"), png = o.folder / (figure.name + ".png");
    writeFileAtomically(svg, figure.svg);
    writeFileAtomically(png, pngFromSvg(figure.svg, kPngScale));
    files.push_back(svg.string()), files.push_back(png.string());
  }
  for (const auto& model : report.models) files.push_back(model.string());
  Json entry{{"name", experiment.name},  {"title", experiment.title}, {"outcome", nameOf(report.outcome)},
             {"reference", o.reference}, {"quick", o.quick},          {"seconds", seconds},
             {"verdicts", verdicts},     {"result", report.result},   {"files", files}};
  const auto json = o.folder / (experiment.name + ".json");
  Json document{{"format", "sinew.experiment"}, {"version", 1}};
  document.update(entry);
  writeFileAtomically(json, jsonText(document));
  entry["files"].push_back(json.string());
  return entry;
}

ExitStatus runExperiments(const ExperimentOptions& o, Session& session) {
  const auto chosen = chosenExperiments(o.name);
  std::filesystem::create_directories(o.folder);
  ExperimentContext context{session, o.reference, o.folder, o.quick};
  Json document{{"format", "sinew.experiments"}, {"version", 1}, {"outcome", nameOf(Outcome::Converged)}};
  Json list = Json::array();
  std::vector<Verdict> all;
  ExitStatus status = ExitStatus::Done;
  for (const Experiment* experiment : chosen) {
    const auto start = std::chrono::steady_clock::now();
    const ExperimentReport report = experiment->run(context);
    if (report.outcome != Outcome::Converged) {
      document["outcome"] = nameOf(report.outcome);
      status = statusOf(report.outcome);
      break;
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    list.push_back(written(*experiment, report, seconds, o));
    session.resultLine("== " + experiment->name + ": " + experiment->title + " (" + fixed(seconds, 1) + " s)\n" +
                       report.text + "\n" + verdictTable(report.verdicts));
    for (Verdict v : report.verdicts) {
      v.what = experiment->name + ": " + v.what;
      all.push_back(std::move(v));
    }
  }
  document["experiments"] = list;
  std::string text = status == ExitStatus::Done ? "" : document["outcome"].get<std::string>() + "\n";
  if (list.size() > 1) text += "== all\n" + verdictTable(all);
  session.result(document, text + "written " + o.folder.string() + "\n");
  return status;
}

}  // namespace

void addExperimentCommand(Commands& commands) {
  auto o = std::make_shared<ExperimentOptions>();
  std::string about = "the experiments of Ryu et al., their figures beside ours:";
  for (const Experiment& experiment : experiments()) about += " " + experiment.name + ",";
  auto& command =
      addCommand(commands.app, "experiment", about + " all", "sinew experiment rom-preservation --out figures");
  command.add_option("NAME", o->name, "experiment, or all")->required();
  command.add_option("--out", o->folder, "folder for JSON, SVG, PNG and models")->capture_default_str();
  command.add_option("--reference", o->reference, "reference or reference:athlete")->capture_default_str();
  command.add_flag("--quick", o->quick, "few bodies: to see that it runs");
  command.callback(
      [&commands, o] { commands.chosen = [&session = commands.session, o] { return runExperiments(*o, session); }; });
}

}  // namespace sinew
