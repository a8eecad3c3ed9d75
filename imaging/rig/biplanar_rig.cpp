#include "imaging/rig/biplanar_rig.h"

#include <algorithm>
#include <cmath>

#include "core/file.h"
#include "core/text.h"
#include "imaging/rig/biplanar_rig_json.h"

namespace sinew {
namespace {

constexpr std::pair<ViewRole, const char*> kRoles[] = {
    {ViewRole::FrontalAP, "frontal_ap"},     {ViewRole::FrontalPA, "frontal_pa"},
    {ViewRole::LateralLeft, "lateral_left"}, {ViewRole::LateralRight, "lateral_right"},
    {ViewRole::Oblique, "oblique"},          {ViewRole::Other, "other"}};

/// Without a number.
std::string plainTitle(std::span<const RigView> views, int view) {
  const ViewRole role = views[std::size_t(view)].role;
  if (isFrontal(role)) return "Frontal";
  if (isLateral(role)) return "Lateral";
  return role == ViewRole::Oblique ? "Oblique" : "View " + std::to_string(view + 1);
}

}  // namespace

std::string nameOf(ViewRole role) {
  return std::ranges::find(kRoles, role, &std::pair<ViewRole, const char*>::first)->second;
}

ViewRole roleFromName(std::string_view name) {
  std::vector<std::string> known;
  for (const auto& [role, text] : kRoles) {
    if (name == text) return role;
    known.emplace_back(text);
  }
  throw InputError{{"view", "role", "frontal_ap, frontal_pa, lateral_left, lateral_right, oblique or other",
                    "'" + std::string{name} + "'" + didYouMean(name, known)}};
}

bool isFrontal(ViewRole role) {
  return role == ViewRole::FrontalAP || role == ViewRole::FrontalPA;
}

bool isLateral(ViewRole role) {
  return role == ViewRole::LateralLeft || role == ViewRole::LateralRight;
}

ViewRole roleOfBeam(const View& view) {
  const double kAxis = std::cos(0.5235987755982988);  // 30 deg
  const Eigen::Vector3d beam_W = view.R_CW.row(2);
  if (std::abs(beam_W.x()) > kAxis) return beam_W.x() < 0 ? ViewRole::FrontalAP : ViewRole::FrontalPA;
  if (std::abs(beam_W.z()) > kAxis) return beam_W.z() < 0 ? ViewRole::LateralLeft : ViewRole::LateralRight;
  return ViewRole::Oblique;
}

std::string viewTitle(std::span<const RigView> views, int view) {
  const std::string title = plainTitle(views, view);
  int alike = 0, number = 0;
  for (int i = 0; i < int(views.size()); ++i) {
    if (plainTitle(views, i) != title) continue;
    ++alike;
    if (i <= view) ++number;
  }
  return alike > 1 ? title + " " + std::to_string(number) : title;
}

std::vector<View> projectionsOf(const BiplanarRig& rig) {
  return {rig.views.begin(), rig.views.end()};
}

std::string geometryId(std::span<const RigView> views) {
  Json json = Json::array();
  for (const auto& view : views) json.push_back(projectionToJson(view));
  return sha256(json.dump()).substr(0, 12);
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
  double least = 2;
  for (std::size_t i = 0; i < rig.views.size(); ++i)
    for (std::size_t k = i + 1; k < rig.views.size(); ++k) {
      const double cosine = middleRay(rig.views[i]).dot(middleRay(rig.views[k]));
      if (std::abs(cosine) < std::abs(least)) least = cosine;
    }
  return std::acos(std::clamp(least, -1.0, 1.0));
}

}  // namespace sinew
