#include "app/experiments/experiment_shapes.h"

#include <random>

namespace sinew {

ShapeParameters withLimbElongation(double ratio) {
  ShapeParameters shape;
  for (SideShape& side : shape.sides)
    for (LimbBoneShape* bone : {&side.femur, &side.tibia, &side.humerus, &side.ulna}) bone->elongation = ratio;
  return shape;
}

ShapeParameters withFemora(double elongation, double torsion_rad) {
  ShapeParameters shape;
  for (SideShape& side : shape.sides) {
    side.femur.elongation = elongation;
    side.femur.torsion_rad = torsion_rad;
  }
  return shape;
}

std::vector<ShapeParameters> randomShapes(int count, const ShapeRanges& ranges, std::uint64_t seed) {
  std::mt19937_64 random{seed};
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;  // alike with every library
  };
  const auto elongation = [&] { return between(ranges.least_elongation, ranges.greatest_elongation); };
  std::vector<ShapeParameters> shapes;
  for (int i = 0; i < count; ++i) {
    ShapeParameters& shape = shapes.emplace_back();
    shape.trunk_elongation = elongation();
    shape.neck_elongation = elongation();
    for (SideShape& side : shape.sides)
      for (LimbBoneShape* bone : {&side.femur, &side.tibia, &side.humerus, &side.ulna}) {
        bone->elongation = elongation();
        bone->torsion_rad = between(-ranges.greatest_torsion_rad, ranges.greatest_torsion_rad);
      }
  }
  return shapes;
}

}  // namespace sinew
