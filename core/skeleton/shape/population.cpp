#include "core/skeleton/shape/population.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angle.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

/// SD of a clinical coordinate of a standing body.
double standingSd_rad(const Coordinate& coordinate) {
  return (coordinate.normal_max_rad - coordinate.normal_min_rad) / 8;
}

double drawDeviation(std::mt19937_64& random, double max_sd) {
  std::normal_distribution<double> normal;
  for (;;) {
    const double z = normal(random);
    if (std::abs(z) <= max_sd) return z;
  }
}

}  // namespace

Bounds shapeBounds(const std::string& parameter) {
  if (parameter == kSizePrior) return {0.25, 1.6};
  constexpr double kTorsion_rad = 75 * kRadPerDeg, kAngle_rad = 40 * kRadPerDeg;
  constexpr double kNeckLength_m = 0.025, kHipShift_m = 0.1;  // a high dislocation
  switch (shapeUnit(parameter)) {
    case ShapeUnit::Ratio:
      return {0.2, 2.5};
    case ShapeUnit::Length:
      return parameter.ends_with(".neck_length") ? Bounds{-kNeckLength_m, kNeckLength_m}
                                                 : Bounds{-kHipShift_m, kHipShift_m};
    case ShapeUnit::Angle:
      break;
  }
  return parameter.ends_with(".torsion") ? Bounds{-kTorsion_rad, kTorsion_rad} : Bounds{-kAngle_rad, kAngle_rad};
}

Eigen::VectorXd standingPostureSd(const Skeleton& skeleton) {
  Eigen::VectorXd sd(skeleton.coordinateCount());
  for (const auto& joint : skeleton.joints) {
    if (joint.type == JointType::Free) {
      sd.segment(joint.first_coordinate, joint.coordinate_count).setConstant(std::numeric_limits<double>::infinity());
      continue;
    }
    if (joint.type == JointType::Revolute) {
      sd[joint.first_coordinate] = standingSd_rad(skeleton.coordinates[joint.first_coordinate]);
      continue;
    }
    Eigen::Vector3d variance = Eigen::Vector3d::Zero();
    for (int i = joint.first_coordinate; i < joint.first_coordinate + 3; ++i)
      variance += (skeleton.coordinates[i].axis * standingSd_rad(skeleton.coordinates[i])).cwiseAbs2();
    sd.segment<3>(joint.first_coordinate) = variance.cwiseSqrt();
  }
  return sd;
}

ShapeParameters drawShape(std::span<const ShapePrior> priors, std::mt19937_64& random, double max_sd) {
  const auto& names = shapeParameterNames();
  std::vector<double> values = toVector(ShapeParameters{});
  double size = 1;
  for (const auto& prior : priors) {
    const double value = prior.mean + prior.sd * drawDeviation(random, max_sd);
    const auto at = std::ranges::find(names, prior.parameter);
    if (prior.parameter == kSizePrior)
      size = value;
    else if (at != names.end())
      values[static_cast<std::size_t>(at - names.begin())] = value;
  }
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!isShapeAngle(names[i])) values[i] *= size;
  return shapeFromVector(values);
}

Posture drawStandingPosture(const Skeleton& skeleton, std::mt19937_64& random, double max_sd) {
  Eigen::VectorXd clinical = Eigen::VectorXd::Zero(skeleton.coordinateCount());
  for (int i = 0; i < skeleton.coordinateCount(); ++i) {
    const Coordinate& c = skeleton.coordinates[i];
    const double z = drawDeviation(random, max_sd);
    const bool root = skeleton.joints[c.joint].type == JointType::Free;
    if (c.translational) {
      clinical[i] = 0;
    } else if (root) {
      const bool vertical = std::abs(c.axis.y()) > 0.5;
      clinical[i] = z * (vertical ? 8 : 3) * kRadPerDeg;
    } else {
      clinical[i] = std::clamp(z * standingSd_rad(c), c.normal_min_rad, c.normal_max_rad);
    }
  }
  return postureFromClinical(skeleton, clinical);
}

}  // namespace sinew
