#include "core/skeleton/fit/fit_skeleton.h"

#include <ceres/crs_matrix.h>
#include <ceres/loss_function.h>
#include <ceres/problem.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/ceres_job_internal.h"
#include "core/skeleton/fit/figure_report_internal.h"
#include "core/skeleton/fit/fit_movement_internal.h"
#include "core/skeleton/fit/fit_noise_internal.h"
#include "core/skeleton/fit/fit_report_internal.h"
#include "core/skeleton/fit/fit_residuals.h"
#include "core/skeleton/fit/fit_sightings_internal.h"
#include "core/skeleton/fit/fit_start_internal.h"
#include "core/skeleton/fit/outside_bones_internal.h"

namespace sinew {
namespace {

/// The loss of a landmark with several sightings starts to be linear where as few of them lie as of one sighting
/// beyond `loss_sigma`: quantiles of chi-squared over two degrees of freedom (Wilson & Hilferty 1931).
double lossOfBlock(double loss_sigma, int sightings) {
  const auto quantile = [](double d) {
    constexpr double kNormalQuantile = 2.287;  // of the 1.1 % beyond 3 sigma in two dimensions
    const double v = 2 / (9 * d);
    return d * std::pow(1 - v + kNormalQuantile * std::sqrt(v), 3);
  };
  return loss_sigma * std::sqrt(quantile(2.0 * sightings) / quantile(2));
}

std::vector<View> viewsOf(std::span<const FitView> views) {
  std::vector<View> list;
  for (const FitView& view : views) list.push_back(view.view);
  return list;
}

/// The fit as a computation: the unknowns are added stage by stage, so that a wrong start of one does not bend
/// another.
class SkeletonFitter {
 public:
  SkeletonFitter(const Skeleton& reference, std::span<const FitView> views, std::span<const ShapePrior> priors,
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
    setNuisances(options_.movement, observable);
    y_ = Eigen::VectorXd::Zero(nuisances_->count());
    blocks_ = blocksOf(sightings_);

    const auto up_to = [&](auto keep) {
      std::vector<int> some;
      std::ranges::copy_if(observable, std::back_inserter(some), keep);
      return some;
    };
    const int posture = body_.postureBegin();
    const std::vector<int> root =
        up_to([&](int i) { return i == BodyParameters::kSize || (i >= posture && i < posture + 6); });
    const std::vector<int> pose = up_to([&](int i) { return i == BodyParameters::kSize || i >= posture; });
    approach({root, false}, 0, 0.1);
    approach({pose, false}, 0.1, 0.3);
    constexpr int kRounds = 6;
    for (int round = 0; round < kRounds && lossWidth_sigma() > options_.robust_loss_sigma; ++round)
      approach({observable, true}, 0.3 + 0.3 * round / kRounds, 0.3 + 0.3 * (round + 1) / kRounds);
    fit.outcome = settle(observable, 0.6, 0.8);
    if (fit.outcome == Outcome::Converged) bend_ = likeliestBend(reference_, *nuisances_, y_, nuisance_covariance_);
    if (bend_) {
      letJointsMove(observable);
      fit.outcome = settle(observable, 0.8, 1);
    }
    if (fit.outcome != Outcome::Converged) return fit;
    describe(fit);
    return fit;
  }

 private:
  void setNuisances(const MovementPrior& prior, const std::vector<int>& observable) {
    nuisances_.emplace(reference_, body_, views_, prior, observable);
    model_.emplace(FitModel{reference_, body_, views_, *nuisances_, sightings_.landmarks, pivot_W_});
  }

  /// With everything free: the solution, without gross errors, with the scale of the picks that it shows. Where the
  /// residuals stay larger than stated (a wrong geometry, say), so does the loss; describe() warns of it.
  Outcome settle(const std::vector<int>& observable, double from, double to) {
    const Unknowns all{observable, true};
    const auto part = [&](double share) { return from + (to - from) * share; };
    const auto solveAll = [&](double begin, double end) {
      return solve(all, {lossWidth_sigma(), options_.max_iterations, 1e-8}, part(begin), part(end));
    };
    Outcome outcome = solveAll(0, 0.5);
    if (outcome == Outcome::Converged && leaveOutGrossErrors()) outcome = solveAll(0.5, 0.6);
    constexpr int kScaleRounds = 2;
    for (int round = 0; round < kScaleRounds && outcome == Outcome::Converged; ++round) {
      scale_ = estimateScale(all);
      outcome = solveAll(0.6 + 0.2 * round, 0.8 + 0.2 * round);
    }
    return outcome;
  }

