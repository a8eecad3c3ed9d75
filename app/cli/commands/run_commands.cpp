#include <memory>

#include "app/cli/support/case_runner.h"
#include "app/cli/support/commands.h"
#include "clinical/case/case_io.h"
#include "clinical/pipeline/pipeline.h"
#include "clinical/pipeline/side_check.h"
#include "clinical/synthetic/synthetic_case.h"
#include "core/file.h"
#include "core/retarget/prepared/reference.h"
#include "core/text.h"

namespace sinew {
namespace {

std::optional<Stage> stageOption(const std::string& name) {
  return name.empty() ? std::nullopt : std::optional{stageFromName(name)};
}

/// Runs as far as the landmarks and gives the picks that were found exchanged the names of the other side.
RunReport swapSides(Case& c, const std::filesystem::path& folder, Session& session) {
  RunReport report = runAndStore(c, folder, {{}, Stage::Landmarks}, session);
  if (report.refused || report.status != ExitStatus::Done) return report;
  if (c.exchanged_sides.empty()) {
    session.note("note: no exchange of left and right was found; nothing is exchanged");
    return report;
  }
  applyExchange(c.sightings, c.exchanged_sides);
  c.exchanged_sides.clear();
  saveCase(c, folder);
  session.note("note: left and right exchanged as named");
  return report;
}

void addRun(Commands& commands) {
  struct Options {
    std::filesystem::path folder;
    std::string from, to;
    bool swap = false;
  };
  auto o = std::make_shared<Options>();
  auto& command = addCommand(commands.app, "run", "run the stages of a case that are not done",
                             "sinew run mycase --to skeleton\n"
                             "  Stages: images calibration landmarks skeleton musculature exam report.\n"
                             "  Without --to: as far as what was entered allows.");
  command.add_option("CASE", o->folder, "case folder")->required();
  command.add_option("--from", o->from, "run this stage and those after it even if they are done");
  command.add_option("--to", o->to, "last stage to run");
  command.add_flag("--swap", o->swap, "exchange left and right where the landmarks stage finds them exchanged");
  command.callback([&commands, o] {
    commands.chosen = [&session = commands.session, o] {
      const RunRequest request{stageOption(o->from), stageOption(o->to)};
      Case c;
      if (o->swap) {
        const RunReport report = swapSides(c, o->folder, session);
        if (report.refused || report.status != ExitStatus::Done)
          return finishRun(c, o->folder, report, "sinew.run", session);
      }
      const RunReport report = runAndStore(c, o->folder, request, session);
      return finishRun(c, o->folder, report, "sinew.run", session);
    };
  });
}

/// Runs the report stage alone: a report is never made from stale results.
void addReport(Commands& commands) {
  struct Options {
    std::filesystem::path folder, output;
  };
  auto o = std::make_shared<Options>();
  auto& command = addCommand(commands.app, "report", "write the report of a case whose other stages are done",
                             "sinew report mycase -o report.pdf");
  command.add_option("CASE", o->folder, "case folder")->required();
  command.add_option("-o,--output", o->output, "copy of the report");
  command.callback([&commands, o] {
    commands.chosen = [&session = commands.session, o] {
      Case c = loadCase(o->folder);
      const auto reasons = reasonsAgainstReport(c, session.resourceDir());
      if (!reasons.empty()) {
        std::string all;
        for (const auto& reason : reasons) all += (all.empty() ? "" : "; ") + reason;
        throw InputError{{o->folder.string(), "report", "every stage done", all}};
      }
      // What is done is copied, not drawn again: the folder may be one that can only be read.
      const RunReport report = runAndStore(c, o->folder, {{}, Stage::Report}, session);
      if (report.status == ExitStatus::Done && !o->output.empty())
        writeFileAtomically(o->output, readFile(checkedFile(*c.report, o->folder)));
      return finishRun(c, o->folder, report, "sinew.report", session);
    };
  });
}

void addDemo(Commands& commands) {
  struct Options {
    std::filesystem::path folder = "sinew-demo";
    unsigned seed = 1;
    std::string rig = "cone-beam";
    int binning = 1, views = 2;
  };
  auto o = std::make_shared<Options>();
  auto& command = addCommand(commands.app, "demo",
                             "make the embedded synthetic patient, run the whole way, compare with the truth",
                             "sinew demo --out demo --seed 7 --rig slot-scan");
  command.add_option("--out", o->folder, "case folder to make")->capture_default_str();
  command.add_option("--seed", o->seed, "which patient")->capture_default_str();
  command.add_option("--rig", o->rig, "cone-beam (pair calibrated from a bead phantom) or slot-scan")
      ->capture_default_str();
  command.add_option("--views", o->views, "3: with an oblique film (cone beam only)")
      ->capture_default_str()
      ->check(CLI::Range(2, 3));
  command.add_option("--binning", o->binning, "detector pixels joined into one: 2 quarters size and time")
      ->capture_default_str()
      ->check(CLI::Range(1, 4));
  command.callback([&commands, o] {
    commands.chosen = [&session = commands.session, o] {
      const std::vector<std::string> rigs = {"cone-beam", "slot-scan"};
      if (std::ranges::find(rigs, o->rig) == rigs.end())
        throw InputError{
            {"sinew demo", "--rig", "cone-beam or slot-scan", "'" + o->rig + "'" + didYouMean(o->rig, rigs)}};
      if (o->views == 3 && o->rig == rigs[1])
        throw InputError{{"sinew demo", "--views", "2 for a slot scan, which makes both at once", "3"}};
      expectDemoFolder(o->folder);
      SyntheticOptions options;
      options.resource_dir = session.resourceDir();
      options.seed = o->seed;
      options.binning = o->binning;
      options.views = o->views;
      options.rig = o->rig == rigs[0] ? SyntheticRig::ConeBeam : SyntheticRig::SlotScan;
      const auto patient = drawSyntheticPatient(*session.retargeting(), options);
      Case c = writeSyntheticCase(patient, session.reference(), options, o->folder, session.job());
      if (session.job().cancelled()) {
        session.result(
            {{"format", "sinew.demo"}, {"version", 1}, {"outcome", "cancelled"}, {"stages", Json::array()}},
            "cancelled\n");
        return ExitStatus::NotConverged;
      }
      const RunReport report = runAndStore(c, o->folder, {}, session);
      return finishRun(c, o->folder, report, "sinew.demo", session);
    };
  });
}

}  // namespace

void addRunCommands(Commands& commands) {
  addDemo(commands);
  addRun(commands);
  addReport(commands);
}

}  // namespace sinew
