#include "clinical/synthetic/xray_render.h"

#include <cmath>

#include "clinical/synthetic/body_envelope.h"
#include "clinical/synthetic/bone_tissue.h"

namespace sinew {
namespace {

/// Independent grains of size g along the ray, each with a standard deviation s of its attenuation: after a path of
/// length L the exponent varies by s sqrt(g L).
struct Texture {
  double variation_per_m, grain_mm;  ///< s, g
  double across_mm, along_mm;        ///< standard deviation of the pattern across and along the body
};
constexpr Texture kTrabeculae{7.5, 1.0, 0.28, 0.6};
constexpr Texture kMuscleBundles{1.0, 8.0, 3.5, 14.0};

void addTexture(const std::vector<TriangleMesh>& solids, const Texture& texture, const View& view, double pixel_mm,
                std::uint64_t seed, PixelField& field, const Job& job) {
  std::vector<XrayVolume> paths;
  for (const auto& mesh : solids) paths.push_back({mesh, 1.0});
  const PixelField length_m = attenuationField(paths, {}, view, job);
  if (length_m.empty()) return;
  const PixelField pattern =
      grain(view.width_px, view.height_px, texture.across_mm / pixel_mm, texture.along_mm / pixel_mm, seed);
  const double scale = texture.variation_per_m * std::sqrt(1e-3 * texture.grain_mm);
  for (std::size_t i = 0; i < field.size(); ++i)
    if (length_m[i] > 0) field[i] += float(scale * std::sqrt(double(length_m[i]))) * pattern[i];
}

}  // namespace

XrayScene patientScene(const Model& model, const Posture& posture, const Job& job) {
  const auto X_WB = segmentPoses(model.skeleton, posture);
  XrayScene scene;
  scene.volumes = softTissues(model.skeleton, X_WB);
  scene.muscle_W.push_back(scene.volumes.at(1).mesh_W);
  for (const auto& bone : *model.bones) {
    if (job.cancelled()) return {};
    auto tissue = boneTissue(bone, X_WB[std::size_t(bone.segment)]);
    for (auto& volume : tissue.volumes) scene.volumes.push_back(std::move(volume));
    if (!tissue.spongy_W.triangles.empty()) scene.spongy_W.push_back(std::move(tissue.spongy_W));
  }
  return scene;
}

PixelField renderScene(const XrayScene& scene, const View& view, double pixel_mm, std::uint64_t seed,
                       const Job& job) {
  PixelField field = attenuationField(scene.volumes, scene.balls, view, job);
  addTexture(scene.spongy_W, kTrabeculae, view, pixel_mm, seed ^ 0x5B0, field, job);
  addTexture(scene.muscle_W, kMuscleBundles, view, pixel_mm, seed ^ 0x3A7, field, job);
  if (job.cancelled()) return {};
  for (float& x : field) x = std::max(x, 0.0F);
  return field;
}

}  // namespace sinew
