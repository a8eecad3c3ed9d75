#include "tests/benchmarks/deformity_study.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <ctime>
#include <random>
#include <thread>

#include "core/skeleton/fit/bone_figures_internal.h"
#include "core/skeleton/fit/landmark_protocol.h"
#include "core/skeleton/shape/population.h"
#include "tests/support/synthetic_views.h"

namespace sinew {
namespace {

struct Trial {
  std::vector<BoneFigure> truth;
  SkeletonFit fit;
  double ms = 0;
};

double threadTime_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

std::vector<BoneFigure> figuresOf(const Skeleton& body, const Posture& posture) {
  const auto X_WB = segmentPoses(body, posture);
  std::vector<Vector3<double>> points;
  for (const auto& name : figureLandmarkNames()) {
    const Landmark& landmark = body.landmark(name);
    points.push_back(X_WB[std::size_t(landmark.segment)] * landmark.p_BL);
  }
  const auto values = figureValues<double>(points);
  auto figures = figureList();
  for (std::size_t f = 0; f < figures.size(); ++f) figures[f].value = values[f];
  return figures;
}

int sideOfDraw(const Deformity& deformity, int draw) {
  return deformity.both_sides ? -1 : draw % 2;
}

Trial runTrial(const Skeleton& reference, const std::vector<ShapePrior>& priors,
               const std::vector<std::string>& landmarks, const std::vector<View>& views, const Deformity& deformity,
               double amount, double noise_mm, int draw) {
  std::mt19937_64 random{static_cast<std::uint64_t>(1000 + draw)};
  std::vector<ShapePrior> healthy;
  for (const auto& prior : priors)
    if (!prior.deformity) healthy.push_back(prior);
  Skeleton body = deformedSkeleton(reference, drawShape(healthy, random));
  const Posture posture = drawStandingPosture(reference, random);
  for (const int side : {0, 1})
    if (deformity.both_sides || side == sideOfDraw(deformity, draw)) deformity.apply(body, amount, side);
  const auto observations = test::observe(body, posture, views, landmarks, noise_mm, random);
  Trial trial{figuresOf(body, posture), {}, 0};
  const double begin_ms = threadTime_ms();
  trial.fit = fitSkeleton(reference, exactViews(views), observations, priors);
  trial.ms = threadTime_ms() - begin_ms;
  return trial;
}

void addError(DeformityRow& row, double truth, const BoneFigure& estimate) {
  if (!estimate.determined) {
    ++row.undetermined;
    return;
  }
  ++row.determined;
  row.triangulated += estimate.triangulated;
  const double error = estimate.value - truth;
  row.bias += error;
  row.sd += error * error;
  row.half_width95 += 0.5 * (estimate.upper95 - estimate.lower95);
  row.coverage += estimate.lower95 <= truth && truth <= estimate.upper95;
}

void finish(DeformityRow& row) {
  const double n = row.determined;
  if (n < 2) return;
  row.bias /= n;
  row.sd = std::sqrt(std::max(0.0, (row.sd - n * row.bias * row.bias) / (n - 1)));
  row.half_width95 /= n;
  row.coverage /= n;
}

}  // namespace

DeformityStudy studyDeformity(const std::filesystem::path& resource_dir, const std::vector<View>& views,
                              const Deformity& deformity, double amount, double noise_mm, int draws) {
  const Skeleton reference = loadReferenceSkeleton(resource_dir);
  const auto priors = loadShapePriors(resource_dir);
  std::vector<std::string> landmarks;
  for (const auto& landmark : loadLandmarkProtocol(resource_dir)) landmarks.push_back(landmark.name);
  std::vector<Trial> trials(static_cast<std::size_t>(draws));
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int i; (i = next++) < draws;)
      trials[std::size_t(i)] = runTrial(reference, priors, landmarks, views, deformity, amount, noise_mm, i);
  };
  {
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i) threads.emplace_back(work);
  }

  DeformityStudy study{deformity.name, amount, deformity.unit, draws, 0, 0, 0, 0, {}};
  std::vector<double> times;
  for (int i = 0; i < draws; ++i) {
    const Trial& trial = trials[std::size_t(i)];
    times.push_back(trial.ms);
    if (trial.fit.outcome != Outcome::Converged) {
      ++study.not_converged;
      continue;
    }
    study.outside += !trial.fit.outside.empty();
    for (const auto& warning : trial.fit.warnings) study.left_out += warning.message.ends_with("and was left out");
    const int side = sideOfDraw(deformity, i);
    for (std::size_t f = 0; f < trial.truth.size(); ++f) {
      const BoneFigure& truth = trial.truth[f];
      if (side >= 0 && truth.side == (side == 0 ? "l" : "r")) continue;  // the healthy leg
      auto at = std::ranges::find(study.rows, truth.quantity, &DeformityRow::quantity);
      if (at == study.rows.end()) {
        study.rows.push_back({.quantity = truth.quantity, .unit = truth.unit});
        at = std::prev(study.rows.end());
      }
      // A difference right minus left has the sign of the deformed side, so that errors of both add up.
      BoneFigure estimate = trial.fit.figures[f];
      const double sign = truth.quantity == "leg_length_difference" && side == 1 ? -1 : 1;
      addError(
          *at, sign * truth.value, sign > 0 ? estimate : [&] {
            estimate.value = -estimate.value;
            std::swap(estimate.lower95, estimate.upper95);
            estimate.lower95 = -estimate.lower95, estimate.upper95 = -estimate.upper95;
            return estimate;
          }());
    }
  }
  for (auto& row : study.rows) finish(row);
  std::ranges::nth_element(times, times.begin() + long(times.size() / 2));
  study.median_ms = times[times.size() / 2];
  return study;
}

}  // namespace sinew
