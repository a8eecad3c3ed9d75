#include <algorithm>

#include "app/cli/experiments/experiment.h"
#include "app/cli/support/text_table.h"
#include "app/experiments/experiment_shapes.h"
#include "app/experiments/method_comparison.h"
#include "app/plot/svg_charts.h"
#include "core/retarget/prepared/reference.h"

namespace sinew {
namespace {

struct Sums {
  MethodTime routing_paper, routing_sinew, whole_paper, whole_sinew;
  PeakTorqueTotals peaks_paper, peaks_sinew;
};

Sums sumOf(const MethodComparison& found) {
  Sums sum;
  const auto add = [](MethodTime& to, const MethodTime& t) { to.cpu_s += t.cpu_s, to.wall_s += t.wall_s; };
  const auto addPeaks = [](PeakTorqueTotals& to, const PeakTorqueTotals& t) {
    to.motions += t.motions, to.within_before += t.within_before, to.within_after += t.within_after;
  };
  for (const BodyComparison& body : found.bodies) {
    add(sum.routing_paper, body.routing_paper), add(sum.routing_sinew, body.routing_sinew);
    add(sum.whole_paper, body.whole_paper), add(sum.whole_sinew, body.whole_sinew);
    addPeaks(sum.peaks_paper, body.peaks_paper), addPeaks(sum.peaks_sinew, body.peaks_sinew);
  }
  return sum;
}

std::string ratioText(const MethodTime& paper, const MethodTime& sinew) {
  return fixed(paper.cpu_s / sinew.cpu_s, 1) + " x CPU, " + fixed(paper.wall_s / sinew.wall_s, 1) + " x wall";
}

KeptFunctions sumOf(const std::vector<KeptFunctions>& list) {
  KeptFunctions sum;
  for (const KeptFunctions& k : list) {
    sum.shortenings += k.shortenings, sum.shortenings_kept += k.shortenings_kept;
    sum.moment_arms += k.moment_arms, sum.moment_arms_kept += k.moment_arms_kept;
    sum.lost.insert(sum.lost.end(), k.lost.begin(), k.lost.end());
  }
  return sum;
}

std::vector<Verdict> verdictsOf(const EnergyVerdict& e, const Sums& t, const KeptFunctions& kept,
                                const KeptFunctions& naive) {
  constexpr double kFaster = 10, kKept = 0.995, kLower = 0.99;
  const double lower = double(e.lower) / e.compared, improvable = double(e.lower) / (e.compared - e.equal_at_start);
  return {{"units with lower energy than by the paper's method", "", ">= 99 %",
           percentText(lower) + "; " + percentText(improvable) + " without " + std::to_string(e.equal_at_start) +
               " that neither method improves",
           improvable >= kLower},
          {"units higher by more than 1 %", "", "none",
           std::to_string(e.higher_by_one_percent) + " of " + std::to_string(e.compared) + "; in " +
               std::to_string(e.higher_for_order) + " of them the paper's reverses more",
           e.higher_by_one_percent == 0},
          {"energy of all: start, paper, sinew", "", "reported",
           fixed(e.sum_start, 1) + ", " + fixed(e.sum_paper, 1) + ", " + fixed(e.sum_sinew, 1), std::nullopt},
          {"routing is faster", "", ">= 10 x", ratioText(t.routing_paper, t.routing_sinew),
           t.routing_paper.cpu_s >= kFaster * t.routing_sinew.cpu_s},
          {"the whole body is faster", "", ">= 10 x", ratioText(t.whole_paper, t.whole_sinew),
           t.whole_paper.cpu_s >= kFaster * t.whole_sinew.cpu_s},
          {"motions whose peak torque is within 3 deg: paper, sinew", "", "no fewer",
           std::to_string(t.peaks_paper.within_after) + ", " + std::to_string(t.peaks_sinew.within_after) + " of " +
               std::to_string(t.peaks_sinew.motions),
           t.peaks_sinew.within_after >= t.peaks_paper.within_after},
          {"functions kept in mild shapes, bones alone", "", "reported", percentText(naive.share(), 2), std::nullopt},
          {"functions kept in mild shapes, retargeted", "", ">= 99.5 %", percentText(kept.share(), 2),
           kept.share() >= kKept}};
}

std::string textOf(const MethodComparison& found, const EnergyVerdict& all, const KeptFunctions& kept) {
  std::vector<std::vector<std::string>> rows;
  for (const BodyComparison& body : found.bodies) {
    const EnergyVerdict e = energyVerdict(found.units, body);
    rows.push_back({body.name, std::to_string(e.compared), std::to_string(e.lower), std::to_string(e.equal),
                    std::to_string(e.higher), std::to_string(e.higher_by_one_percent), fixed(e.sum_start, 1),
                    fixed(e.sum_paper, 1), fixed(e.sum_sinew, 1), fixed(body.paper_energy_paper, 1),
                    fixed(body.paper_energy_sinew, 1), fixed(body.routing_paper.cpu_s, 2),
                    fixed(body.routing_sinew.cpu_s, 2), fixed(body.whole_paper.cpu_s, 2),
                    fixed(body.whole_sinew.cpu_s, 2), std::to_string(body.peaks_paper.within_after),
                    std::to_string(body.peaks_sinew.within_after)});
  }
  std::string text =
      textTable({"body", "units", "lower", "equal", "higher", "> 1 %", "start", "paper", "sinew", "E paper",
                 "E sinew", "CPU s paper", "sinew", "whole paper", "sinew", "peaks paper", "sinew"},
                rows) +
      "E: the paper's own energy, E_direction + 10 E_length. CPU: routing, then all steps, by either "
      "method. Peaks: motions whose angle of peak torque is within 3 deg.\n";
  if (!all.worst_unit.empty())
    text += "furthest above the paper's: " + all.worst_unit + ", x " + fixed(all.worst_ratio, 3) + "\n";
  if (!kept.lost.empty()) {
    text += "functions lost in mild shapes:";
    for (std::size_t i = 0; i < std::min<std::size_t>(kept.lost.size(), 12); ++i)
      text += (i ? "; " : " ") + kept.lost[i];
    text += kept.lost.size() > 12 ? "; and " + std::to_string(kept.lost.size() - 12) + " more\n" : "\n";
  }
  return text;
}

Json timeJson(const MethodTime& t) {
  return {{"cpu", t.cpu_s}, {"wall", t.wall_s}};
}

Json keptJson(const KeptFunctions& kept) {
  return {{"shortenings", kept.shortenings}, {"shortenings_kept", kept.shortenings_kept},
          {"moment_arms", kept.moment_arms}, {"moment_arms_kept", kept.moment_arms_kept},
          {"share", kept.share()},           {"lost", kept.lost}};
}

Json verdictJson(const EnergyVerdict& e) {
  return {{"units", e.compared},
          {"lower", e.lower},
          {"equal", e.equal},
          {"equal_at_start", e.equal_at_start},
          {"higher", e.higher},
          {"higher_by_one_percent", e.higher_by_one_percent},
          {"higher_for_order", e.higher_for_order},
          {"worst_ratio", e.worst_ratio},
          {"worst_unit", e.worst_unit},
          {"sum_start", e.sum_start},
          {"sum_paper", e.sum_paper},
          {"sum_sinew", e.sum_sinew}};
}

Json resultJson(const MethodComparison& found, const EnergyVerdict& all, const FunctionKeeping& keeping) {
  Json bodies = Json::array();
  for (const BodyComparison& body : found.bodies) {
    Json json{{"name", body.name}};
    json.update(verdictJson(energyVerdict(found.units, body)));
    json["paper_energy"] = {{"paper", body.paper_energy_paper}, {"sinew", body.paper_energy_sinew}};
    json["seconds"] = {{"routing_paper", timeJson(body.routing_paper)},
                       {"routing_sinew", timeJson(body.routing_sinew)},
                       {"whole_paper", timeJson(body.whole_paper)},
                       {"whole_sinew", timeJson(body.whole_sinew)}};
    json["peaks_within"] = {{"motions", body.peaks_sinew.motions},
                            {"before", body.peaks_sinew.within_before},
                            {"paper", body.peaks_paper.within_after},
                            {"sinew", body.peaks_sinew.within_after}};
    bodies.push_back(std::move(json));
  }
  return {{"all", verdictJson(all)},
          {"bodies", bodies},
          {"functions",
           {{"bodies", keeping.retargeted.size()},
            {"naive", keptJson(sumOf(keeping.naive))},
            {"retargeted", keptJson(sumOf(keeping.retargeted))}}}};
}

std::string figureOf(const MethodComparison& found) {
  BarPanel panel{"share of the start's energy that is left", {}, {{}, {}}};
  for (const BodyComparison& body : found.bodies) {
    const EnergyVerdict e = energyVerdict(found.units, body);
    if (e.compared == 0) continue;
    panel.names.push_back(body.name);
    panel.values[0].push_back(100 * e.sum_paper / e.sum_start);
    panel.values[1].push_back(100 * e.sum_sinew / e.sum_start);
  }
  return barsSvg("Energy of all units after routing", "energy left [%]", {"paper", "sinew"}, {panel}, 60);
}

}  // namespace

ExperimentReport energyReport(ExperimentContext& context) {
  constexpr std::uint64_t kSeed = 2026, kMildSeed = 4;
  std::vector<NamedShape> shapes;
  const int random = context.quick() ? 1 : 20, mild = context.quick() ? 1 : 20;
  if (!context.quick())
    for (const char* name : {"human", "alien", "hulk", "dwarf"})
      shapes.push_back({name, loadShapePreset(context.session().resourceDir(), name).shape});
  int number = 0;
  for (const ShapeParameters& shape : randomShapes(random, {}, kSeed))
    shapes.push_back({"random " + std::to_string(++number), shape});
  const MethodComparison found = compareMethods(context.reference(), shapes, context.job());
  if (found.outcome != Outcome::Converged) return {.outcome = found.outcome};
  const FunctionKeeping keeping =
      functionKeeping(context.reference(), randomShapes(mild, kMildShapes, kMildSeed), context.job());
  if (keeping.outcome != Outcome::Converged) return {.outcome = keeping.outcome};
  const EnergyVerdict all = energyVerdict(found);
  const KeptFunctions kept = sumOf(keeping.retargeted);
  return {.outcome = Outcome::Converged,
          .verdicts = verdictsOf(all, sumOf(found), kept, sumOf(keeping.naive)),
          .text = textOf(found, all, kept),
          .result = resultJson(found, all, keeping),
          .figures = {{"energy", figureOf(found)}}};
}

}  // namespace sinew
