#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/ceres_job_internal.h"
#include "imaging/calibration/bead_residuals.h"
#include "imaging/calibration/calibration_internal.h"

namespace sinew {
namespace {

constexpr double kMillimetre_m = 1e-3;
constexpr double kOutlier_sigma = 3;  // beyond it the loss grows linearly (Huber)

/// How many entries of the intrinsics are unknown: the distortion's are last, k1 first of them.
int freeIntrinsics(EstimatedDistortion distortion) {
  switch (distortion) {
    case EstimatedDistortion::None:
      return ViewUnknowns::kFirstDistortion;
    case EstimatedDistortion::FirstRadial:
      return ViewUnknowns::kFirstDistortion + 1;
    case EstimatedDistortion::Full:
      return ViewUnknowns::kIntrinsics;
  }
  return ViewUnknowns::kIntrinsics;
}

Eigen::MatrixXd denseJacobian(ceres::Problem& problem, const std::vector<double*>& blocks) {
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = blocks;
  options.apply_loss_function = false;
  ceres::CRSMatrix sparse;
  problem.Evaluate(options, nullptr, nullptr, nullptr, &sparse);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(sparse.num_rows, sparse.num_cols);
  for (int row = 0; row < sparse.num_rows; ++row)
    for (int k = sparse.rows[std::size_t(row)]; k < sparse.rows[std::size_t(row) + 1]; ++k)
      dense(row, sparse.cols[std::size_t(k)]) = sparse.values[std::size_t(k)];
  return dense;
}

/// Inverse of a normal matrix, columns brought to one scale first; NaN where it is singular.
Eigen::MatrixXd inverseOfNormal(const Eigen::MatrixXd& jacobian) {
  const Eigen::VectorXd scale = jacobian.colwise().norm().cwiseInverse();
  const Eigen::MatrixXd scaled = jacobian * scale.asDiagonal();
  const Eigen::LLT<Eigen::MatrixXd> llt{scaled.transpose() * scaled};
  const Eigen::Index n = jacobian.cols();
  if (llt.info() != Eigen::Success) return Eigen::MatrixXd::Constant(n, n, std::numeric_limits<double>::quiet_NaN());
  return scale.asDiagonal() * llt.solve(Eigen::MatrixXd::Identity(n, n)) * scale.asDiagonal();
}

/// Squared error [m^2] to expect of a point at p_W that is seen in all views with `sigma_px`: its own noise and that
/// of the calibration, carried through the triangulation (first order).
double expectedSquaredError(const std::vector<ViewUnknowns>& views, const Eigen::Vector3d& p_W,
                            const Eigen::MatrixXd& view_covariance, double sigma_px) {
  const Eigen::Index count = Eigen::Index(views.size()), per_view = view_covariance.cols() / count;
  const Eigen::Index of_intrinsics = per_view - 6;
  Eigen::Matrix<double, Eigen::Dynamic, 3> by_point(2 * count, 3);
  Eigen::MatrixXd by_view = Eigen::MatrixXd::Zero(2 * count, count * per_view);
  for (Eigen::Index i = 0; i < count; ++i) {
    const ViewUnknowns& v = views[std::size_t(i)];
    const std::unique_ptr<ceres::CostFunction> cost{
        BeadProjectionResidual::create(Eigen::Vector2d::Zero(), 1, v.R0, v.aspect)};
    const double* parameters[] = {v.intrinsics.data(), v.pose.data(), p_W.data()};
    Eigen::Matrix<double, 2, ViewUnknowns::kIntrinsics, Eigen::RowMajor> d_intrinsics;
    Eigen::Matrix<double, 2, 6, Eigen::RowMajor> d_pose;
    Eigen::Matrix<double, 2, 3, Eigen::RowMajor> d_point;
    double* jacobians[] = {d_intrinsics.data(), d_pose.data(), d_point.data()};
    double residual[2];
    if (!cost->Evaluate(parameters, residual, jacobians)) return std::numeric_limits<double>::quiet_NaN();
    by_point.middleRows<2>(2 * i) = d_point;
    by_view.block(2 * i, i * per_view, 2, of_intrinsics) = d_intrinsics.leftCols(of_intrinsics);
    by_view.block(2 * i, i * per_view + of_intrinsics, 2, 6) = d_pose;
  }
  const Eigen::Matrix3d normal = by_point.transpose() * by_point;
  const Eigen::MatrixXd solve = normal.inverse() * by_point.transpose();
  const Eigen::MatrixXd noise = sigma_px * sigma_px * Eigen::MatrixXd::Identity(2 * count, 2 * count) +
                                by_view * view_covariance * by_view.transpose();
  return (solve * noise * solve.transpose()).trace();
}

}  // namespace

ViewUnknowns::ViewUnknowns(const View& view) : R0{view.R_CW} {
  const auto& c = std::get<ConeBeam>(view.projection);
  intrinsics << c.fx_px, c.cx_px, c.cy_px, c.k1, c.k2, c.p1, c.p2, c.k3;
  pose << Eigen::Vector3d::Zero(), view.p_CW;
  aspect = c.fy_px / c.fx_px;
}

View ViewUnknowns::view(const View& start) const {
  View out = start;
  const auto c = pinhole(intrinsics.data(), aspect);
  out.projection = ConeBeam{c.fx_px, c.fy_px, c.cx_px, c.cy_px, c.k1, c.k2, c.p1, c.p2, c.k3};
  out.R_CW = R0 * rotationFromVector<double>(pose.head<3>());
  out.p_CW = pose.tail<3>();
  return out;
}

RefinedViews refineViews(const CalibrationObject& object, const std::vector<BeadObservation>& observations,
                         const std::vector<View>& start, const CalibrationOptions& options, const Job& job) {
  std::vector<ViewUnknowns> views(start.begin(), start.end());
  std::vector<Eigen::Vector3d> beads;
  for (const auto& bead : object.beads) beads.push_back(bead.p_WQ);

  ceres::Problem problem;
  std::vector<bool> seen(beads.size());
  for (const auto& o : observations) {
    ViewUnknowns& v = views[std::size_t(o.view)];
    problem.AddResidualBlock(BeadProjectionResidual::create(o.uv_px, o.sigma_px, v.R0, v.aspect),
                             new ceres::HuberLoss{kOutlier_sigma}, v.intrinsics.data(), v.pose.data(),
                             beads[std::size_t(o.bead)].data());
    seen[std::size_t(o.bead)] = true;
  }
  const int free_intrinsics = freeIntrinsics(options.estimate_distortion);
  std::vector<int> known;  // entries that stay as they started
  for (int i = free_intrinsics; i < ViewUnknowns::kIntrinsics; ++i) known.push_back(i);
  std::vector<double*> blocks;
  for (auto& v : views) {
    blocks.push_back(v.intrinsics.data());
    blocks.push_back(v.pose.data());
    if (free_intrinsics < ViewUnknowns::kIntrinsics)
      problem.SetManifold(v.intrinsics.data(), new ceres::SubsetManifold{ViewUnknowns::kIntrinsics, known});
  }
  for (std::size_t i = 0; i < beads.size(); ++i)
    if (seen[i]) {
      problem.AddResidualBlock(
          BeadPlaceResidual::create(object.beads[i].p_WQ, options.bead_position_sigma_mm * kMillimetre_m), nullptr,
          beads[i].data());
      blocks.push_back(beads[i].data());
    }

  CeresJob monitor{job, "calibration", options.max_iterations};
  ceres::Solver::Options solver = solverOptions(monitor, options.max_iterations);
  solver.function_tolerance = 1e-12;
  solver.parameter_tolerance = 1e-12;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  RefinedViews result;
  result.outcome = outcomeOf(summary);
  if (result.outcome != Outcome::Converged) return result;

  for (std::size_t i = 0; i < views.size(); ++i) result.views.push_back(views[i].view(start[i]));
  double sum_px2 = 0, sum_sigma2 = 0, sigma_px2 = 0;
  for (const auto& o : observations) {
    // Against the beads' nominal places: what a user would see overlaid.
    const auto seen_px = project(result.views[std::size_t(o.view)], object.beads[std::size_t(o.bead)].p_WQ);
    result.residual_px.push_back(seen_px ? Eigen::Vector2d{o.uv_px - *seen_px}
                                         : Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()));
    sum_px2 += result.residual_px.back().squaredNorm();
    sigma_px2 += o.sigma_px * o.sigma_px / double(observations.size());
  }
  result.rms_px = std::sqrt(sum_px2 / double(observations.size()));

