#include <algorithm>
#include <cmath>

#include "clinical/synthetic/synthetic_case.h"
#include "clinical/synthetic/xray_render.h"
#include "core/file.h"
#include "imaging/xray/xray_attenuation.h"

namespace sinew {
namespace {

/// Geometry that the tags of this film state, and its index among them.
std::pair<FilmGeometry, std::size_t> filmOf(const SyntheticOptions& options, const std::string& view_position) {
  const auto films = filmGeometry(options.rig, options.binning, options.views);
  const auto film =
      std::find_if(films.begin(), films.end(), [&](const auto& f) { return f.view_position == view_position; });
  require(film != films.end(), "view position of one of the rig's films");
  return {*film, std::size_t(film - films.begin())};
}

/// A number for everything random in one image.
std::uint64_t imageSeed(const SyntheticOptions& options, std::size_t film, int exposure_number) {
  return 1000 * std::uint64_t(options.seed) + 10 * film + std::uint64_t(exposure_number);
}

std::string uid(const std::string& content) {
  return "2.25." + std::to_string(std::stoull(sha256(content).substr(0, 15), nullptr, 16));
}

Exposure exposureOf(const FilmGeometry& film, const SyntheticOptions& options) {
  Exposure exposure;
  exposure.pixel_mm = film.pixel_mm;
  exposure.photons_per_px *= options.binning * options.binning;
  exposure.quantum_noise = options.noise_in_images;
  return exposure;
}

/// Letter on the patient's side that it names, or in front of him: he looks to the right in a left lateral film.
LeadMarker markerOf(const FilmGeometry& film, double top_mm) {
  if (film.view_position == "LL") return {'L', film.width_px * film.pixel_mm - 45, top_mm + 45, 18};
  return {'R', 40, top_mm + 45, 18};
}

Radiograph develop(PixelField attenuation, const View& view, const FilmGeometry& film, const Exposure& exposure,
                   const SyntheticOptions& options) {
  Radiograph image;
  image.width_px = view.width_px;
  image.height_px = view.height_px;
  image.bits_stored = kExposedBits;
  if (attenuation.empty()) return image;
  Exposed exposed = expose(std::move(attenuation), view.width_px, exposure);
  image.window_center = exposed.window_center;
  image.window_width = exposed.window_width;
  image.pixels = std::make_shared<const std::vector<std::uint16_t>>(std::move(exposed.pixels));
  setGeometryTags(image, film, options.rig);
  const std::string study = "synthetic study " + std::to_string(options.seed) + nameOf(options.rig);
  image.tags.modality = "DX";
  image.tags.study_instance_uid = uid(study);
  image.tags.frame_of_reference_uid = uid(study + " frame");
  image.tags.patient_name = "Demo^Patient";
  image.tags.patient_id = "SYNTHETIC-" + std::to_string(options.seed);
  image.tags.study_date = "20260105";
  image.tags.manufacturer = "Sinew synthetic";
  return image;
}

/// A long-leg film is collimated above the pelvis; a slot scan shows everything.
int firstOpenRow(const Model& model, const Posture& posture, const View& view, const SyntheticOptions& options) {
  if (options.rig == SyntheticRig::SlotScan) return 0;
  constexpr double kAboveCrest_m = 0.10;
  const auto X_WB = segmentPoses(model.skeleton, posture);
  double top_v = view.height_px;
  for (const char* name : {"iliac_crest_r", "iliac_crest_l"}) {
    const Landmark& crest = model.skeleton.landmark(name);
    const Eigen::Vector3d p_W =
        X_WB[std::size_t(crest.segment)] * crest.p_BL + kAboveCrest_m * Eigen::Vector3d::UnitY();
    if (const auto uv = project(view, p_W)) top_v = std::min(top_v, uv->y());
  }
  return std::clamp(int(top_v), 0, view.height_px / 2);
}

TriangleMesh boxMesh(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(), i & 4 ? high.z() : low.z());
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 4, 6}, {0, 6, 2},
                    {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3}};
  return mesh;
}

