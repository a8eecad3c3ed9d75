#include "core/skeleton/shape/shape.h"

#include <algorithm>
#include <string_view>

#include "core/angle.h"
#include "core/error.h"

namespace sinew {
namespace {

/// Calls f(name, value) for every parameter, in the order of the flat list. Shape is const or not.
template <class Shape, class F>
void forEachParameter(Shape& shape, F&& f) {
  f("pelvis.width", shape.pelvis_width);
  f("pelvis.height", shape.pelvis_height);
  f("pelvis.depth", shape.pelvis_depth);
  f("trunk.elongation", shape.trunk_elongation);
  f("trunk.expansion", shape.trunk_expansion);
  f("trunk.bend", shape.trunk_bend_rad);
  f("neck.elongation", shape.neck_elongation);
  f("head.scale", shape.head_scale);
  for (int i = 0; i < 2; ++i) {
    auto& side = shape.sides[i];
    const std::string suffix = i == 0 ? "_r." : "_l.";
    const auto limb = [&](const std::string& bone, auto& b) {
      f(bone + suffix + "elongation", b.elongation);
      f(bone + suffix + "proximal_scale", b.proximal_scale);
      f(bone + suffix + "distal_scale", b.distal_scale);
      f(bone + suffix + "torsion", b.torsion_rad);
    };
    const auto bend = [&](const std::string& bone, auto& b) {
      f(bone + suffix + "varus", b.varus_rad);
      f(bone + suffix + "procurvatum", b.procurvatum_rad);
    };
    limb("femur", side.femur);
    bend("femur", side.femur);
    f("femur" + suffix + "neck_shaft", side.femur.neck_shaft_rad);
    f("femur" + suffix + "neck_length", side.femur.neck_length_m);
    f("femur" + suffix + "neck_varus", side.femur.neck_varus_rad);
    f("femur" + suffix + "neck_retroversion", side.femur.neck_retroversion_rad);
    f("femur" + suffix + "bow_frontal", side.femur.bow_frontal_rad);
    f("femur" + suffix + "bow_sagittal", side.femur.bow_sagittal_rad);
    limb("tibia", side.tibia);
    bend("tibia", side.tibia);
    f("tibia" + suffix + "distal_varus", side.tibia.distal_varus_rad);
    f("tibia" + suffix + "distal_procurvatum", side.tibia.distal_procurvatum_rad);
    limb("humerus", side.humerus);
    limb("ulna", side.ulna);
    f("foot" + suffix + "scale", side.foot_scale);
    f("hand" + suffix + "scale", side.hand_scale);
    f("hip" + suffix + "lateral", side.hip.lateral_m);
    f("hip" + suffix + "superior", side.hip.superior_m);
    f("hip" + suffix + "anterior", side.hip.anterior_m);
  }
}

/// Bounds and how a person is told of them.
struct Allowed {
  double least, greatest, per_shown;
  const char *expected, *unit;
};
Allowed allowedOf(ShapeUnit unit) {
  switch (unit) {
    case ShapeUnit::Angle:
      return {-kGreatestShapeAngle_rad, kGreatestShapeAngle_rad, kRadPerDeg, "an angle within +-90 deg", " deg"};
    case ShapeUnit::Length:
      return {-kGreatestShapeLength_m, kGreatestShapeLength_m, 1e-3, "a length within +-150 mm", " mm"};
    case ShapeUnit::Ratio:
      break;
  }
  return {kLeastShapeRatio, kGreatestShapeRatio, 1, "a ratio from 0.2 to 4", ""};
}

}  // namespace

const std::vector<std::string>& shapeParameterNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    const ShapeParameters shape;
    forEachParameter(shape, [&](const std::string& name, double) { list.push_back(name); });
    return list;
  }();
  return names;
}

std::vector<double> toVector(const ShapeParameters& shape) {
  std::vector<double> values;
  forEachParameter(shape, [&](const std::string&, double value) { values.push_back(value); });
  return values;
}

ShapeParameters shapeFromVector(const std::vector<double>& values) {
  require(values.size() == shapeParameterNames().size(), "one value a shape parameter");
  ShapeParameters shape;
  std::size_t i = 0;
  forEachParameter(shape, [&](const std::string&, double& value) { value = values[i++]; });
  return shape;
}

ShapeUnit shapeUnit(const std::string& parameter) {
  constexpr std::string_view kAngles[] = {"torsion",    "varus",        "procurvatum",       "neck_shaft",
                                          "neck_varus", "bow_frontal",  "bow_sagittal",      "neck_retroversion",
                                          "bend",       "distal_varus", "distal_procurvatum"};
  constexpr std::string_view kLengths[] = {"lateral", "superior", "anterior", "neck_length"};
  const std::string_view quantity = std::string_view{parameter}.substr(parameter.find('.') + 1);
  if (std::ranges::find(kAngles, quantity) != std::end(kAngles)) return ShapeUnit::Angle;
  if (std::ranges::find(kLengths, quantity) != std::end(kLengths)) return ShapeUnit::Length;
  return ShapeUnit::Ratio;
}

void validate(const ShapeParameters& shape) {
  forEachParameter(shape, [](const std::string& name, double value) {
    const Allowed allowed = allowedOf(shapeUnit(name));
    if (!(value >= allowed.least && value <= allowed.greatest))
      throw InputError{{"shape", name, allowed.expected, std::to_string(value / allowed.per_shown) + allowed.unit}};
  });
}

}  // namespace sinew