  /// The prior of joints at rest gives way to one of joints that moved; what it made look like an error is taken
  /// back.
  void letJointsMove(const std::vector<int>& observable) {
    MovementPrior prior = options_.movement;
    const double ratio = prior.joint_rad / prior.bent_joint_rad;
    prior.joint_rad = prior.bent_joint_rad;
    setNuisances(prior, observable);
    for (int e = 1; e < nuisances_->exposureCount(); ++e)
      for (const auto& change : nuisances_->jointChanges(e)) y_[change.y] *= ratio;
    scale_ = {};
    for (auto& item : sightings_.items) item.left_out = false;
    blocks_ = blocksOf(sightings_);
  }

  struct Unknowns {
    std::vector<int> active;  ///< of z
    bool nuisances = false;
  };

  void start() {
    const auto at_mean = posePoints(reference_, body_, sightings_.landmarks, z_, {}).p_W;
    std::vector<StartSighting> seen;
    for (const auto& s : sightings_.items) seen.push_back({s.point, s.view, s.uv_px, s.sigma_px});
    const std::vector<View> views = viewsOf(views_);
    const Similarity similarity = startOfFit(at_mean, views, seen, 1);
    // The root turns about the pelvis' origin, which stands at the root joint's place in the zero posture.
    const Eigen::Vector3d pelvis = reference_.joints.front().X_PJ.translation();
    body_.setRootStart(similarity.scale * similarity.R * pelvis + similarity.t - pelvis,
                       vectorFromRotation(similarity.R));
    const int i = BodyParameters::kSize;
    z_[i] = std::clamp(body_.zOfSize(body_.meanSize() * similarity.scale), body_.lower(i), body_.upper(i));
    pivot_W_.setZero();
    for (const auto& p : at_mean)
      pivot_W_ += (similarity.scale * similarity.R * p + similarity.t) / static_cast<double>(at_mean.size());
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

  /// The sightings beside the present body.
  SightingsBesideBody beside() const { return {*model_, sightings_, options_.definition_errors, z_, y_}; }
  std::vector<double> distances_sigma() const { return beside().distances_sigma(scale_); }

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
        slipsAmong(reference_, sightings_, sigmas, limit,
                   beside().contradictions(blocks_, scale_, limit / options_.gross_error_sigma));
    const double most = kLargestShare * static_cast<double>(sigmas.size());
    if (static_cast<double>(gross.size()) > most) gross.resize(static_cast<std::size_t>(most));
    for (const std::size_t i : gross) sightings_.items[i].left_out = true;
    blocks_ = blocksOf(sightings_);
    return !gross.empty();
  }

  /// Some steps towards the solution; how they end does not matter yet.
  void approach(const Unknowns& unknowns, double from, double to) {
    solve(unknowns, {lossWidth_sigma(), 10, 1e-3}, from, to);
  }

  std::vector<SeenPoint> seenPoints(const SightingBlock& block) const {
    std::vector<SeenPoint> seen;
    for (const std::size_t i : block.items) seen.push_back({sightings_.items[i].view, sightings_.items[i].uv_px});
    return seen;
  }

  /// Deformities are rare and large: their priors are Gaussian for most bodies and no more than linear beyond, so
  /// that a bone bent by many standard deviations is not pulled back by as many.
  static constexpr double kUsualDeformity_sd = 1.5;
  void addDeformityPriors(ceres::Problem& problem, const Unknowns& unknowns, SharedBody& shared) const {
    for (std::size_t k = 0; k < unknowns.active.size(); ++k)
      if (const int i = unknowns.active[k]; body_.isDeformable(i))
        problem.AddResidualBlock(new OnePriorCost{static_cast<int>(k), shared.size(), body_.priorWeight(i)},
                                 new ceres::HuberLoss{kUsualDeformity_sd}, shared.x());
  }

