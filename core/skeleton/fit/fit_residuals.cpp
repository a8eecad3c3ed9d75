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

SharedBody::SharedBody(const FitModel& model, std::vector<int> active, Eigen::VectorXd z, Eigen::VectorXd y,
                       bool nuisances_free)
    : model_{model},
      active_{std::move(active)},
      column_of_(static_cast<std::size_t>(z.size()), -1),
      z_{std::move(z)},
      y_{std::move(y)},
      nuisances_free_{nuisances_free} {
  for (std::size_t i = 0; i < active_.size(); ++i) {
    column_of_[active_[i]] = static_cast<int>(i);
    x_.push_back(z_[active_[i]]);
  }
  if (nuisances_free_) x_.insert(x_.end(), y_.begin(), y_.end());
  const Nuisances& nuisances = model.nuisances;
  for (int e = 0; e < nuisances.exposureCount(); ++e)
    shares_posture_.push_back(e == 0 || (!nuisances_free_ && nuisances.bodyAt(e, z_, y_) == z_) ||
                              nuisances.jointChanges(e).empty());
  points_.resize(shares_posture_.size());
}

Eigen::VectorXd SharedBody::z() const {
  Eigen::VectorXd z = z_;
  for (std::size_t i = 0; i < active_.size(); ++i) z[active_[i]] = x_[i];
  return z;
}

Eigen::VectorXd SharedBody::y() const {
  if (!nuisances_free_) return y_;
  return Eigen::Map<const Eigen::VectorXd>{x_.data() + active_.size(), y_.size()};
}

void SharedBody::PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) {
  if (!new_evaluation_point && !(evaluate_jacobians && points_[0].dp_dz.empty())) return;
  const Eigen::VectorXd z_now = z(), y_now = y();
  disturbed_ = disturbedViews(model_.views, model_.nuisances, y_now, model_.pivot_W);
  for (std::size_t e = 0; e < points_.size(); ++e)
    if (e == 0 || !shares_posture_[e])
      points_[e] = posePoints(model_.skeleton, model_.body, model_.landmarks,
                              model_.nuisances.bodyAt(static_cast<int>(e), z_now, y_now),
                              evaluate_jacobians ? active_ : std::vector<int>{});
}

LandmarkCost::LandmarkCost(const SharedBody& shared, int point, std::vector<SeenPoint> seen,
                           const Eigen::MatrixXd& covariance_px2)
    : shared_{shared}, point_{point}, seen_{std::move(seen)}, root_{covariance_px2} {
  set_num_residuals(2 * static_cast<int>(seen_.size()));
  mutable_parameter_block_sizes()->push_back(shared.size());
}

bool LandmarkCost::Evaluate(const double* const*, double* residuals, double** jacobians) const {
  const FitModel& model = shared_.model();
  const Eigen::Index rows = num_residuals(), first_nuisance = shared_.activeCount();
  Eigen::VectorXd difference_px(rows);
  Eigen::MatrixXd by_x;
  const bool wants_jacobian = jacobians && jacobians[0];
  if (wants_jacobian) by_x = Eigen::MatrixXd::Zero(rows, shared_.size());
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    const int view = seen_[i].view, exposure = model.nuisances.exposureOf(view);
    const PosedPoints& points = shared_.points(exposure);
    const Nuisances::Local& local = model.nuisances.local(view);
    const Eigen::Index row = 2 * static_cast<Eigen::Index>(i);
    if (!wants_jacobian) {
      const auto uv = shared_.view(view).image(points.p_W[point_]);
      if (!uv) return false;
      difference_px.segment<2>(row) = seen_[i].uv_px - *uv;
      continue;
    }
    PointImage image;
    if (!shared_.view(view).image(points.p_W[point_], image)) return false;
    difference_px.segment<2>(row) = seen_[i].uv_px - image.uv_px;
    auto of_sighting = by_x.middleRows<2>(row);
    of_sighting.leftCols(first_nuisance) = -image.by_point * points.dp_dz[point_];
    if (!shared_.nuisancesFree()) continue;
    for (const auto& change : model.nuisances.jointChanges(exposure))
      if (const int column = shared_.columnOf(change.z); column >= 0)
        of_sighting.col(first_nuisance + change.y) = change.ratio * of_sighting.col(column);
    for (int k = 0; k < Nuisances::kLocal; ++k)
      if (local.y[k] >= 0) of_sighting.col(first_nuisance + local.y[k]) = -image.by_local.col(k);
  }
  Eigen::Map<Eigen::VectorXd>{residuals, rows} = root_.matrixL().solve(difference_px);
  if (wants_jacobian)
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>{
        jacobians[0], rows, shared_.size()} = root_.matrixL().solve(by_x);
  return true;
}

}  // namespace sinew
