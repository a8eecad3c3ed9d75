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

/// Unknowns of one view, as the residuals want them.
struct ViewUnknowns {
  Eigen::Vector4d intrinsics;
  Eigen::Matrix<double, 6, 1> pose;
  Eigen::Matrix3d R0;
  double aspect;

  explicit ViewUnknowns(const View& view) : R0{view.R_CW} {
    const auto& c = std::get<ConeBeam>(view.projection);
    intrinsics << c.fx_px, c.cx_px, c.cy_px, c.k1;
    pose << Eigen::Vector3d::Zero(), view.p_CW;
    aspect = c.fy_px / c.fx_px;
  }
  View view(const View& start) const {
    View out = start;
    out.projection = ConeBeam{.fx_px = intrinsics[0],
                              .fy_px = aspect * intrinsics[0],
                              .cx_px = intrinsics[1],
                              .cy_px = intrinsics[2],
                              .k1 = intrinsics[3]};
    out.R_CW = R0 * rotationFromVector<double>(pose.head<3>());
    out.p_CW = pose.tail<3>();
    return out;
  }
};

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

/// Squared error [m^2] to expect of a point at p_W that is seen in both views with `sigma_px`: its own noise and that
/// of the calibration, carried through the triangulation (first order).
double expectedSquaredError(const std::array<ViewUnknowns, 2>& views, const Eigen::Vector3d& p_W,
                            const Eigen::MatrixXd& view_covariance, double sigma_px) {
  const Eigen::Index per_view = view_covariance.cols() / 2, of_intrinsics = per_view - 6;
  Eigen::Matrix<double, 4, 3> by_point;
  Eigen::MatrixXd by_view = Eigen::MatrixXd::Zero(4, 2 * per_view);
  for (Eigen::Index i = 0; i < 2; ++i) {
    const ViewUnknowns& v = views[std::size_t(i)];
    const std::unique_ptr<ceres::CostFunction> cost{
        BeadProjectionResidual::create(Eigen::Vector2d::Zero(), 1, v.R0, v.aspect)};
    const double* parameters[] = {v.intrinsics.data(), v.pose.data(), p_W.data()};
    Eigen::Matrix<double, 2, 4, Eigen::RowMajor> d_intrinsics;
    Eigen::Matrix<double, 2, 6, Eigen::RowMajor> d_pose;
    Eigen::Matrix<double, 2, 3, Eigen::RowMajor> d_point;
    double* jacobians[] = {d_intrinsics.data(), d_pose.data(), d_point.data()};
    double residual[2];
    if (!cost->Evaluate(parameters, residual, jacobians)) return std::numeric_limits<double>::quiet_NaN();
    by_point.middleRows<2>(2 * i) = d_point;
    by_view.block(2 * i, i * per_view, 2, of_intrinsics) = d_intrinsics.leftCols(of_intrinsics);
    by_view.block(2 * i, i * per_view + of_intrinsics, 2, 6) = d_pose;
  }
  const Eigen::Matrix<double, 3, 4> solve = (by_point.transpose() * by_point).inverse() * by_point.transpose();
  const Eigen::Matrix4d noise =
      sigma_px * sigma_px * Eigen::Matrix4d::Identity() + by_view * view_covariance * by_view.transpose();
  return (solve * noise * solve.transpose()).trace();
}

}  // namespace

RefinedViews refineViews(const CalibrationObject& object, const std::vector<BeadObservation>& observations,
                         const std::array<View, 2>& start, const CalibrationOptions& options, const Job& job) {
  std::array<ViewUnknowns, 2> views{ViewUnknowns{start[0]}, ViewUnknowns{start[1]}};
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
  std::vector<double*> blocks;
  for (auto& v : views) {
    blocks.push_back(v.intrinsics.data());
    blocks.push_back(v.pose.data());
    if (!options.estimate_distortion) problem.SetManifold(v.intrinsics.data(), new ceres::SubsetManifold{4, {3}});
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

  for (std::size_t i = 0; i < 2; ++i) result.views[i] = views[i].view(start[i]);
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
  const Eigen::Index per_view = options.estimate_distortion ? 10 : 9;
  double cost = 0;
  problem.Evaluate({}, &cost, nullptr, nullptr, nullptr);
  sum_sigma2 = 2 * cost;
  // Scatter beyond what the detections and the bead file promise widens everything.
  const double excess =
      std::max(1.0, sum_sigma2 / std::max(2.0 * double(observations.size()) - 2.0 * double(per_view), 1.0));
  const Eigen::MatrixXd covariance = excess * inverseOfNormal(jacobian).topLeftCorner(2 * per_view, 2 * per_view);
  double sum_m2 = 0;
  for (const auto& bead : object.beads)
    sum_m2 += expectedSquaredError(views, bead.p_WQ, covariance, std::sqrt(excess * sigma_px2));
  result.accuracy_mm = std::sqrt(sum_m2 / double(object.beads.size())) / kMillimetre_m;
  for (Eigen::Index i = 0; i < 2; ++i) {
    const double error = std::sqrt(covariance(i * per_view, i * per_view)) / views[std::size_t(i)].intrinsics[0];
    if (!(error <= result.focal_length_error)) result.focal_length_error = error;
  }
  return result;
}

}  // namespace sinew
