#include "app/report/report_document.h"

#include "app/scene/model_scene.h"
#include "clinical/pipeline/pipeline.h"
#include "clinical/report/supported_bones.h"

namespace sinew {
namespace {

QImage toQImage(const RgbImage& picture) {
  const QImage view{picture.rgb.data(), picture.width_px, picture.height_px, 3 * picture.width_px,
                    QImage::Format_RGB888};
  return view.convertToFormat(QImage::Format_RGB32);  // a copy of its own
}

/// Without the empty margins left and right: the page is narrow.
QImage cropped(const QImage& image) {
  const auto blank = [&](int u) {
    for (int v = 0; v < image.height(); ++v)
      if ((image.pixel(u, v) & 0xffffff) != 0xffffff) return false;
    return true;
  };
  int left = 0, right = image.width() - 1;
  while (left < right && blank(left)) ++left;
  while (right > left && blank(right)) --right;
  constexpr int kMargin_px = 6;
  left = std::max(0, left - kMargin_px);
  right = std::min(image.width() - 1, right + kMargin_px);
  return image.copy(left, 0, right - left + 1, image.height());
}

ModelPlate plate(const Model& model, const Posture& posture, StandardView view, bool muscles, const QString& title,
                 const std::optional<MuscleScalars>& scalars = {}) {
  ModelPicture picture;
  picture.width_px = 800;
  picture.height_px = 1200;
  picture.view = view;
  picture.muscles = muscles;
  picture.mechanical_axes = !muscles;
  picture.scalars = scalars;
  return {cropped(toQImage(renderModel(model, posture, picture))), title};
}

/// Muscles that hang on the drawn bones only.
Musculature onBones(const Musculature& all, const std::vector<BoneMesh>& bones) {
  std::vector<int> segments;
  for (const auto& bone : bones) segments.push_back(bone.segment);
  Musculature some;
  for (const auto& unit : all.units) {
    const bool drawn = std::ranges::all_of(unit.path, [&](const PathPoint& point) {
      return std::ranges::all_of(point.anchors, [&](const Anchor& anchor) {
        return std::ranges::find(segments, anchor.segment) != segments.end();
      });
    });
    if (drawn) some.units.push_back(unit);
  }
  return some;
}

MuscleScalars lengthFactors(const Musculature& musculature, const std::map<std::string, double>& factors) {
  MuscleScalars scalars;
  scalars.low = 0.8;
  scalars.high = 1.2;
  scalars.diverging = true;
  for (const auto& unit : musculature.units) {
    const auto it = factors.find(unit.name);
    scalars.by_unit[unit.name] = it == factors.end() ? 1 : it->second;
  }
  return scalars;
}

}  // namespace

ReportDocument gatherReport(const Case& c, const std::filesystem::path& case_dir, const Model& reference,
                            const std::filesystem::path& resource_dir) {
  ReportDocument document;
  document.report = makeReport(c, case_dir, reference, resource_dir);
  Model model = modelBeforeExam(c, reference, case_dir, resource_dir);
  const auto X_WB = segmentPoses(model.skeleton, c.skeleton->posture);
  const auto bones = supportedBones(model, c.sightings);
  for (int view = 0; view < int(c.images.size()); ++view)
    document.radiographs.push_back(radiographPicture(c, case_dir, view, bones, model.skeleton, X_WB));

  model.musculature = onBones(model.musculature, bones);
  model.bones = std::make_shared<const std::vector<BoneMesh>>(bones);
  const Posture& q = c.skeleton->posture;
  const auto factors = lengthFactors(model.musculature, c.exam_fit->length_factors);
  document.plates = {plate(model, q, StandardView::Front, false, "Front, axes"),
                     plate(model, q, StandardView::Right, false, "Right side, axes"),
                     plate(model, q, StandardView::Oblique, true, "Muscle length factor", factors)};
  return document;
}

}  // namespace sinew
