#include "imaging/rig/biplanar_rig.h"

#include <algorithm>
#include <cmath>

#include "core/file.h"
#include "imaging/rig/biplanar_rig_json.h"

namespace sinew {

std::string geometryId(const std::array<View, 2>& views) {
  BiplanarRig rig;
  rig.views = views;
  return sha256(rigToJson(rig)["views"].dump()).substr(0, 12);
}

BiplanarRig loadRig(const std::filesystem::path& file) {
  const Json json = parseJson(readFile(file, std::uintmax_t{16} << 20), file.string());
  BiplanarRig rig = rigFromJson({json, file.string()});
  rig.calibration.id = geometryId(rig.views);  // computed, never believed: it names this geometry in the report
  return rig;
}

void saveRig(const BiplanarRig& rig, const std::filesystem::path& file) {
  writeFileAtomically(file, jsonText(rigToJson(rig)));
}

double angleBetweenViews_rad(const BiplanarRig& rig) {
  const auto middleRay = [](const View& view) {
    return backProject(view, {0.5 * (view.width_px - 1), 0.5 * (view.height_px - 1)}).direction_W;
  };
  return std::acos(std::clamp(middleRay(rig.views[0]).dot(middleRay(rig.views[1])), -1.0, 1.0));
}

}  // namespace sinew
