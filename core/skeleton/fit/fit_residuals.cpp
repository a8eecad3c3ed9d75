#include "core/skeleton/fit/fit_residuals.h"

#include <algorithm>

#include "core/skeleton/fit/posed_landmarks_internal.h"

namespace sinew {
namespace {

template <class T>
std::vector<Vector3<T>> posed(const Skeleton& skeleton, const BodyParameters& body, std::span<const int> landmarks,
                              const std::vector<T>& z) {
  std::vector<T> shape, q;
  body.expand<T>(z, shape, q);
  return posedLandmarks<T>(skeleton, landmarks, shape, q);
}

}  // namespace

PosedPoints posePoints(const Skeleton& skeleton, const BodyParameters& body, std::span<const int> landmarks,
                       const Eigen::VectorXd& z, std::span<const int> active) {
  PosedPoints points;
  if (active.empty()) {
    points.p_W = posed<double>(skeleton, body, landmarks, {z.begin(), z.end()});
    return points;
  }
  constexpr std::size_t kAtOnce = 24;  // two passes for the unknowns of pelvis and legs
  using Jet = ceres::Jet<double, kAtOnce>;
  points.dp_dz.assign(landmarks.size(), Eigen::Matrix3Xd(3, active.size()));
  for (std::size_t begin = 0; begin < active.size(); begin += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, active.size() - begin);
    std::vector<Jet> jets(z.begin(), z.end());
    for (std::size_t i = 0; i < count; ++i) jets[active[begin + i]].v[i] = 1;
    const auto p_W = posed<Jet>(skeleton, body, landmarks, jets);
    for (std::size_t l = 0; l < landmarks.size(); ++l)
      for (int axis = 0; axis < 3; ++axis)
        points.dp_dz[l].row(axis).segment(begin, count) = p_W[l][axis].v.head(count);
    if (begin > 0) continue;
    for (const auto& p : p_W) points.p_W.emplace_back(p.x().a, p.y().a, p.z().a);
  }
  return points;
}

}  // namespace sinew
