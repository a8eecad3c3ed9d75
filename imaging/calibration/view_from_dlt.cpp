#include <Eigen/Dense>
#include <cmath>

#include "imaging/calibration/calibration_internal.h"

namespace sinew {
namespace {

/// Similarity that brings points to mean 0 and RMS distance sqrt(dimension): keeps the equations well scaled.
template <int N>
Eigen::Matrix<double, N + 1, N + 1> normaliser(const std::vector<Eigen::Matrix<double, N, 1>>& points) {
  Eigen::Matrix<double, N, 1> mean = Eigen::Matrix<double, N, 1>::Zero();
  for (const auto& p : points) mean += p / double(points.size());
  double spread = 0;
  for (const auto& p : points) spread += (p - mean).squaredNorm() / double(points.size());
  const double s = std::sqrt(N / spread);
  Eigen::Matrix<double, N + 1, N + 1> T = Eigen::Matrix<double, N + 1, N + 1>::Identity() * s;
  T.template topRightCorner<N, 1>() = -s * mean;
  T(N, N) = 1;
  return T;
}

}  // namespace

std::optional<View> viewFromDlt(const std::vector<Eigen::Vector3d>& points_W,
                                const std::vector<Eigen::Vector2d>& uv_px) {
  require(points_W.size() == uv_px.size(), "one image point for each point");
  if (points_W.size() < 6 || flatness(points_W) < 1e-3) return std::nullopt;
  const Eigen::Matrix4d T = normaliser<3>(points_W);
  const Eigen::Matrix3d S = normaliser<2>(uv_px);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * Eigen::Index(points_W.size()), 12);
  for (std::size_t i = 0; i < points_W.size(); ++i) {
    const Eigen::RowVector4d X = (T * points_W[i].homogeneous()).transpose();
    const Eigen::Vector3d x = S * uv_px[i].homogeneous();
    const Eigen::Index row = 2 * Eigen::Index(i);
    A.block<1, 4>(row, 0) = X;
    A.block<1, 4>(row, 8) = -x.x() * X;
    A.block<1, 4>(row + 1, 4) = X;
    A.block<1, 4>(row + 1, 8) = -x.y() * X;
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd{A, Eigen::ComputeThinV};
  if (!(svd.singularValues()[10] > 1e-9 * svd.singularValues()[0])) return std::nullopt;
  const Eigen::VectorXd p = svd.matrixV().col(11);
  Eigen::Matrix<double, 3, 4> P;
  P << p.segment<4>(0).transpose(), p.segment<4>(4).transpose(), p.segment<4>(8).transpose();
  P = S.inverse() * P * T;
  if (P.row(2).dot(points_W[0].homogeneous()) < 0) P = -P;  // the points lie in front of the source

  // P = K [Q | t] with K upper triangular: QR of the rows in reverse order. Q may be a mirror.
  const Eigen::Matrix3d M = P.leftCols<3>(), reversed = M.colwise().reverse().transpose();
  const Eigen::HouseholderQR<Eigen::Matrix3d> qr{reversed};
  const Eigen::Matrix3d upper = qr.matrixQR().triangularView<Eigen::Upper>();
  Eigen::Matrix3d K = upper.transpose().colwise().reverse().rowwise().reverse();
  Eigen::Matrix3d Q = Eigen::Matrix3d{qr.householderQ()}.transpose().colwise().reverse();
  for (int k = 0; k < 3; ++k)
    if (K(k, k) < 0) {
      K.col(k) *= -1;
      Q.row(k) *= -1;
    }
  const double scale = K(2, 2);
  if (!(scale > 0) || !K.allFinite()) return std::nullopt;
  View view;
  view.p_CW = K.inverse() * P.col(3);
  view.R_CW = Q;
  K /= scale;
  view.projection = ConeBeam{K(0, 0), K(1, 1), K(0, 2), K(1, 2)};
  return view;
}

}  // namespace sinew
