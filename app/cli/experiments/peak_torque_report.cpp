#include <algorithm>
#include <cmath>

#include "app/cli/experiments/experiment.h"
#include "app/cli/support/retarget_json.h"
#include "app/cli/support/text_table.h"
#include "app/experiments/experiment_shapes.h"
#include "app/experiments/missed_peaks.h"
#include "app/plot/svg_charts.h"
#include "core/retarget/prepared/reference.h"

namespace sinew {
namespace {

double off_deg(double angle_deg, const PeakTorqueAngle& a) {
  return std::abs(angle_deg - a.reference_deg);
}

/// One character's angles, and what is known of those that stay off.
struct Judged {
  const Character& character;
  std::vector<std::optional<MissedPeak>> missed;
  PeakCount count;
};

std::vector<Judged> judged(const RetargetReference& reference, const std::vector<Character>& characters) {
  std::vector<Judged> list;
  for (const Character& c : characters) {
    auto missed = missedPeaks(reference, c.retargeted);
    const PeakCount count = peakCount(c.retargeted.peak_torque, missed);
    list.push_back({c, std::move(missed), count});
  }
  return list;
}

std::string textOf(const MissedPeak& missed, const std::vector<PeakTorqueAngle>& angles) {
  if (missed.alone == PeakReach::Out) return "by no ratios";
  if (missed.alone == PeakReach::Undecided) return "not decided";
  return missed.instead_of ? "not with " + angles[*missed.instead_of].motion : "can be";
}

std::string textOf(const std::vector<Judged>& characters) {
  std::vector<std::vector<std::string>> totals, off;
  for (const Judged& j : characters) {
    const PeakCount& n = j.count;
    const std::string& name = j.character.body.name;
    totals.push_back({name, std::to_string(n.motions), std::to_string(n.before), std::to_string(n.after),
                      std::to_string(n.out_of_reach), std::to_string(n.instead), std::to_string(n.undecided),
                      fixed(n.worst_before_deg, 1), fixed(n.worst_after_deg, 1)});
    const auto& angles = j.character.retargeted.peak_torque;
    for (std::size_t m = 0; m < angles.size(); ++m)
      if (const PeakTorqueAngle& a = angles[m]; j.missed[m] && !a.motion.ends_with("_l"))
        off.push_back({name + ", " + a.motion, fixed(a.reference_deg, 1), fixed(a.before_deg, 1),
                       fixed(a.after_deg, 1), textOf(*j.missed[m], angles)});
  }
  std::string text = textTable({"", "motions", "within 3 deg before", "after", "by no ratios", "not with another",
                                "not decided", "worst before deg", "after deg"},
                               totals) +
                     "by no ratios: proven for that motion alone, every ratio within 30 % in steps of 0.5 %\n"
                     "not with another: proven for it and a motion that is within, in steps of 1 %\n";
  if (!off.empty())
    text += "off by more than 3 deg after (right side):\n" +
            textTable({"motion", "reference deg", "before deg", "after deg", "alone"}, off);
  return text;
}

/// The motions of the right side that were furthest off, a panel a character.
std::string figureOf(const std::vector<Character>& characters) {
  std::vector<BarPanel> panels;
  for (const Character& c : characters) {
    std::vector<const PeakTorqueAngle*> order;
    for (const PeakTorqueAngle& a : c.retargeted.peak_torque)
      if (std::isfinite(a.reference_deg) && std::isfinite(a.before_deg) && !a.motion.ends_with("_l") &&
          off_deg(a.before_deg, a) > 0.05)
        order.push_back(&a);
    if (order.empty()) continue;
    std::ranges::stable_sort(
        order, [](auto* a, auto* b) { return off_deg(a->before_deg, *a) > off_deg(b->before_deg, *b); });
    order.resize(std::min<std::size_t>(order.size(), 15));
    BarPanel panel{c.body.name, {}, {{}, {}}};
    for (const auto* a : order) {
      panel.names.push_back(a->motion);
      panel.values[0].push_back(off_deg(a->before_deg, *a));
      panel.values[1].push_back(std::isfinite(a->after_deg) ? off_deg(a->after_deg, *a) : 180);
    }
    panels.push_back(std::move(panel));
  }
  return panels.empty() ? ""
                        : barsSvg("How far the angle of peak torque is from the reference's", "off [deg]",
                                  {"ratios of the reference", "ratios optimised"}, panels, 40);
}

Json countJson(const PeakCount& n) {
  return {{"motions", n.motions},           {"within_before", n.before},
          {"within_after", n.after},        {"left", n.left},
          {"out_of_reach", n.out_of_reach}, {"not_with_another", n.instead},
          {"not_decided", n.undecided}};
}

std::vector<Verdict> verdictsOf(const PeakCount& n, const std::string& bodies) {
  const int reachable = n.motions - n.out_of_reach - n.instead;
  const auto of = [&](int count) { return std::to_string(count) + " of " + std::to_string(n.motions); };
  return {{bodies + ": motions within 3 deg before step 3", "", "reported", of(n.before), std::nullopt},
          {bodies + ": motions within 3 deg", "restored", "all", of(n.after), n.after == n.motions},
          {bodies + ": that no ratio within 30 % brings there, each alone", "", "reported", of(n.out_of_reach),
           std::nullopt},
          {bodies + ": that no ratio brings there together with one that is within", "", "reported", of(n.instead),
           std::nullopt},
          {bodies + ": of the others within 3 deg", "", "all",
           std::to_string(n.after) + " of " + std::to_string(reachable), n.after == reachable},
          {bodies + ": motions that step 3 takes out of 3 deg", "", "none", std::to_string(n.left), n.left == 0},
          {bodies + ": largest difference", "", "<= 3 deg", fixed(n.worst_after_deg, 1) + " deg",
           n.worst_after_deg <= kPeakTorqueTarget_deg}};
}

}  // namespace

ExperimentReport peakTorqueReport(ExperimentContext& context) {
  constexpr std::uint64_t kSeed = 31;  // of no other experiment
  const auto* characters = context.characters();
  if (!characters) return {.outcome = Outcome::Cancelled};
  const RetargetReference& reference = context.reference();
  const PeakCounts random = peakCounts(reference, randomShapes(context.quick() ? 1 : 20, {}, kSeed), context.job());
  if (random.outcome != Outcome::Converged) return {.outcome = random.outcome};
  ExperimentReport report{.outcome = Outcome::Converged};
  const std::vector<Judged> all = judged(reference, *characters);
  PeakCount sum;
  Json list = Json::array();
  for (const Judged& j : all) {
    sum += j.count;
    Json json{{"name", j.character.body.name}};
    json.update(countJson(j.count));
    json["angles"] = peakTorqueJson(j.character.retargeted.peak_torque);
    list.push_back(std::move(json));
  }
  report.result = {
      {"target_deg", kPeakTorqueTarget_deg}, {"characters", list}, {"random_bodies", countJson(random.count)}};
  report.text = textOf(all);
  report.verdicts = verdictsOf(sum, "characters");
  for (Verdict& v : verdictsOf(random.count, "random bodies")) report.verdicts.push_back(std::move(v));
  const std::string figure = figureOf(*characters);
  if (!figure.empty()) report.figures = {{"peak-torque", figure}};
  return report;
}

}  // namespace sinew