  /// Weights of the priors of the solver's unknowns that have no loss of their own.
  std::vector<double> gaussianPriorWeights(const Unknowns& unknowns) const {
    std::vector<double> weights = priorWeights(unknowns);
    for (std::size_t k = 0; k < unknowns.active.size(); ++k)
      if (body_.isDeformable(unknowns.active[k])) weights[k] = 0;
    return weights;
  }

  /// Weights of the priors of the solver's unknowns at the present solution.
  std::vector<double> priorWeights(const Unknowns& unknowns) const {
    std::vector<double> weights;
    for (const int i : unknowns.active) {
      const double sigmas = std::abs(z_[i]) * body_.priorWeight(i);
      const double share = body_.isDeformable(i) ? std::min(1.0, kUsualDeformity_sd / sigmas) : 1;
      weights.push_back(std::sqrt(share) * body_.priorWeight(i));
    }
    if (unknowns.nuisances) weights.insert(weights.end(), static_cast<std::size_t>(y_.size()), 1.0);
    return weights;
  }

  Outcome solve(const Unknowns& unknowns, const SolveSettings& settings, double from, double to) {
    if (job_.cancelled()) return Outcome::Cancelled;
    if (!std::ranges::all_of(distances_sigma(), [](double d) { return std::isfinite(d); }))
      return Outcome::NotConverged;  // part of the body stands behind a source
    SharedBody shared{*model_, unknowns.active, z_, y_, unknowns.nuisances};
    ceres::Problem::Options problem_options;
    problem_options.evaluation_callback = &shared;
    ceres::Problem problem{problem_options};
    const auto noise = beside().noise(blocks_);
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const double loss = lossOfBlock(settings.loss_sigma, static_cast<int>(blocks_[b].items.size()));
      problem.AddResidualBlock(
          new LandmarkCost{shared, blocks_[b].point, seenPoints(blocks_[b]), noise[b].at(scale_)},
          new ceres::HuberLoss{loss}, shared.x());
    }
    problem.AddResidualBlock(new PriorCost{gaussianPriorWeights(unknowns)}, nullptr, shared.x());
    addDeformityPriors(problem, unknowns, shared);
    for (int i = 0; i < shared.activeCount(); ++i) {
      problem.SetParameterLowerBound(shared.x(), i, body_.lower(unknowns.active[i]));
      problem.SetParameterUpperBound(shared.x(), i, body_.upper(unknowns.active[i]));
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
    y_ = shared.y();
    const Outcome outcome = outcomeOf(summary);
    if (outcome == Outcome::Converged) rememberCovariance(problem, unknowns);
    return outcome;
  }

  /// Scale of the reader's errors at the solution. Landmarks beyond the loss count with its weight.
  PickScale estimateScale(const Unknowns& unknowns) const {
    SharedBody shared{*model_, unknowns.active, z_, y_, unknowns.nuisances};
    shared.PrepareForEvaluation(true, true);
    auto noise = beside().noise(blocks_);
    const double loss_sigma = lossWidth_sigma();
    std::vector<LinearizedLandmark> landmarks;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const Eigen::Index rows = 2 * static_cast<Eigen::Index>(blocks_[b].items.size());
      const LandmarkCost cost{shared, blocks_[b].point, seenPoints(blocks_[b]),
                              Eigen::MatrixXd::Identity(rows, rows)};
      LinearizedLandmark landmark{Eigen::VectorXd(rows), {}, std::move(noise[b])};
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian(rows, shared.size());
      double* jacobians[] = {jacobian.data()};
      const double* x[] = {shared.x()};
      if (!cost.Evaluate(x, landmark.residual_px.data(), jacobians)) continue;
      const double distance =
          std::sqrt(landmark.residual_px.dot(landmark.noise.at(scale_).llt().solve(landmark.residual_px)));
      const double weight = std::min(1.0, lossOfBlock(loss_sigma, static_cast<int>(rows / 2)) / distance);
      landmark.residual_px *= std::sqrt(weight);
      landmark.jacobian_px = std::sqrt(weight) * jacobian;
      landmarks.push_back(std::move(landmark));
    }
    const std::vector<double> weights = priorWeights(unknowns);
    const Eigen::Index n = shared.size();
    return estimatePickScale(landmarks, Eigen::Map<const Eigen::VectorXd>{weights.data(), n},
                             Eigen::Map<const Eigen::VectorXd>{shared.x(), n}, !options_.definition_errors.empty());
  }

