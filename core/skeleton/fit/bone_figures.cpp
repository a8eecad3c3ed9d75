#include "core/skeleton/fit/bone_figures_internal.h"
#include "core/skeleton/fit/posed_landmarks_internal.h"

namespace sinew {

const std::vector<std::string>& figureLandmarkNames() {
  static const std::vector<std::string> names = [] {
    constexpr const char* kNames[figures::kLegPoints] = {"femoral_head_center",
                                                         "knee_center",
                                                         "ankle_center",
                                                         "femoral_neck_base",
                                                         "femoral_shaft_proximal",
                                                         "femoral_shaft_lower",
                                                         "medial_condyle_center",
                                                         "lateral_condyle_center",
                                                         "posterior_plateau_medial",
                                                         "posterior_plateau_lateral",
                                                         "medial_malleolus",
                                                         "lateral_malleolus"};
    std::vector<std::string> list;
    for (const char* side : {"_r", "_l"})
      for (const std::string name : kNames) list.push_back(name + side);
    list.emplace_back("sacral_endplate_center");
    return list;
  }();
  return names;
}

const std::vector<BoneFigure>& figureList() {
  static const std::vector<BoneFigure> list = [] {
    std::vector<BoneFigure> figures;
    const auto add = [&](const char* quantity, const char* side, const char* unit) {
      BoneFigure figure;
      figure.quantity = quantity;
      figure.side = side;
      figure.unit = unit;
      figures.push_back(figure);
    };
    for (const char* side : {"r", "l"}) {
      for (const char* length : {"femur_length", "tibia_length", "leg_length"}) add(length, side, "mm");
      for (const char* angle : {"hka", "neck_shaft_angle", "femoral_torsion", "tibial_torsion", "knee_flexion"})
        add(angle, side, "deg");
    }
    add("leg_length_difference", "", "mm");
    add("pelvic_width", "", "mm");
    add("pelvic_obliquity", "", "deg");
    add("pelvic_tilt", "", "deg");
    return figures;
  }();
  return list;
}

std::vector<BoneFigure> boneFigures(const Skeleton& reference, const ShapeParameters& shape, const Posture& posture) {
  std::vector<int> landmarks;
  for (const auto& name : figureLandmarkNames()) landmarks.push_back(reference.landmarkIndex(name));
  const auto points = posedLandmarks<double>(reference, landmarks, toVector(shape),
                                             {posture.data(), static_cast<std::size_t>(posture.size())});
  const auto values = figureValues<double>(points);
  std::vector<BoneFigure> figures = figureList();
  for (std::size_t i = 0; i < figures.size(); ++i) {
    figures[i].value = values[i];
    figures[i].determined = true;
  }
  return figures;
}

}  // namespace sinew
