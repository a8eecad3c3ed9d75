#include "tests/benchmarks/accuracy_study.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <ctime>
#include <stdexcept>
#include <thread>

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

/// Processor time of this thread: what a fit costs, however busy the machine is.
double threadTime_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

Trial runTrial(const Skeleton& skeleton, const std::vector<ShapePrior>& priors,
               const std::vector<std::string>& landmarks, const std::vector<View>& views, double noise_mm, int seed) {
  std::mt19937_64 random{static_cast<std::uint64_t>(seed)};
  const ShapeParameters shape = drawShape(priors, random);
  const Posture posture = drawStandingPosture(skeleton, random);
  const auto observations = test::observe(skeleton, shape, posture, views, landmarks, noise_mm, random);
  const double begin_ms = threadTime_ms();
  Trial trial{boneFigures(skeleton, shape, posture), fitSkeleton(skeleton, views, observations, priors), 0};
  trial.ms = threadTime_ms() - begin_ms;
  return trial;
}

void addError(AccuracyRow& row, double truth, const BoneFigure& estimate) {
  if (!estimate.determined) {
    ++row.undetermined;
    return;
  }
  ++row.determined;
  const double error = estimate.value - truth;
  row.bias += error;
  row.sd += error * error;
  row.max = std::max(row.max, std::abs(error));
  row.half_width95 += 0.5 * (estimate.upper95 - estimate.lower95);
  row.coverage += estimate.lower95 <= truth && truth <= estimate.upper95;
}

void finish(AccuracyRow& row) {
  const double n = row.determined;
  if (n < 2) return;
  row.bias /= n;
  row.sd = std::sqrt((row.sd - n * row.bias * row.bias) / (n - 1));
  row.half_width95 /= n;
  row.coverage /= n;
}

}  // namespace

const AccuracyRow& AccuracyStudy::row(const std::string& quantity) const {
  const auto at = std::ranges::find(rows, quantity, &AccuracyRow::quantity);
  if (at == rows.end()) throw std::out_of_range{quantity};
  return *at;
}

AccuracyStudy studyAccuracy(const std::filesystem::path& resource_dir, const std::vector<View>& views,
                            double noise_mm, int seeds) {
  const Skeleton skeleton = loadReferenceSkeleton(resource_dir);
  const auto priors = loadShapePriors(resource_dir);
  std::vector<std::string> landmarks;
  for (const auto& landmark : loadLandmarkProtocol(resource_dir)) landmarks.push_back(landmark.name);

  std::vector<Trial> trials(static_cast<std::size_t>(seeds));
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int i; (i = next++) < seeds;)
      trials[static_cast<std::size_t>(i)] = runTrial(skeleton, priors, landmarks, views, noise_mm, i + 1);
  };
  {
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i) threads.emplace_back(work);
  }

  AccuracyStudy study;
  study.bodies = seeds;
  std::vector<double> times;
  for (const auto& trial : trials) {
    times.push_back(trial.ms);
    if (trial.fit.outcome != Outcome::Converged) {
      ++study.not_converged;
      continue;
    }
    for (std::size_t f = 0; f < trial.truth.size(); ++f) {
      const BoneFigure& truth = trial.truth[f];
      auto at = std::ranges::find(study.rows, truth.quantity, &AccuracyRow::quantity);
      if (at == study.rows.end()) {
        study.rows.push_back({.quantity = truth.quantity, .unit = truth.unit});
        at = std::prev(study.rows.end());
      }
      addError(*at, truth.value, trial.fit.figures[f]);
    }
  }
  for (auto& row : study.rows) finish(row);
  std::ranges::nth_element(times, times.begin() + static_cast<long>(times.size() / 2));
  study.median_ms = times[times.size() / 2];
  return study;
}

}  // namespace sinew
