#pragma once
#include <random>
#include <span>
#include <vector>

#include "core/skeleton/kinematics.h"
#include "core/skeleton/shape/shape.h"
#include "core/skeleton/shape/shape_priors.h"

namespace sinew {

// The population that the fit takes its priors from, and that synthetic patients are drawn from: the same one, so
// that stated intervals can be checked against truth. Every quantity is mean + SD * deviation, deviations being
// independent standard normal numbers. One factor "size" multiplies all ratios of a body (parameter = size * (mean +
// SD * deviation)), so that bones which no image shows follow the size of those that are seen; added lengths grow
// with it too, angles do not.

/// The name of that factor among the priors.
inline constexpr const char* kSizePrior = "size";

/// Lower and upper bound of a shape parameter in the fit: what the deformation represents well.
struct Bounds {
  double lower, upper;
};
Bounds shapeBounds(const std::string& parameter);

/// A weak prior of the entries of q: a standing body. Means are zero; SD an eighth of the adult range of motion
/// (hip flexion 17 deg, knee 17 deg, ankle 9 deg ...), turned into rotation-vector components with the coordinates'
/// axes. Entries of the root: infinite, nothing is known.
Eigen::VectorXd standingPostureSd(const Skeleton& skeleton);

/// A body drawn from the priors; what has no prior is 1 or 0. Deviations beyond `max_sd` are drawn again.
ShapeParameters drawShape(std::span<const ShapePrior> priors, std::mt19937_64& random, double max_sd = 2.5);

/// A standing posture: clinical coordinates with the SD of the prior, `max_sd` cut off, within the normal range of
/// motion; pelvis turned by some degrees (SD 3 deg tilt and obliquity, 8 deg rotation), its translation 0.
Posture drawStandingPosture(const Skeleton& skeleton, std::mt19937_64& random, double max_sd = 2.0);

}  // namespace sinew
