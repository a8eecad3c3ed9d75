#include "core/rom/maps/rom_limits.h"

#include "core/rom/maps/coordinate_range.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {

std::vector<RomLimit> romLimits(const Model& model, int joint, const Posture& held) {
  const Joint& j = model.skeleton.joints[joint];
  const Eigen::VectorXd clinical = clinicalFromPosture(model.skeleton, held);
  const auto name = [&](int unit) {
    return unit < 0 ? std::string{"stop"} : model.musculature.units[std::size_t(unit)].name;
  };
  std::vector<RomLimit> limits;
  for (int i = j.first_coordinate; i < j.first_coordinate + j.coordinate_count; ++i) {
    const CoordinateRange range = muscleInducedRange(model, clinical, i);
    limits.push_back({model.skeleton.coordinates[i].name, range.low_rad, range.high_rad,
                      range.isEmpty() ? name(range.high_unit) : name(range.low_unit), name(range.high_unit)});
  }
  return limits;
}

}  // namespace sinew
