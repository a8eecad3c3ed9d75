#include "core/skeleton/fit/fit_skeleton.h"

#include <ceres/crs_matrix.h>
#include <ceres/loss_function.h>
#include <ceres/problem.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/ceres_job_internal.h"
#include "core/skeleton/fit/figure_report_internal.h"
#include "core/skeleton/fit/fit_report_internal.h"
#include "core/skeleton/fit/fit_residuals.h"
#include "core/skeleton/fit/fit_start_internal.h"
#include "core/skeleton/fit/outside_bones_internal.h"

namespace sinew {
namespace {

/// The fit as a computation: the unknowns are added stage by stage, so that a wrong start of one does not bend
/// another.
class SkeletonFitter {
 public:
  SkeletonFitter(const Skeleton& reference, std::span<const View> views, std::span<const ShapePrior> priors,
                 const FitOptions& options, const Job& job, SightingList sightings)
      : reference_{reference},
        views_{views},
        options_{options},
        job_{job},
        sightings_{std::move(sightings)},
        body_{reference, priors},
        z_{Eigen::VectorXd::Zero(body_.count())} {}

  SkeletonFit run() {
    SkeletonFit fit;
    fit.warnings = sightings_.warnings;
    start();
    const std::vector<int> observable = observableUnknowns();
    const auto up_to = [&](auto keep) {
      std::vector<int> some;
      std::ranges::copy_if(observable, std::back_inserter(some), keep);
      return some;
    };
    const int posture = body_.postureBegin();
    const std::vector<int> root =
        up_to([&](int i) { return i == BodyParameters::kSize || (i >= posture && i < posture + 6); });
    const std::vector<int> pose = up_to([&](int i) { return i == BodyParameters::kSize || i >= posture; });
    approach(root, 0, 0.1);
    approach(pose, 0.1, 0.3);
    constexpr int kRounds = 6;
    for (int round = 0; round < kRounds && lossWidth_sigma() > options_.robust_loss_sigma; ++round)
      approach(observable, 0.3 + 0.4 * round / kRounds, 0.3 + 0.4 * (round + 1) / kRounds);
    // Where the residuals stay larger than stated (a wrong geometry, say), so does the loss; describe() warns of it.
    const SolveSettings final_settings{lossWidth_sigma(), options_.max_iterations, 1e-8};
    fit.outcome = solve(observable, final_settings, 0.7, 0.9);
    if (fit.outcome == Outcome::Converged && leaveOutGrossErrors())
      fit.outcome = solve(observable, final_settings, 0.9, 1);
    if (fit.outcome != Outcome::Converged) return fit;
    describe(fit);
    return fit;
  }

 private:
  void start() {
    const auto at_mean = posePoints(reference_, body_, sightings_.landmarks, z_, {}).p_W;
    std::vector<StartSighting> seen;
    for (const auto& s : sightings_.items) seen.push_back({s.point, s.view, s.uv_px, s.sigma_px});
    const Similarity similarity = startOfFit(at_mean, views_, seen, 1);
    // The root turns about the pelvis' origin, which stands at the root joint's place in the zero posture.
    const Eigen::Vector3d pelvis = reference_.joints.front().X_PJ.translation();
    body_.setRootStart(similarity.scale * similarity.R * pelvis + similarity.t - pelvis,
                       vectorFromRotation(similarity.R));
    const int i = BodyParameters::kSize;
    z_[i] = std::clamp(body_.zOfSize(body_.meanSize() * similarity.scale), body_.lower(i), body_.upper(i));
  }

  /// Entries of z that move any seen landmark, judged at a body away from the symmetric mean.
  std::vector<int> observableUnknowns() const {
    Eigen::VectorXd z = z_;
    for (int i = 0; i < z.size(); ++i) z[i] += 0.1 * std::sin(1.0 + i);
    std::vector<int> all(body_.count());
    for (int i = 0; i < body_.count(); ++i) all[i] = i;
    const PosedPoints points = posePoints(reference_, body_, sightings_.landmarks, z, all);
    std::vector<int> observable;
    constexpr double kMoves_m = 1e-9;  // per SD of the population
    for (const int i : all)
      if (std::ranges::any_of(points.dp_dz, [&](const auto& dp) { return dp.col(i).norm() > kMoves_m; }))
        observable.push_back(i);
    return observable;
  }

  struct SolveSettings {
    double loss_sigma;
    int max_iterations;
    double function_tolerance;
  };

  /// On the way to the solution the loss is as wide as the residuals are: a start some hundred sigma away would crawl
  /// along the linear branch of the stated one.
  double lossWidth_sigma() const { return std::max(options_.robust_loss_sigma, 2 * median(distances_sigma())); }

