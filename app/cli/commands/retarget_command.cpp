#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "app/cli/support/commands.h"
#include "app/cli/support/retarget_json.h"
#include "app/cli/support/retarget_reference.h"
#include "app/cli/support/text_table.h"
#include "app/experiments/characters.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/retarget.h"
#include "core/skeleton/shape/shape_json.h"

namespace sinew {
namespace {

constexpr std::size_t kListed = 10;  // muscles in a table for people

struct RetargetCommandOptions {
  std::string shape, method = "sinew", reference = "reference";
  bool no_peak_torque = false;
  std::filesystem::path output;
};

std::string totalsText(const Retargeted& body, const RoutingWeights& weights) {
  const EnergyTotals e = energyTotals(body.routing, weights);
  const PeakTorqueTotals p = peakTorqueTotals(body.peak_torque);
  const auto moved =
      std::ranges::count_if(body.routing, [](const UnitRouting& unit) { return unit.largest_move_m > 0.0001; });
  const auto within = [&](int count) { return std::to_string(count) + " of " + std::to_string(p.motions); };
  return textTable({"", "bones alone", "retargeted"},
                   {{"energy, all parts", fixed(e.start, 2), fixed(e.end, 2)},
                    {"energy of the paper", fixed(e.paper_start, 2), fixed(e.paper_end, 2)},
                    {"angles of peak torque within 3 deg", within(p.within_before), within(p.within_after)},
                    {"the one furthest off, deg", fixed(p.worst_before_deg, 1), fixed(p.worst_after_deg, 1)}}) +
         std::to_string(moved) + " of " + std::to_string(body.routing.size()) + " units moved by more than 0.1 mm; " +
         std::to_string(body.lengths.relaxed) + " lengthened because they would pull at rest\n";
}

/// The units with the largest `measure`, which has to be above zero.
template <class Measure>
std::vector<std::size_t> largest(std::size_t count, const Measure& measure) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return measure(a) > measure(b); });
  std::erase_if(order, [&](std::size_t u) { return !(measure(u) > 0); });
  order.resize(std::min(order.size(), kListed));
  return order;
}

std::string musclesText(const Retargeted& body, const RoutingWeights& weights) {
  std::vector<std::vector<std::string>> rows;
  for (const std::size_t u :
       largest(body.routing.size(), [&](std::size_t i) { return body.routing[i].end.total(weights); })) {
    const UnitRouting& unit = body.routing[u];
    rows.push_back({unit.unit, fixed(unit.start.total(weights), 3), fixed(unit.end.total(weights), 3),
                    fixed(1000 * unit.largest_move_m, 1),
                    u < body.lengths.factor.size() ? fixed(body.lengths.factor[u], 3) : "-",
                    fixed(body.fiber_tendon_ratio[u], 3)});
  }
  if (rows.empty()) return "";
  return "\nmuscles that keep their function least\n" +
         textTable({"unit", "energy", "after", "moved mm", "length x", "fibre:tendon x"}, rows);
}

std::string peaksText(const std::vector<PeakTorqueAngle>& angles) {
  std::vector<std::vector<std::string>> rows;
  for (const PeakTorqueAngle& a : angles)
    if (std::isfinite(a.reference_deg) && !(std::abs(a.after_deg - a.reference_deg) <= kPeakTorqueTarget_deg))
      rows.push_back({a.motion, fixed(a.reference_deg, 1), fixed(a.before_deg, 1), fixed(a.after_deg, 1)});
  if (rows.empty()) return "";
  return "\nangles of peak torque that are off by more than 3 deg\n" +
         textTable({"motion", "reference deg", "before deg", "after deg"}, rows);
}

Json retargetJson(const RetargetCommandOptions& o, const BodyDescription& body, const Retargeted& result,
                  const RoutingWeights& weights) {
  const EnergyTotals e = energyTotals(result.routing, weights);
  return {
      {"format", "sinew.retarget"},
      {"version", 1},
      {"outcome", nameOf(result.outcome)},
      {"method", o.method},
      {"reference", o.reference},
      {"body", bodyToJson(body)},
      {"energy", {{"start", e.start}, {"end", e.end}, {"paper_start", e.paper_start}, {"paper_end", e.paper_end}}},
      {"muscles", musclesJson(result, weights)},
      {"peak_torque", peakTorqueJson(result.peak_torque)},
      {"relaxed", result.lengths.relaxed},
      {"seconds", result.times.total_s()},
      {"seconds_by_step", timesJson(result.times)},
      {"files", {{"model", o.output.string()}}}};
}

ExitStatus makeBody(const RetargetCommandOptions& o, Session& session) {
  const RetargetMethod method = retargetMethodNamed(o.method);
  const BodyDescription body = loadBody(o.shape, session.resourceDir());
  const Json cancelled{{"format", "sinew.retarget"},
                       {"version", 1},
                       {"outcome", nameOf(Outcome::Cancelled)},
                       {"files", {{"model", nullptr}}}};
  const auto reference = preparedReference(session, o.reference, "sinew retarget", cancelled);
  const RetargetOptions options{.method = method, .peak_torque = !o.no_peak_torque, .physics = body.physics};
  Retargeted result = retarget(*reference, body.shape, options, session.job());
  if (result.outcome != Outcome::Converged) {
    session.result(cancelled, std::string{nameOf(result.outcome)} + "\n");
    return statusOf(result.outcome);
  }
  result.model.name = body.name;
  saveModel(result.model, o.output);
  session.result(retargetJson(o, body, result, options.weights),
                 body.name + ", method " + o.method + ", " + fixed(result.times.total_s(), 2) + " s\n" +
                     totalsText(result, options.weights) + musclesText(result, options.weights) +
                     peaksText(result.peak_torque) + "\nwritten " + o.output.string() + "\n");
  return ExitStatus::Done;
}

}  // namespace

void addRetargetCommand(Commands& commands) {
  auto o = std::make_shared<RetargetCommandOptions>();
  auto& command =
      addCommand(commands.app, "retarget", "the reference's muscles in a body of another shape, functions kept",
                 "sinew retarget --shape alien -o alien.json\n"
                 "  naive: muscles ride on their bones; paper: gradient descent by finite differences.");
  command.add_option("--shape", o->shape, "shape file, or human, alien, hulk, dwarf, child")->required();
  command.add_option("--method", o->method, "sinew, paper or naive")->capture_default_str();
  command.add_option("--reference", o->reference, "reference or reference:athlete")->capture_default_str();
  command.add_flag("--no-peak-torque", o->no_peak_torque, "fibre : tendon ratios stay the reference's");
  command.add_option("-o,--output", o->output, "model file")->required();
  command.callback(
      [&commands, o] { commands.chosen = [&session = commands.session, o] { return makeBody(*o, session); }; });
}

}  // namespace sinew
