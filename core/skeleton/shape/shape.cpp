#include "core/skeleton/shape/shape.h"

#include <cmath>
#include <functional>
#include <numbers>

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
    limb("femur", side.femur);
    f("femur" + suffix + "neck_shaft", side.femur.neck_shaft_rad);
    f("femur" + suffix + "varus", side.femur.varus_rad);
    limb("tibia", side.tibia);
    limb("humerus", side.humerus);
    limb("ulna", side.ulna);
    f("foot" + suffix + "scale", side.foot_scale);
    f("hand" + suffix + "scale", side.hand_scale);
  }
}

bool isAngle(const std::string& name) {
  return name.ends_with(".torsion") || name.ends_with(".neck_shaft") || name.ends_with(".varus") ||
         name.ends_with(".bend");
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

void validate(const ShapeParameters& shape) {
  forEachParameter(shape, [](const std::string& name, double value) {
    const bool angle = isAngle(name);
    const double low = angle ? -kGreatestShapeAngle_rad : kLeastShapeRatio;
    const double high = angle ? kGreatestShapeAngle_rad : kGreatestShapeRatio;
    if (!(value >= low && value <= high))
      throw InputError{{"shape", name, angle ? "an angle within +-90 deg" : "a ratio from 0.2 to 4",
                        angle ? std::to_string(value * 180 / std::numbers::pi) + " deg" : std::to_string(value)}};
  });
}

}  // namespace sinew
