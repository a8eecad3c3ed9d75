#include "core/skeleton/fit/fit_noise_internal.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace sinew {
namespace {

constexpr int kCauses = 3;  // pick, definition, blur
/// Prior of each variance: as many observations of the stated one.
constexpr std::array<double, kCauses> kPriorObservations = {10, 4, 3};
constexpr double kStatedBlur_m = 0.0005, kStartBlur_m = 0.001;

using Variances = std::array<double, kCauses>;

/// What a step of the estimate needs of every cause: y'P V P y and tr(P V), P the projection that takes the fitted
/// part out (Searle, Casella & McCulloch 1992, ch. 6).
struct Moments {
  Variances squares{}, traces{};
};

const Eigen::MatrixXd& part(const LandmarkNoise& noise, int cause) {
  return cause == 0 ? noise.pick : cause == 1 ? noise.definition : noise.blur;
}

Moments momentsAt(std::span<const LinearizedLandmark> landmarks, const Eigen::VectorXd& weights,
                  const Eigen::VectorXd& x, const PickScale& scale, int causes) {
  Eigen::MatrixXd normal = weights.cwiseAbs2().asDiagonal();
  Eigen::VectorXd gradient = weights.cwiseAbs2().cwiseProduct(x);
  std::vector<Eigen::LLT<Eigen::MatrixXd>> roots;
  std::vector<Eigen::MatrixXd> whitened;
  for (const auto& l : landmarks) {
    const auto& root = roots.emplace_back(l.noise.at(scale));
    const Eigen::MatrixXd& J = whitened.emplace_back(root.matrixL().solve(l.jacobian_px));
    normal.selfadjointView<Eigen::Lower>().rankUpdate(J.transpose());
    gradient += J.transpose() * root.matrixL().solve(l.residual_px);
  }
  const Eigen::LLT<Eigen::MatrixXd> normal_root{normal.selfadjointView<Eigen::Lower>()};
  const Eigen::VectorXd step = -normal_root.solve(gradient);
  Moments moments;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const Eigen::VectorXd left = landmarks[i].residual_px + landmarks[i].jacobian_px * step;
    const Eigen::VectorXd Py = roots[i].solve(left);
    // P's own block: C^-1 - C^-1 J H^-1 J' C^-1.
    const Eigen::MatrixXd half = normal_root.matrixL().solve(whitened[i].transpose());  // n x rows
    const Eigen::Index rows = left.size();
    const Eigen::MatrixXd inner = Eigen::MatrixXd::Identity(rows, rows) - half.transpose() * half;
    const Eigen::MatrixXd inverse_root = roots[i].matrixL().solve(Eigen::MatrixXd::Identity(rows, rows));
    const Eigen::MatrixXd P = inverse_root.transpose() * inner * inverse_root;
    for (int k = 0; k < causes; ++k) {
      const Eigen::MatrixXd& V = part(landmarks[i].noise, k);
      moments.squares[k] += Py.dot(V * Py);
      moments.traces[k] += P.cwiseProduct(V).sum();
    }
  }
  return moments;
}

PickScale scaleOf(const Variances& v) {
  constexpr double kMm = 1000;
  return {std::sqrt(v[0]), std::sqrt(v[1]), kMm * std::sqrt(v[2])};
}

}  // namespace

Eigen::MatrixXd LandmarkNoise::at(const PickScale& scale) const {
  constexpr double kMetre = 1e-3;
  return scale.pick * scale.pick * pick + scale.definition * scale.definition * definition +
         std::pow(kMetre * scale.blur_mm, 2) * blur;
}

PickScale estimatePickScale(std::span<const LinearizedLandmark> landmarks, const Eigen::VectorXd& weights,
                            const Eigen::VectorXd& x, bool definitions) {
  const Variances stated = {1, 1, kStatedBlur_m * kStatedBlur_m};
  // Both causes of definition errors start in the middle of what readers do, not where their priors are.
  Variances variances = definitions ? Variances{1, 0.5, kStartBlur_m * kStartBlur_m} : Variances{1, 0, 0};
  const int causes = definitions ? kCauses : 1;
  constexpr int kMostSteps = 40;
  constexpr double kSettled = 0.003;  // of a variance a step; two causes that look alike settle slowly
  for (int step = 0; step < kMostSteps; ++step) {
    const Moments m = momentsAt(landmarks, weights, x, scaleOf(variances), causes);
    double change = 0;
    for (int k = 0; k < causes; ++k) {
      const double prior = kPriorObservations[k], v = variances[k];
      double next = v * (m.squares[k] + prior * stated[k] / (v * v)) / (m.traces[k] + prior / v);
      if (k == 0) next = std::max(next, 1.0);  // nobody picks better than he says
      change = std::max(change, std::abs(next - v) / std::max(next, stated[k]));
      variances[k] = next;
    }
    if (change < kSettled) break;
  }
  return scaleOf(variances);
}

}  // namespace sinew
