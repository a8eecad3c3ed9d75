#include "app/experiments/rom_preservation.h"

#include <numbers>

#include "app/experiments/experiment_shapes.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/retarget.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

struct MapPair {
  RomMap muscles, with_stops;
};

std::vector<MapPair> mapsOf(const Model& model, const RomPreservationOptions& options) {
  std::vector<MapPair> maps;
  for (const double knee_deg : options.knee_flexions_deg) {
    const Posture held =
        postureFromDegrees(model.skeleton, {{"knee_flexion_r", knee_deg}, {"knee_flexion_l", knee_deg}});
    maps.push_back({romMap(model, options.joint, held, {.joint_limits = false}),
                    romMap(model, options.joint, held, {.joint_limits = true})});
  }
  return maps;
}

std::vector<RomErrors> errorsOf(const std::vector<MapPair>& wanted, const std::vector<MapPair>& found) {
  std::vector<RomErrors> errors;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    errors.push_back(
        {compare(wanted[i].muscles, found[i].muscles), compare(wanted[i].with_stops, found[i].with_stops)});
  return errors;
}

}  // namespace

RomPreservation romPreservation(const RetargetReference& reference, const RomPreservationOptions& options,
                                const Job& job) {
  RomPreservation result;
  const std::vector<MapPair> wanted = mapsOf(reference.model(), options);
  for (const MapPair& maps : wanted) {
    result.valid_muscles.push_back(maps.muscles.validCount());
    result.valid_with_stops.push_back(maps.with_stops.validCount());
  }
  const auto count = double(options.elongations.size() * options.torsions_deg.size());
  for (const double elongation : options.elongations)
    for (const double torsion_deg : options.torsions_deg) {
      job.report(double(result.rows.size()) / count, "range of motion of the hip");
      const ShapeParameters shape = withFemora(elongation, torsion_deg * std::numbers::pi / 180);
      // Ratios of fibre and tendon keep the longest length, and with it the map.
      const Retargeted body = retarget(reference, shape, {.peak_torque = false}, {.stop = job.stop});
      if (body.outcome != Outcome::Converged) return {.outcome = body.outcome};
      result.rows.push_back({elongation, torsion_deg,
                             errorsOf(wanted, mapsOf(deformedModel(reference.model(), shape), options)),
                             errorsOf(wanted, mapsOf(body.model, options))});
    }
  result.outcome = Outcome::Converged;
  return result;
}

}  // namespace sinew
