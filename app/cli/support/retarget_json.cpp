#include "app/cli/support/retarget_json.h"
#include "core/retarget/retarget.h"

namespace sinew {
namespace {

Json partsJson(const RoutingEnergy& energy) {
  return {{"direction", energy.direction},
          {"length", energy.length},
          {"curve", energy.curve},
          {"displacement", energy.displacement},
          {"reversal", energy.reversal}};
}

}  // namespace

Json musclesJson(const Retargeted& body, const RoutingWeights& weights) {
  Json muscles = Json::array();
  for (std::size_t u = 0; u < body.routing.size(); ++u) {
    const UnitRouting& unit = body.routing[u];
    Json muscle{{"name", unit.unit},
                {"energy_start", unit.start.total(weights)},
                {"energy_end", unit.end.total(weights)},
                {"iterations", unit.iterations},
                {"outcome", nameOf(unit.outcome)},
                {"start_parts", partsJson(unit.start)},
                {"end_parts", partsJson(unit.end)},
                {"largest_move_mm", 1000 * unit.largest_move_m}};
    muscle["length_factor"] = u < body.lengths.factor.size() ? Json(body.lengths.factor[u]) : Json(nullptr);
    muscle["fiber_tendon_ratio"] = body.fiber_tendon_ratio[u];
    muscles.push_back(std::move(muscle));
  }
  return muscles;
}

Json peakTorqueJson(std::span<const PeakTorqueAngle> angles) {
  Json list = Json::array();
  for (const PeakTorqueAngle& a : angles)
    list.push_back({{"motion", a.motion},
                    {"reference_deg", numberOrNull(a.reference_deg)},
                    {"before_deg", numberOrNull(a.before_deg)},
                    {"after_deg", numberOrNull(a.after_deg)}});
  return list;
}

Json timesJson(const RetargetTimes& times) {
  return {{"deformation", times.deformation_s},
          {"routing", times.routing_s},
          {"maximal_lengths", times.lengths_s},
          {"peak_torque", times.peak_torque_s}};
}

}  // namespace sinew