  /// Inverse of the normal matrix at the solution, priors included: the Laplace approximation of the posterior.
  /// What no sighting moves keeps the prior's variance.
  void rememberCovariance(ceres::Problem& problem, const Unknowns& unknowns) {
    ceres::CRSMatrix jacobian;
    problem.Evaluate(ceres::Problem::EvaluateOptions{}, nullptr, nullptr, nullptr, &jacobian);
    const Eigen::Index active = static_cast<Eigen::Index>(unknowns.active.size()),
                       n = active + (unknowns.nuisances ? y_.size() : 0);
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> J{
        jacobian.values.data(), jacobian.num_rows, n};
    const Eigen::MatrixXd inverse = (J.transpose() * J).llt().solve(Eigen::MatrixXd::Identity(n, n));
    covariance_ = Eigen::MatrixXd::Zero(body_.count(), body_.count());
    for (int i = 0; i < body_.count(); ++i) covariance_(i, i) = 1 / std::pow(body_.priorWeight(i), 2);
    covariance_(unknowns.active, unknowns.active) = inverse.topLeftCorner(active, active);
    nuisance_covariance_ = inverse.bottomRightCorner(n - active, n - active);
  }

  void describe(SkeletonFit& fit) const {
    std::vector<double> shape, q;
    body_.expand<double>({z_.data(), static_cast<std::size_t>(z_.size())}, shape, q);
    fit.shape = shapeFromVector(shape);
    fit.posture = Eigen::Map<Eigen::VectorXd>(q.data(), static_cast<Eigen::Index>(q.size()));
    fit.pick_scale = scale_;
    const SightingsBesideBody seen = beside();
    fit.residuals = seen.residuals(PickScale{});
    describeResiduals(sightings_, fit);
    fit.movements = describeMovements(reference_, views_, *nuisances_, y_, nuisance_covariance_, bend_);
    warnOfMovement(fit.movements, fit.warnings);
    fit.undetermined = namesOf(reference_, body_, covariance_, options_.undetermined_ratio);
    std::vector<int> landmarks = sightings_.landmarks;
    for (const auto& name : options_.offered_landmarks) landmarks.push_back(reference_.landmarkIndex(name));
    std::erase_if(landmarks, [&](int l) {
      return reference_.landmarks[l].segment >= reference_.movingSegmentCount();  // glides with a joint
    });
    judgeFigures({reference_, body_, z_, covariance_, seen.picks(blocks_, scale_), seen.image(landmarks),
                  nuisance_covariance_, options_.offered_landmarks, static_cast<int>(views_.size())},
                 fit);
    warnOfBounds(body_, z_, fit.warnings);
  }

  const Skeleton& reference_;
  std::span<const FitView> views_;
  const FitOptions& options_;
  const Job& job_;
  SightingList sightings_;
  BodyParameters body_;
  std::optional<Nuisances> nuisances_;
  std::optional<FitModel> model_;
  std::vector<SightingBlock> blocks_;
  Eigen::Vector3d pivot_W_ = Eigen::Vector3d::Zero();
  Eigen::VectorXd z_, y_;
  PickScale scale_;
  std::optional<LegBend> bend_;
  Eigen::MatrixXd covariance_, nuisance_covariance_;
};

}  // namespace

SkeletonFit fitSkeleton(const Skeleton& reference, std::span<const FitView> views,
                        std::span<const LandmarkObservation> observations, std::span<const ShapePrior> priors,
                        const FitOptions& options, const Job& job) {
  SightingList sightings = usableSightings(reference, views.size(), observations);
  return SkeletonFitter{reference, views, priors, options, job, std::move(sightings)}.run();
}

}  // namespace sinew
