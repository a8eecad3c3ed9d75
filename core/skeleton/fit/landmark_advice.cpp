#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/skeleton/fit/bone_figures_internal.h"
#include "core/skeleton/fit/figure_report_internal.h"
#include "core/skeleton/fit/fit_residuals.h"

namespace sinew {
namespace {

/// A landmark that could be picked in some views: its rows in the joint covariance.
struct Candidate {
  std::string landmark;
  Eigen::Index begin = 0, rows = 0;
  double sigma_px = 1;
};

double typicalSigma_px(const FitEvidence& evidence) {
  std::vector<double> sigmas;
  for (const LandmarkPicks& picks : evidence.picks)
    for (Eigen::Index k = 0; k < picks.uv_px.size(); ++k) sigmas.push_back(std::sqrt(picks.covariance_px2(k, k)));
  if (sigmas.empty()) return 1;
  std::ranges::nth_element(sigmas, sigmas.begin() + long(sigmas.size() / 2));
  return sigmas[sigmas.size() / 2];
}

/// Rows of the derivative by z of all picks that are still missing, and whose they are.
std::vector<Candidate> candidatesOf(const FitEvidence& evidence, Eigen::MatrixXd& by_z) {
  std::vector<int> landmarks;
  for (const auto& name : evidence.offered) {
    const int index = evidence.reference.landmarkIndex(name);
    if (evidence.reference.landmarks[std::size_t(index)].segment < evidence.reference.movingSegmentCount())
      landmarks.push_back(index);
  }
  std::vector<int> all(static_cast<std::size_t>(evidence.z.size()));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = int(i);
  const PosedPoints posed = posePoints(evidence.reference, evidence.body, landmarks, evidence.z, all);
  const double sigma_px = typicalSigma_px(evidence);
  by_z.resize(2 * evidence.view_count * Eigen::Index(landmarks.size()), evidence.z.size());
  std::vector<Candidate> candidates;
  Eigen::Index row = 0;
  for (std::size_t l = 0; l < landmarks.size(); ++l) {
    Candidate candidate{evidence.reference.landmarks[std::size_t(landmarks[l])].name, row, 0, sigma_px};
    for (int view = 0; view < evidence.view_count; ++view) {
      const bool has = std::ranges::any_of(evidence.picks, [&](const LandmarkPicks& picks) {
        return picks.landmark == landmarks[l] && std::ranges::find(picks.views, view) != picks.views.end();
      });
      SeenImage seen;
      if (has || !evidence.image(landmarks[l], view, posed.p_W[l], seen)) continue;
      by_z.middleRows<2>(row) = seen.by_point * posed.dp_dz[l];
      row += 2;
      candidate.rows += 2;
    }
    if (candidate.rows > 0) candidates.push_back(candidate);
  }
  by_z.conservativeResize(row, Eigen::NoChange);
  return candidates;
}

}  // namespace

FigureAdvice adviceFor(const FitEvidence& evidence, const FittedFigures& figures, std::size_t figure,
                       double limit_sd) {
  const BoneFigure& named = figureList()[figure];
  FigureAdvice advice{named.quantity, named.side, {}, false};
  Eigen::MatrixXd by_z;
  std::vector<Candidate> left = candidatesOf(evidence, by_z);
  const Eigen::Index rows = by_z.rows();
  // Joint covariance of all missing picks (without their own noise) and, as the last row, of the figure.
  Eigen::MatrixXd all(rows + 1, by_z.cols());
  all << by_z, figures.by_z.row(static_cast<Eigen::Index>(figure));
  Eigen::MatrixXd joint = all * evidence.covariance * all.transpose();
  constexpr std::size_t kMost = 6;
  while (!left.empty() && advice.landmarks.size() < kMost && joint(rows, rows) > limit_sd * limit_sd) {
    const auto noisy = [&](const Candidate& c) -> Eigen::MatrixXd {
      return joint.block(c.begin, c.begin, c.rows, c.rows) +
             c.sigma_px * c.sigma_px * Eigen::MatrixXd::Identity(c.rows, c.rows);
    };
    const auto gain = [&](const Candidate& c) {
      const Eigen::VectorXd shared = joint.block(c.begin, rows, c.rows, 1);
      return shared.dot(noisy(c).llt().solve(shared));
    };
    const auto best = std::ranges::max_element(left, {}, gain);
    constexpr double kWorthIt = 0.01;  // of the variance that is left
    if (gain(*best) < kWorthIt * joint(rows, rows)) break;
    const Eigen::MatrixXd of_pick = joint.middleRows(best->begin, best->rows);
    joint -= of_pick.transpose() * noisy(*best).llt().solve(of_pick);
    advice.landmarks.push_back(best->landmark);
    left.erase(best);
  }
  advice.enough = joint(rows, rows) <= limit_sd * limit_sd;
  return advice;
}

}  // namespace sinew
