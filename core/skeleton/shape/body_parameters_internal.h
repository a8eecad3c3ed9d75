#pragma once
#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "core/skeleton/kinematics.h"
#include "core/skeleton/shape/population.h"
#include "core/skeleton/shape/shape.h"
#include "core/skeleton/shape/shape_priors.h"

namespace sinew {

/// Every unknown of a body as one vector z of standardized deviations from the population: size, the shape
/// parameters, the entries of q. Prior of entry i: Gaussian with mean 0 and SD 1 / prior_weight[i]; almost flat for
/// the root.
///   shape ratio or length = size * (mean + sd z),   shape angle = mean + sd z,   q = q_start + sd z
class BodyParameters {
 public:
  BodyParameters(const Skeleton& skeleton, std::span<const ShapePrior> priors);

  int count() const { return static_cast<int>(mean_.size()); }
  int shapeCount() const { return shape_count_; }
  static constexpr int kSize = 0, kShapeBegin = 1;
  int postureBegin() const { return kShapeBegin + shape_count_; }

  double priorWeight(int i) const { return prior_weight_[i]; }
  double lower(int i) const { return lower_[i]; }
  double upper(int i) const { return upper_[i]; }
  bool hasPrior(int i) const { return sd_[i] > 0; }
  double sd(int i) const { return sd_[i]; }
  /// An added angle or length of the shape: what deformities change.
  bool isDeformable(int i) const { return deformable_[i]; }

  /// Moves the origin of the root's entries, whose prior is flat.
  void setRootStart(const Eigen::Vector3d& p_W, const Eigen::Vector3d& rotation_vector_rad);
  double meanSize() const { return mean_[kSize]; }
  double zOfSize(double size) const { return sd_[kSize] > 0 ? (size - mean_[kSize]) / sd_[kSize] : 0; }

  template <class T>
  void expand(std::span<const T> z, std::vector<T>& shape, std::vector<T>& q) const {
    const auto value = [&](int i) { return T(mean_[i]) + T(sd_[i]) * z[i]; };
    const T size = value(kSize);
    shape.resize(shape_count_);
    for (int i = 0; i < shape_count_; ++i)
      shape[i] = is_angle_[i] ? value(kShapeBegin + i) : size * value(kShapeBegin + i);
    q.resize(count() - postureBegin());
    for (int i = 0; i < static_cast<int>(q.size()); ++i) q[i] = value(postureBegin() + i);
  }

 private:
  int shape_count_;
  std::vector<double> mean_, sd_, prior_weight_, lower_, upper_;
  std::vector<bool> is_angle_, deformable_;
};

}  // namespace sinew
