#include <ceres/jet.h>

#include <algorithm>

#include "core/skeleton/fit/fit_nuisances_internal.h"

namespace sinew {
namespace {

/// Joints of the legs, which a standing patient may move between two exposures without meaning to.
bool isLegJoint(const Joint& joint) {
  return std::ranges::any_of(std::initializer_list<std::string_view>{"hip_", "knee_", "ankle_"},
                             [&](std::string_view begin) { return joint.name.starts_with(begin); });
}

template <class T>
bool projectMoved(const View& view, const Eigen::Vector3d& pivot_W, const Vector3<T>& p_W,
                  const Eigen::Matrix<T, Nuisances::kLocal, 1>& local, Eigen::Matrix<T, 2, 1>& uv_px) {
  const Vector3<T> turn = local.template head<3>(), shift = local.template segment<3>(3);
  const Vector3<T> moved_W = pivot_W.cast<T>() + rotationFromVector<T>(turn) * (p_W - pivot_W.cast<T>()) + shift;
  ViewErrors<T> errors = local.template tail<kViewErrors>();
  errors[kDistanceError] += local[6];
  return projectWithErrors<T>(view, errors, pivot_W, moved_W, uv_px);
}

}  // namespace

Nuisances::Nuisances(const Skeleton& skeleton, const BodyParameters& body, std::span<const FitView> views,
                     const MovementPrior& prior, std::span<const int> observable)
    : prior_{prior} {
  std::vector<int> numbers;  // of exposures, in the order of their first view
  for (const FitView& view : views) {
    const auto at = std::ranges::find(numbers, view.exposure);
    exposure_of_.push_back(static_cast<int>(at - numbers.begin()));
    if (at == numbers.end()) numbers.push_back(view.exposure);
  }
  exposures_.resize(std::max<std::size_t>(numbers.size(), 1));
  for (auto exposure = exposures_.begin() + 1; exposure < exposures_.end(); ++exposure) {
    exposure->movement = count_;
    count_ += 6;
    if (!(prior.joint_rad > 0)) continue;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
      const Joint& joint = skeleton.joints[j];
      if (!isLegJoint(joint)) continue;
      for (int k = 0; k < joint.coordinate_count; ++k) {
        const int z = body.postureBegin() + joint.first_coordinate + k;
        if (std::ranges::find(observable, z) == observable.end()) continue;
        exposure->joints.push_back({z, count_++, prior.joint_rad / body.sd(z), static_cast<int>(j)});
      }
    }
  }
  double common_m = 0;
  for (const FitView& view : views) common_m = std::max(common_m, view.uncertainty.common_distance_m);
  const int common = common_m > 0 ? count_++ : -1;
  for (std::size_t v = 0; v < views.size(); ++v) {
    Local local;
    local.y.fill(-1);
    local.sd.fill(0);
    if (const int movement = exposures_[exposure_of_[v]].movement; movement >= 0)
      for (int k = 0; k < 6; ++k) {
        local.y[k] = movement + k;
        local.sd[k] = k < 3 ? prior.turn_rad : prior.shift_m;
      }
    local.y[6] = common;
    local.sd[6] = common_m;
    const ViewErrors<double> sd = standardDeviations(views[v].uncertainty);
    const bool cone = std::holds_alternative<ConeBeam>(views[v].view.projection);
    for (int k = 0; k < kViewErrors; ++k)
      if (sd[k] > 0 && (cone || k != kDistortionError)) {
        local.y[7 + k] = count_++;
        local.sd[7 + k] = sd[k];
      }
    local_.push_back(local);
  }
}

Eigen::VectorXd Nuisances::bodyAt(int exposure, const Eigen::VectorXd& z, const Eigen::VectorXd& y) const {
  Eigen::VectorXd moved = z;
  for (const JointChange& change : jointChanges(exposure)) moved[change.z] += change.ratio * y[change.y];
  return moved;
}

bool imageOf(const FitView& view, const Nuisances::Local& local, const Eigen::VectorXd& y,
             const Eigen::Vector3d& pivot_W, const Eigen::Vector3d& p_W, PointImage& image) {
  using Jet = ceres::Jet<double, 3 + Nuisances::kLocal>;
  const Vector3<Jet> p{Jet(p_W.x(), 0), Jet(p_W.y(), 1), Jet(p_W.z(), 2)};
  Eigen::Matrix<Jet, Nuisances::kLocal, 1> x;
  for (int k = 0; k < Nuisances::kLocal; ++k) {
    x[k] = Jet(local.y[k] < 0 ? 0.0 : local.sd[k] * y[local.y[k]]);
    x[k].v[3 + k] = local.sd[k];
  }
  Eigen::Matrix<Jet, 2, 1> uv;
  if (!projectMoved<Jet>(view.view, pivot_W, p, x, uv)) return false;
  for (int i = 0; i < 2; ++i) {
    image.uv_px[i] = uv[i].a;
    image.by_point.row(i) = uv[i].v.head<3>();
    image.by_local.row(i) = uv[i].v.tail<Nuisances::kLocal>();
  }
  return true;
}

std::optional<Eigen::Vector2d> imageOf(const FitView& view, const Nuisances::Local& local, const Eigen::VectorXd& y,
                                       const Eigen::Vector3d& pivot_W, const Eigen::Vector3d& p_W) {
  Eigen::Matrix<double, Nuisances::kLocal, 1> x;
  for (int k = 0; k < Nuisances::kLocal; ++k) x[k] = local.y[k] < 0 ? 0.0 : local.sd[k] * y[local.y[k]];
  Eigen::Vector2d uv_px;
  if (!projectMoved<double>(view.view, pivot_W, p_W, x, uv_px)) return std::nullopt;
  return uv_px;
}

}  // namespace sinew
