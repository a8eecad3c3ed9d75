#include <algorithm>
#include <cmath>

#include "app/cli/experiments/experiment.h"
#include "app/cli/retarget_json.h"
#include "app/cli/svg_charts.h"
#include "app/cli/text_table.h"

namespace sinew {
namespace {

double off_deg(double angle_deg, const PeakTorqueAngle& a) {
  return std::abs(angle_deg - a.reference_deg);
}

std::string textOf(const std::vector<Character>& characters) {
  std::vector<std::vector<std::string>> totals, off;
  for (const Character& c : characters) {
    const PeakTorqueTotals t = peakTorqueTotals(c.retargeted.peak_torque);
    totals.push_back({c.body.name, std::to_string(t.motions), std::to_string(t.within_before),
                      std::to_string(t.within_after), fixed(t.worst_before_deg, 1), fixed(t.worst_after_deg, 1)});
    for (const PeakTorqueAngle& a : c.retargeted.peak_torque)
      if (std::isfinite(a.reference_deg) && !a.motion.ends_with("_l") &&
          !(off_deg(a.after_deg, a) <= kPeakTorqueTarget_deg))
        off.push_back({c.body.name + ", " + a.motion, fixed(a.reference_deg, 1), fixed(a.before_deg, 1),
                       fixed(a.after_deg, 1)});
  }
  std::string text =
      textTable({"", "motions", "within 3 deg before", "after", "worst before deg", "after deg"}, totals);
  if (!off.empty())
    text += "off by more than 3 deg after (right side):\n" +
            textTable({"motion", "reference deg", "before deg", "after deg"}, off);
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

}  // namespace

ExperimentReport peakTorqueReport(ExperimentContext& context) {
  const auto* characters = context.characters();
  if (!characters) return {.outcome = Outcome::Cancelled};
  ExperimentReport report{.outcome = Outcome::Converged};
  int motions = 0, before = 0, after = 0;
  double worst_deg = 0;
  Json list = Json::array();
  for (const Character& c : *characters) {
    const PeakTorqueTotals t = peakTorqueTotals(c.retargeted.peak_torque);
    motions += t.motions, before += t.within_before, after += t.within_after;
    worst_deg = std::max(worst_deg, t.worst_after_deg);
    list.push_back({{"name", c.body.name},
                    {"motions", t.motions},
                    {"within_before", t.within_before},
                    {"within_after", t.within_after},
                    {"angles", peakTorqueJson(c.retargeted.peak_torque)}});
  }
  const auto of = [&](int count) { return std::to_string(count) + " of " + std::to_string(motions); };
  report.result = {{"target_deg", kPeakTorqueTarget_deg}, {"characters", list}};
  report.text = textOf(*characters);
  report.verdicts = {
      {"motions within 3 deg before step 3", "", "reported", of(before), std::nullopt},
      {"motions within 3 deg", "restored", "all", of(after), after == motions},
      {"largest difference", "", "<= 3 deg", fixed(worst_deg, 1) + " deg", worst_deg <= kPeakTorqueTarget_deg}};
  const std::string figure = figureOf(*characters);
  if (!figure.empty()) report.figures = {{"peak-torque", figure}};
  return report;
}

}  // namespace sinew
