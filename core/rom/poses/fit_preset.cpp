#include "core/rom/poses/fit_preset.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/muscle/hill.h"
#include "core/muscle/muscle_path.h"
#include "core/rom/poses/range_postures.h"
#include "core/rom/tests/clinical_sweep.h"

namespace sinew {
namespace {

/// Paths of the right units. The pose set is its own mirror image: what holds for them holds for the left.
struct RightPaths {
  Musculature units;
  PathLimits of_poses;
  WorkingPaths working;
};

RightPaths rightPaths(const Skeleton& skeleton, const Musculature& published, const RomPreset& preset,
                      const ClinicalTests& tests, const PoseSampleOptions& poses) {
  const auto half = static_cast<std::ptrdiff_t>(published.units.size() / 2);
  RightPaths right{
      .units = {{published.units.begin(), published.units.begin() + half}}, .of_poses = {}, .working = {}};
  right.of_poses = longestPaths(skeleton, right.units, [&](const PoseVisitor& visit) {
    samplePoses(skeleton, preset, tests.tests, poses, visit);
  });
  const auto single_motions = singleMotions(skeleton, preset);
  right.working.shortest_m = longestPaths(skeleton, right.units, [&](const PoseVisitor& visit) {
                               for (const Posture& q : single_motions) visit(q);
                             }).shortest_m;
  return right;
}

std::vector<LengthEstimate> lengthsOfPoses(const Skeleton& skeleton, const Musculature& published,
                                           const RightPaths& right) {
  auto estimates =
      estimateLengths(skeleton, right.units, right.of_poses, restingPostures(skeleton), {}, right.working);
  const std::size_t half = estimates.size();
  for (std::size_t i = 0; i < half; ++i) {
    estimates.push_back(estimates[i]);
    estimates.back().unit = published.units[half + i].name;
  }
  return estimates;
}

/// Largest common share of F_max at which units that pull against the movement leave the moment at the threshold.
double allowedShare(const Model& model, const std::vector<std::pair<double, int>>& moments,
                    const ClinicalSweep& sweep, double s_deg, double threshold_Nm) {
  const auto capped_Nm = [&](double cap) {
    double sum = 0;
    for (const auto& [moment, u] : moments) {
      const MusculotendonUnit& unit = model.musculature.units[static_cast<std::size_t>(u)];
      const double share = equilibrium(unit, sweep.length_m(u, s_deg), 0).force_N / unit.max_isometric_force_N;
      sum += moment > 0 ? moment * std::min(1.0, cap / share) : moment;
    }
    return sum;
  };
  double low = 0, high = 10;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (capped_Nm(middle) > threshold_Nm ? high : low) = middle;
  }
  return low;
}

/// Fibre and tendon of a unit and of its mirror image times `factor`.
void lengthen(std::size_t unit, double factor, PresetFit& fit) {
  const std::size_t half = fit.lengths.size() / 2;
  for (const std::size_t i : {unit % half, unit % half + half}) {
    LengthEstimate& e = fit.lengths[i];
    e.scale *= factor;
    e.optimal_fiber_length_m *= factor;
    e.tendon_slack_length_m *= factor;
    e.relaxed = true;
    fit.model.musculature.units[i].optimal_fiber_length_m = e.optimal_fiber_length_m;
    fit.model.musculature.units[i].tendon_slack_length_m = e.tendon_slack_length_m;
  }
}

/// A test of the preset with its way, tabulated once: only lengths change from round to round.
struct Way {
  const ClinicalTest* test;
  ClinicalSweep sweep;
  double to_deg;  ///< place of the movement where the test reads its target
};

std::vector<Way> waysOf(const Model& model, const std::vector<RomTarget>& targets, const ClinicalTests& tests) {
  std::vector<Way> ways;
  for (const RomTarget& target : targets) {
    const ClinicalTest& test = tests.test(target.test);
    ClinicalSweep sweep{model, test, 'r', 1};
    if (!target.to_stops)
      require(test.reads.size() == 1 && test.moves.size() == 1, "a target angle is for a test of one coordinate");
    const double to_deg = target.to_stops ? sweep.end_deg()
                                          : (target.target_deg - test.read_offset_deg) / test.reads.begin()->second /
                                                test.moves.begin()->second;
    ways.push_back({&test, std::move(sweep), to_deg});
  }
  return ways;
}

/// Makes the way of one test up to its target free. Returns whether something had to be lengthened.
bool clearWay(const Way& way, double step_deg, PresetFit& fit) {
  const double direction = way.sweep.direction();
  bool changed = false;
  constexpr double kTolerance = 1e-4;  // of the threshold
  for (double s = way.test->from_deg;; s += direction * step_deg) {
    const bool last = (s - way.to_deg) * direction >= 0;
    if (last) s = way.to_deg - direction * 1e-6;  // where a stop has not yet halted it
    const auto moments = way.sweep.moments_Nm(s, fit.model.musculature.units);
    double sum_Nm = 0;
    for (const auto& [moment, unit] : moments) sum_Nm += moment;
    // On the way a little less: a moment that only touches the threshold there would already end the test.
    const double allowed_Nm = (last ? 1 : 0.98) * way.test->threshold_Nm;
    if (sum_Nm > allowed_Nm * (1 + kTolerance)) {
      const double share = allowedShare(fit.model, moments, way.sweep, s, allowed_Nm);
      for (const auto& [moment, u] : moments) {
        if (moment <= 0) continue;
        const auto i = static_cast<std::size_t>(u);
        const double f = relaxingFactor(fit.model.musculature.units[i], way.sweep.length_m(u, s), share);
        if (f > 1) lengthen(i, f, fit);
      }
      changed = true;
    }
    if (last) return changed;
  }
}

}  // namespace