  /// Distance of every sighting from the body z, in sigmas; infinite behind the source.
  std::vector<double> distances_sigma() const {
    const auto points = posePoints(reference_, body_, sightings_.landmarks, z_, {}).p_W;
    std::vector<double> sigmas;
    for (const auto& s : sightings_.items) {
      const auto uv = project(views_[s.view], points[s.point]);
      sigmas.push_back(uv ? (s.uv_px - *uv).norm() / s.sigma_px : std::numeric_limits<double>::infinity());
    }
    return sigmas;
  }

  static double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<long>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
  }

  /// Marks what lies far outside the rest; the worst first and not more than a few, so that a wrong geometry, which
  /// puts everything far outside, is not explained away. Returns whether there is any.
  bool leaveOutGrossErrors() {
    constexpr double kMedianOfInliers = 1.1774;  // of a Rayleigh distribution
    constexpr double kLargestShare = 0.15;
    const std::vector<double> sigmas = distances_sigma();
    const double limit = options_.gross_error_sigma * std::max(1.0, median(sigmas) / kMedianOfInliers);
    std::vector<std::size_t> gross =
        slipsAmong(reference_, sightings_, sigmas, limit, contradictions(limit / options_.gross_error_sigma));
    const double most = kLargestShare * static_cast<double>(sigmas.size());
    if (static_cast<double>(gross.size()) > most) gross.resize(static_cast<std::size_t>(most));
    for (const std::size_t i : gross) sightings_.items[i].left_out = true;
    return !gross.empty();
  }

  /// All picks of every landmark that are used; empty for those of which none is.
  std::vector<LandmarkPicks> picksByLandmark() const {
    std::vector<LandmarkPicks> picks(sightings_.landmarks.size());
    for (std::size_t l = 0; l < picks.size(); ++l) {
      std::vector<const UsableSighting*> seen;
      for (const auto& s : sightings_.items)
        if (s.point == static_cast<int>(l) && !s.left_out) seen.push_back(&s);
      picks[l].landmark = sightings_.landmarks[l];
      picks[l].uv_px.resize(2 * static_cast<Eigen::Index>(seen.size()));
      picks[l].covariance_px2 = Eigen::MatrixXd::Zero(picks[l].uv_px.size(), picks[l].uv_px.size());
      for (std::size_t k = 0; k < seen.size(); ++k) {
        picks[l].views.push_back(seen[k]->view);
        picks[l].uv_px.segment<2>(2 * static_cast<Eigen::Index>(k)) = seen[k]->uv_px;
        picks[l].covariance_px2.diagonal().segment<2>(2 * static_cast<Eigen::Index>(k)).setConstant(
            seen[k]->sigma_px * seen[k]->sigma_px);
      }
    }
    return picks;
  }

  ImageOfPoint image() const {
    return [views = views_](int, int view, const Eigen::Vector3d& p, Eigen::Vector2d& uv_px,
                            Eigen::Matrix<double, 2, 3>& by_point) {
      using Jet = ceres::Jet<double, 3>;
      Eigen::Matrix<Jet, 2, 1> uv;
      if (!project<Jet>(views[view], Vector3<Jet>{Jet(p.x(), 0), Jet(p.y(), 1), Jet(p.z(), 2)}, uv)) return false;
      for (int i = 0; i < 2; ++i) uv_px[i] = uv[i].a, by_point.row(i) = uv[i].v;
      return true;
    };
  }

  /// Landmarks whose own picks do not meet, by more than `scale` times what is stated lets expect.
  std::vector<bool> contradictions(double scale) const {
    constexpr double kContradicts_sigma = 5;
    const auto points = posePoints(reference_, body_, sightings_.landmarks, z_, {}).p_W;
    std::vector<bool> contradicts;
    const auto picks = picksByLandmark();
    for (std::size_t l = 0; l < picks.size(); ++l) {
      const auto point = pickedPoint(picks[l], image(), points[l]);
      contradicts.push_back(point && point->disagreement > kContradicts_sigma * scale);
    }
    return contradicts;
  }

  /// Some steps towards the solution; how they end does not matter yet.
  void approach(const std::vector<int>& active, double from, double to) {
    solve(active, {lossWidth_sigma(), 10, 1e-3}, from, to);
  }