/// Posts of rigid foam through the beads, which leave the beads' surroundings even, and acrylic plates at both ends.
std::vector<XrayVolume> phantomFrame(const CalibrationObject& phantom) {
  constexpr double kPost_m = 0.012, kPlate_m = 0.008, kClear_m = 0.02;
  Eigen::Vector3d low = phantom.beads.front().p_WQ, high = low;
  for (const auto& bead : phantom.beads) {
    low = low.cwiseMin(bead.p_WQ);
    high = high.cwiseMax(bead.p_WQ);
  }
  std::vector<XrayVolume> frame;
  std::vector<Eigen::Vector2d> posts;
  for (const auto& bead : phantom.beads) {
    const Eigen::Vector2d xz{bead.p_WQ.x(), bead.p_WQ.z()};
    if (std::any_of(posts.begin(), posts.end(), [&](const auto& p) { return (p - xz).norm() < 2 * kPost_m; }))
      continue;
    posts.push_back(xz);
    frame.push_back({boxMesh({xz.x() - kPost_m, low.y() - kClear_m, xz.y() - kPost_m},
                             {xz.x() + kPost_m, high.y() + kClear_m, xz.y() + kPost_m}),
                     kFoamAttenuation_per_m});
  }
  const Eigen::Vector3d margin{0.02, 0, 0.02};
  for (const double y : {low.y() - kClear_m - kPlate_m, high.y() + kClear_m})
    frame.push_back({boxMesh(Eigen::Vector3d{low.x(), y, low.z()} - margin,
                             Eigen::Vector3d{high.x(), y + kPlate_m, high.z()} + margin),
                     kAcrylicAttenuation_per_m});
  return frame;
}

}  // namespace

Radiograph renderRadiograph(const Model& model, const Posture& posture, const View& view,
                            const SyntheticOptions& options, const std::string& view_position, const Job& job) {
  const auto [film, index] = filmOf(options, view_position);
  const std::string step = "rendering view " + std::to_string(index + 1) + ": ";
  job.report(0, step + "bones and soft tissue");
  const XrayScene scene = patientScene(model, posture, job);
  if (job.cancelled()) return develop({}, view, film, {}, options);
  job.report(0.3, step + "rays through the body");
  const double pixel_at_patient_mm = options.rig == SyntheticRig::SlotScan
                                         ? film.pixel_mm
                                         : film.pixel_mm * film.source_to_isocenter_mm / film.source_to_detector_mm;
  PixelField attenuation = renderScene(scene, view, pixel_at_patient_mm, imageSeed(options, index, 0), job);
  if (job.cancelled()) return develop({}, view, film, {}, options);
  job.report(0.8, step + "detector");
  Exposure exposure = exposureOf(film, options);
  exposure.seed = imageSeed(options, index, 1);
  exposure.first_open_row = firstOpenRow(model, posture, view, options);
  exposure.markers = {markerOf(film, exposure.first_open_row * film.pixel_mm)};
  return develop(std::move(attenuation), view, film, exposure, options);
}

Radiograph renderPhantom(const CalibrationObject& phantom, const View& view, const SyntheticOptions& options,
                         const std::string& view_position, const Job& job) {
  const auto [film, index] = filmOf(options, view_position);
  std::vector<XrayBall> balls;
  for (const auto& bead : phantom.beads)
    balls.push_back({bead.p_WQ, bead.diameter_m / 2, kSteelAttenuation_per_m - kFoamAttenuation_per_m});
  PixelField attenuation = attenuationField(phantomFrame(phantom), balls, view, job);
  Exposure exposure = exposureOf(film, options);
  exposure.equalization = 0;
  exposure.photons_per_px /= 8;  // less tube current: there is no patient in the beam
  exposure.seed = imageSeed(options, index, 2);
  exposure.markers = {markerOf(film, 0)};
  return develop(std::move(attenuation), view, film, exposure, options);
}

}  // namespace sinew