  const Eigen::MatrixXd jacobian = denseJacobian(problem, blocks);
  const Eigen::Index count = Eigen::Index(views.size()), per_view = free_intrinsics + 6;
  double cost = 0;
  problem.Evaluate({}, &cost, nullptr, nullptr, nullptr);
  sum_sigma2 = 2 * cost;
  // Scatter beyond what the detections and the bead file promise widens everything.
  const double excess =
      std::max(1.0, sum_sigma2 / std::max(2.0 * double(observations.size()) - double(count * per_view), 1.0));
  const Eigen::MatrixXd covariance =
      excess * inverseOfNormal(jacobian).topLeftCorner(count * per_view, count * per_view);
  double sum_m2 = 0;
  for (const auto& bead : object.beads)
    sum_m2 += expectedSquaredError(views, bead.p_WQ, covariance, std::sqrt(excess * sigma_px2));
  result.accuracy_mm = std::sqrt(sum_m2 / double(object.beads.size())) / kMillimetre_m;
  for (Eigen::Index i = 0; i < count; ++i) {
    const double error = std::sqrt(covariance(i * per_view, i * per_view)) / views[std::size_t(i)].intrinsics[0];
    if (!(error <= result.focal_length_error)) result.focal_length_error = error;
  }
  return result;
}

}  // namespace sinew
