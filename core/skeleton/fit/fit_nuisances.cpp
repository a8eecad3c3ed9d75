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

using Local = Eigen::Matrix<double, Nuisances::kLocal, 1>;
constexpr int kTurn = 0, kShift = 3, kCommonDistance = 6, kErrors = 7;  // in Local

Local localUnknowns(const Nuisances::Local& local, const Eigen::VectorXd& y) {
  Local x;
  for (int k = 0; k < Nuisances::kLocal; ++k) x[k] = local.y[k] < 0 ? 0.0 : local.sd[k] * y[local.y[k]];
  return x;
}

/// Projection of a point in C with `k1` added to the distortion of a cone beam. T is double or a Jet.
template <class T>
bool projectInView(const View& view, double k1, const Vector3<T>& p_C, Eigen::Matrix<T, 2, 1>& uv_px) {
  if (!std::visit([&](const auto& p) { return detail::project<T>(p, p_C, uv_px); }, view.projection)) return false;
  if (const auto* cone = std::get_if<ConeBeam>(&view.projection); cone && k1 != 0) {
    const T x = p_C.x() / p_C.z(), y = p_C.y() / p_C.z(), bent = T(k1) * (x * x + y * y);
    uv_px.x() += T(cone->fx_px) * bent * x;  // k1 enters the projection linearly
    uv_px.y() += T(cone->fy_px) * bent * y;
  }
  return true;
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
        const Eigen::Vector3d axis = joint.type == JointType::Revolute
                                         ? skeleton.coordinates[joint.first_coordinate].axis
                                         : Eigen::Vector3d::Unit(k);
        exposure->joints.push_back({z, count_++, prior.joint_rad / body.sd(z), static_cast<int>(j), axis});
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
    const Eigen::Matrix<double, kViewErrors, 1> sd = standardDeviations(views[v].uncertainty);
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

DisturbedView::Turn::Turn(const Eigen::Vector3d& v_rad) {
  using Jet = ceres::Jet<double, 3>;
  const Matrix3<Jet> turn = rotationFromVector<Jet>({Jet(v_rad.x(), 0), Jet(v_rad.y(), 1), Jet(v_rad.z(), 2)});
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      R(r, c) = turn(r, c).a;
      for (int k = 0; k < 3; ++k) by_entry[k](r, c) = turn(r, c).v[k];
    }
}

DisturbedView::DisturbedView(const FitView& view, const Nuisances::Local& local, const Eigen::VectorXd& y,
                             const Eigen::Vector3d& pivot_W)
    : view_{view.view},
      local_{local},
      pivot_W_{pivot_W},
      pivot_C_{view.view.R_CW * pivot_W + view.view.p_CW},
      x_{localUnknowns(local, y)},
      body_{x_.segment<3>(kTurn)},
      frame_{x_.segment<3>(kErrors + kTurnError)},
      middle_px_{principalPoint_px(view.view)} {
  pivot_C_.z() += x_[kCommonDistance] + x_[kErrors + kDistanceError];
}

std::optional<Eigen::Vector2d> DisturbedView::image(const Eigen::Vector3d& p_W) const {
  const Eigen::Vector3d moved_W = body_.R * (p_W - pivot_W_) + x_.segment<3>(kShift);
  const Eigen::Vector3d p_C = pivot_C_ + frame_.R * view_.R_CW * moved_W;
  Eigen::Vector2d uv_px;
  if (!projectInView<double>(view_, x_[kErrors + kDistortionError], p_C, uv_px)) return std::nullopt;
  return uv_px + x_[kErrors + kScaleError] * (uv_px - middle_px_) + x_.segment<2>(kErrors + kShiftError);
}

bool DisturbedView::image(const Eigen::Vector3d& p_W, PointImage& image) const {
  using Jet = ceres::Jet<double, 3>;
  const Eigen::Vector3d arm_W = p_W - pivot_W_;
  const Eigen::Vector3d arm_C = view_.R_CW * (body_.R * arm_W + x_.segment<3>(kShift));
  const Eigen::Vector3d p = pivot_C_ + frame_.R * arm_C;
  Eigen::Matrix<Jet, 2, 1> uv;
  if (!projectInView<Jet>(view_, x_[kErrors + kDistortionError], {Jet(p.x(), 0), Jet(p.y(), 1), Jet(p.z(), 2)}, uv))
    return false;
  const Eigen::Vector2d uv_px{uv[0].a, uv[1].a};
  const double zoom = 1 + x_[kErrors + kScaleError];
  Eigen::Matrix<double, 2, 3> by_C;
  for (int i = 0; i < 2; ++i) by_C.row(i) = zoom * uv[i].v.transpose();
  image.uv_px = uv_px + x_[kErrors + kScaleError] * (uv_px - middle_px_) + x_.segment<2>(kErrors + kShiftError);
  const Eigen::Matrix<double, 2, 3> by_moved = by_C * frame_.R * view_.R_CW;
  image.by_point = by_moved * body_.R;
  for (int k = 0; k < 3; ++k) {
    image.by_local.col(kTurn + k) = by_moved * (body_.by_entry[k] * arm_W);
    image.by_local.col(kErrors + kTurnError + k) = by_C * (frame_.by_entry[k] * arm_C);
  }
  image.by_local.middleCols<3>(kShift) = by_moved;
  image.by_local.col(kCommonDistance) = image.by_local.col(kErrors + kDistanceError) = by_C.col(2);
  image.by_local.col(kErrors + kScaleError) = uv_px - middle_px_;
  image.by_local.middleCols<2>(kErrors + kShiftError).setIdentity();
  image.by_local.col(kErrors + kDistortionError).setZero();
  if (const auto* cone = std::get_if<ConeBeam>(&view_.projection)) {
    const Eigen::Vector2d xy = p.head<2>() / p.z();
    image.by_local.col(kErrors + kDistortionError) =
        zoom * xy.squaredNorm() * xy.cwiseProduct(Eigen::Vector2d{cone->fx_px, cone->fy_px});
  }
  for (int k = 0; k < Nuisances::kLocal; ++k) image.by_local.col(k) *= local_.sd[k];
  return true;
}

std::vector<DisturbedView> disturbedViews(std::span<const FitView> views, const Nuisances& nuisances,
                                          const Eigen::VectorXd& y, const Eigen::Vector3d& pivot_W) {
  std::vector<DisturbedView> list;
  for (std::size_t v = 0; v < views.size(); ++v)
    list.emplace_back(views[v], nuisances.local(static_cast<int>(v)), y, pivot_W);
  return list;
}

}  // namespace sinew
