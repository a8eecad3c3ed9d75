#include "core/skeleton/fit/bone_figure.h"

namespace sinew {

const std::vector<FigureLimit>& figureLimits() {
  // All estimated: the step in which decisions are taken, or the spread that a norm leaves anyway.
  static const std::vector<FigureLimit> limits = {
      {"femur_length", 25, "the SD of a norm at given age and sex is 20-28 mm"},
      {"tibia_length", 25, "as femur_length"},
      {"leg_length", 40, "as femur_length, of two bones"},
      {"hka", 3, "3 deg is the SD of healthy adults, and what a correction aims for"},
      {"neck_shaft_angle", 8, "the SD of healthy adults is 6-7 deg"},
      {"femoral_torsion", 10, "a derotation is planned in steps of 10 deg or more; healthy SD 8-10 deg"},
      {"tibial_torsion", 10, "as femoral_torsion"},
      {"knee_flexion", 5, "the step in which contractures are examined"},
      {"leg_length_difference", 10, "10 mm is what is first treated"},
      {"pelvic_width", 20, "the SD of adults is about 10 mm"},
      {"pelvic_obliquity", 3, "3 deg over hips 180 mm apart are 10 mm of leg length"},
      {"pelvic_tilt", 6, "the SD of healthy adults is 6 deg"}};
  return limits;
}

}  // namespace sinew