  Outcome solve(const std::vector<int>& active, const SolveSettings& settings, double from, double to) {
    if (job_.cancelled()) return Outcome::Cancelled;
    if (!std::ranges::all_of(distances_sigma(), [](double d) { return std::isfinite(d); }))
      return Outcome::NotConverged;  // part of the body stands behind a source
    SharedBody shared{reference_, body_, sightings_.landmarks, active, z_};
    ceres::Problem::Options problem_options;
    problem_options.evaluation_callback = &shared;
    ceres::Problem problem{problem_options};
    for (const auto& s : sightings_.items) {
      if (s.left_out) continue;
      problem.AddResidualBlock(new SightingCost{shared, s.point, views_[s.view], s.uv_px, s.sigma_px},
                               new ceres::HuberLoss{settings.loss_sigma}, shared.x());
    }
    std::vector<double> weights;
    for (const int i : active) weights.push_back(body_.isDeformable(i) ? 0 : body_.priorWeight(i));
    problem.AddResidualBlock(new PriorCost{weights}, nullptr, shared.x());
    addDeformityPriors(problem, active, shared.x());
    for (int i = 0; i < shared.activeCount(); ++i) {
      problem.SetParameterLowerBound(shared.x(), i, body_.lower(active[i]));
      problem.SetParameterUpperBound(shared.x(), i, body_.upper(active[i]));
    }
    CeresJob monitor{job_, "fitting shape and posture", settings.max_iterations, from, to};
    auto solver = solverOptions(monitor, settings.max_iterations, ceres::DENSE_NORMAL_CHOLESKY);
    solver.function_tolerance = settings.function_tolerance;
    solver.initial_trust_region_radius = 1e8;  // the priors regularize: full Gauss-Newton steps from the start
    solver.parameter_tolerance = 1e-9;
    solver.gradient_tolerance = 1e-9;
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem, &summary);
    z_ = shared.z();
    const Outcome outcome = outcomeOf(summary);
    if (outcome == Outcome::Converged) rememberCovariance(problem, active);
    return outcome;
  }

  /// Deformities are rare and large: their priors are Gaussian for most bodies and no more than linear beyond, so that
  /// a bone bent by many standard deviations is not pulled back by as many.
  void addDeformityPriors(ceres::Problem& problem, const std::vector<int>& active, double* x) const {
    constexpr double kUsual_sd = 1.5;
    for (std::size_t k = 0; k < active.size(); ++k)
      if (body_.isDeformable(active[k]))
        problem.AddResidualBlock(
            new OnePriorCost{static_cast<int>(k), static_cast<int>(active.size()), body_.priorWeight(active[k])},
            new ceres::HuberLoss{kUsual_sd}, x);
  }

  /// Inverse of the normal matrix at the solution, priors included: the Laplace approximation of the posterior.
  /// What no sighting moves keeps the prior's variance.
  void rememberCovariance(ceres::Problem& problem, const std::vector<int>& active) {
    ceres::CRSMatrix jacobian;
    problem.Evaluate(ceres::Problem::EvaluateOptions{}, nullptr, nullptr, nullptr, &jacobian);
    const Eigen::Index n = static_cast<Eigen::Index>(active.size());
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> J{
        jacobian.values.data(), jacobian.num_rows, n};
    const Eigen::MatrixXd inverse = (J.transpose() * J).llt().solve(Eigen::MatrixXd::Identity(n, n));
    covariance_ = Eigen::MatrixXd::Zero(body_.count(), body_.count());
    for (int i = 0; i < body_.count(); ++i) covariance_(i, i) = 1 / std::pow(body_.priorWeight(i), 2);
    for (Eigen::Index r = 0; r < n; ++r)
      for (Eigen::Index c = 0; c < n; ++c) covariance_(active[r], active[c]) = inverse(r, c);
  }

  void describe(SkeletonFit& fit) const {
    std::vector<double> shape, q;
    body_.expand<double>({z_.data(), static_cast<std::size_t>(z_.size())}, shape, q);
    fit.shape = shapeFromVector(shape);
    fit.posture = Eigen::Map<Eigen::VectorXd>(q.data(), static_cast<Eigen::Index>(q.size()));
    const auto points = posePoints(reference_, body_, sightings_.landmarks, z_, {}).p_W;
    describeResiduals(sightings_, views_, points, fit);
    fit.undetermined = namesOf(reference_, body_, covariance_, options_.undetermined_ratio);
    FitEvidence evidence{reference_,         body_,   z_, covariance_, picksByLandmark(), image(),
                         options_.offered_landmarks, static_cast<int>(views_.size())};
    std::erase_if(evidence.picks, [](const LandmarkPicks& picks) { return picks.views.empty(); });
    judgeFigures(evidence, fit);
    warnOfBounds(body_, z_, fit.warnings);
  }

  const Skeleton& reference_;
  std::span<const View> views_;
  const FitOptions& options_;
  const Job& job_;
  SightingList sightings_;
  BodyParameters body_;
  Eigen::VectorXd z_;
  Eigen::MatrixXd covariance_;
};

}  // namespace

SkeletonFit fitSkeleton(const Skeleton& reference, std::span<const View> views,
                        std::span<const LandmarkObservation> observations, std::span<const ShapePrior> priors,
                        const FitOptions& options, const Job& job) {
  SightingList sightings = usableSightings(reference, views, observations);
  return SkeletonFitter{reference, views, priors, options, job, std::move(sightings)}.run();
}

}  // namespace sinew
