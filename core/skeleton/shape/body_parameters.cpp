#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "core/skeleton/shape/body_parameters_internal.h"
#include "core/text.h"

namespace sinew {
namespace {

constexpr double kFarthest_sd = 6;                // beyond this a body is not one of the population
constexpr double kRootScale = 0.1, kRootSd = 10;  // metres and radians: as good as unknown

}  // namespace

BodyParameters::BodyParameters(const Skeleton& skeleton, std::span<const ShapePrior> priors) {
  const auto& names = shapeParameterNames();
  shape_count_ = static_cast<int>(names.size());
  const int count = kShapeBegin + shape_count_ + skeleton.coordinateCount();
  mean_.assign(count, 0);
  sd_.assign(count, 0);
  prior_weight_.assign(count, 1);
  lower_.assign(count, -kFarthest_sd);
  upper_.assign(count, kFarthest_sd);
  is_angle_.resize(shape_count_);
  deformable_.assign(count, false);
  mean_[kSize] = 1;
  for (int i = 0; i < shape_count_; ++i) {
    is_angle_[i] = isShapeAngle(names[i]);
    deformable_[kShapeBegin + i] = shapeUnit(names[i]) != ShapeUnit::Ratio;
    mean_[kShapeBegin + i] = shapeUnit(names[i]) == ShapeUnit::Ratio ? 1 : 0;
  }
  for (const auto& prior : priors) {
    const auto at = std::ranges::find(names, prior.parameter);
    if (prior.parameter != kSizePrior && at == names.end())
      throw InputError{
          {"shape priors", prior.parameter, "a shape parameter" + didYouMean(prior.parameter, names), ""}};
    const int i = prior.parameter == kSizePrior ? kSize : kShapeBegin + static_cast<int>(at - names.begin());
    const Bounds bounds = shapeBounds(prior.parameter);
    if (!(prior.sd > 0 && prior.mean > bounds.lower && prior.mean < bounds.upper))
      throw InputError{{"shape priors", prior.parameter, "SD > 0 and a mean within bounds",
                        std::to_string(prior.mean) + " +- " + std::to_string(prior.sd)}};
    mean_[i] = prior.mean;
    sd_[i] = prior.sd;
    // Ratios stay so close together that no bone is shorter than its heads; deformities have room.
    const bool ratio = shapeUnit(prior.parameter) == ShapeUnit::Ratio;
    const double farthest = ratio ? kFarthest_sd : std::numeric_limits<double>::infinity();
    lower_[i] = std::max(-farthest, (bounds.lower - prior.mean) / prior.sd);
    upper_[i] = std::min(farthest, (bounds.upper - prior.mean) / prior.sd);
  }

  const Eigen::VectorXd posture_sd = standingPostureSd(skeleton);
  constexpr double kLargestTurn_rad = 2.8;  // of a ball joint: short of the half turn where the rotation vector jumps
  for (int k = 0; k < skeleton.coordinateCount(); ++k) {
    const int i = postureBegin() + k;
    const Coordinate& coordinate = skeleton.coordinates[k];
    if (!std::isfinite(posture_sd[k])) {
      sd_[i] = kRootScale;
      prior_weight_[i] = kRootScale / kRootSd;
      lower_[i] = -1e4;
      upper_[i] = 1e4;
      continue;
    }
    sd_[i] = posture_sd[k];
    const bool revolute = skeleton.joints[coordinate.joint].type == JointType::Revolute;
    lower_[i] = (revolute ? coordinate.athlete_min_rad : -kLargestTurn_rad) / sd_[i];
    upper_[i] = (revolute ? coordinate.athlete_max_rad : kLargestTurn_rad) / sd_[i];
  }
}

void BodyParameters::setRootStart(const Eigen::Vector3d& p_W, const Eigen::Vector3d& rotation_vector_rad) {
  Eigen::Map<Eigen::Vector3d>{&mean_[postureBegin()]} = p_W;
  Eigen::Map<Eigen::Vector3d>{&mean_[postureBegin() + 3]} = rotation_vector_rad;
}

}  // namespace sinew