PresetFit fitPreset(const Skeleton& skeleton, const Musculature& published, const RomPreset& preset,
                    const ClinicalTests& tests, const PresetFitOptions& options, const Job& job) {
  job.report(0, "longest paths of " + preset.name);
  RightPaths right = rightPaths(skeleton, published, preset, tests, options.poses);
  const auto targets = preset.targets();
  Model body{.skeleton = skeleton, .musculature = published};
  setStops(body.skeleton, preset);
  const std::vector<Way> ways = waysOf(body, targets, tests);
  PresetFit fit;
  // Twice: only after the tests is it known how much a fibre is lengthened, and by what it falls short of working.
  for (int pass = 0; pass < 2; ++pass) {
    fit = {.lengths = lengthsOfPoses(skeleton, published, right)};
    fit.model.skeleton = body.skeleton;
    fit.model.musculature = withLengths(published, fit.lengths);
    const std::vector<LengthEstimate> of_poses = fit.lengths;
    for (bool changed = true; changed && fit.rounds < options.most_rounds && !job.cancelled(); ++fit.rounds) {
      changed = false;
      job.report(0.5 * (1 + pass + double(fit.rounds) / options.most_rounds) / 1.5, "tests of " + preset.name);
      for (const Way& way : ways) changed = clearWay(way, options.step_deg, fit) || changed;
    }
    right.working.lengthened.resize(right.working.shortest_m.size());
    for (Eigen::Index i = 0; i < right.working.lengthened.size(); ++i)
      right.working.lengthened[i] = fit.lengths[std::size_t(i)].scale / of_poses[std::size_t(i)].scale;
  }
  for (const Way& way : ways) fit.readings.push_back(simulateTest(fit.model, *way.test, 'r', way.test->threshold_Nm));
  const auto standing = segmentPoses(skeleton, zeroPosture(skeleton));
  for (std::size_t i = 0; i < fit.lengths.size(); ++i) {
    const MusculotendonUnit& unit = fit.model.musculature.units[i];
    const auto fiber = [&](double path_m) { return equilibrium(unit, path_m, 0).normalized_fiber_length; };
    LengthEstimate& e = fit.lengths[i];
    e.resting_normalized_fiber = fiber(pathLength(unit, standing));
    e.shortest_normalized_fiber = fiber(e.shortest_path_m);
    e.longest_normalized_fiber = fiber(e.longest_path_m);
  }
  return fit;
}

}  // namespace sinew
