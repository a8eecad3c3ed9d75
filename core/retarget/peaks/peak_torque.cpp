#include "core/retarget/peaks/peak_torque.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "core/retarget/peaks/peak_minimize_internal.h"
#include "core/retarget/peaks/peak_reach.h"
#include "core/retarget/peaks/peak_result_internal.h"
#include "core/retarget/peaks/pursued_peaks_internal.h"

namespace sinew {
namespace {

/// The search for ratios.
class PeakSearch {
 public:
  PeakSearch(MotionTorques& torques, const std::vector<JointMotion>& motions, const std::vector<double>& wanted_theta,
             const Musculature& musculature, const PeakTorqueOptions& options)
      : torques_{torques},
        motions_{motions},
        musculature_{musculature},
        options_{options},
        original_{torques.original()},
        state_{original_},
        best_{original_},
        peaks_{motions, wanted_theta, original_.torque_Nm},
        best_rank_{peaks_.rank(best_.torque_Nm)} {
    for (PursuedPeak& p : peaks_.all()) p.target.setTolerance(kFirstTolerance_deg);
  }

  const Eigen::VectorXd& bestRatios() const { return best_.ratio; }
  std::vector<double> bestThetas() const {
    std::vector<double> thetas;
    for (const auto torque_Nm : best_.torque_Nm.colwise()) thetas.push_back(peakTheta(torque_Nm));
    return thetas;
  }
  int iterations() const { return iterations_; }

  /// A body whose angles are right already - the reference itself - needs nothing.
  bool isRight() const { return peaks_.areRight(original_.torque_Nm); }

  /// As many motions as possible within the target. After each round, those that are still missed count for more:
  /// what cannot be had together is then missed by few instead of by all.
  void bringWithin(const Job& job) {
    constexpr int kPatience = 3;
    for (int without_gain = 0; without_gain < kPatience && goesOn(job); ++without_gain) {
      minimizeViolations(options_.most_iterations, job);
      const bool has_lost = peaks_.rank(state_.torque_Nm).within < 0;
      if (keepIfBetter()) without_gain = 0;
      const bool goes_on = insist();
      // A motion that has left may not find its way back: it can have two humps.
      if (has_lost) state_ = best_;
      if (!goes_on) break;
    }
  }

  /// One motion after the other that is still missed though it could be reached, beside all that are within.
  void bringOneByOne(const Job& job) {
    for (bool gained = true; gained && goesOn(job);) {
      gained = false;
      for (PursuedPeak& wanted : peaks_.all())
        if (!wanted.is_out_of_reach && !wanted.isWithin(best_.torque_Nm))
          gained = bringAsWell(wanted, best_, job) ||
                   (!wanted.is_out_of_reach && bringAsWell(wanted, original_, job)) || gained;
    }
  }

  /// All angles as near as possible, from the best ratios so far; the number of motions within the target stays.
  void bringNear(const Job& job) {
    constexpr int kMost = 12;
    constexpr double kHold = 1000;  // of the conditions of a motion that is within, beside angles
    constexpr double kDearer = 10;  // it is not worth as large changes as coming within
    state_ = best_;
    for (PursuedPeak& p : peaks_.all()) {
      p.target.setTolerance(kLastTolerance_deg);
      p.weight = kHold;
      p.is_wanted = false;
    }
    minimize({[&](const auto& torque_Nm) { return peaks_.deviations(torque_Nm, best_.torque_Nm); },
              kDearer * options_.ratio_price, options_.largest_change,
              [&](const auto& torque_Nm) { return !peaks_.holdFaster(torque_Nm, best_.torque_Nm); }},
             kMost, job);
    keepIfBetter();
  }

  /// Both sides with the ratios of the better one, unless that leaves fewer motions within the target: roundings may
  /// have led them to two places.
  void makeSidesAlike() {
    std::optional<std::pair<PeakRank, MotionTorques::State>> better;
    for (const bool from_second : {false, true}) {
      Eigen::VectorXd ratio = best_.ratio;
      for (std::size_t u = 0; u < options_.mirror_of.size(); ++u) {
        const auto [first, second] = std::minmax({static_cast<int>(u), options_.mirror_of[u]});
        if (first >= 0) ratio[Eigen::Index(u)] = best_.ratio[from_second ? second : first];
      }
      MotionTorques::State state = best_;
      torques_.move(state, ratio);
      const PeakRank reached = peaks_.rank(state.torque_Nm);
      if (!better || better->first < reached) better.emplace(reached, std::move(state));
    }
    if (better->first.within >= best_rank_.within) std::tie(best_rank_, best_) = std::move(*better);
  }

 private:
  static constexpr double kFirstTolerance_deg = 1.5, kLastTolerance_deg = 2.7, kHeldTolerance_deg = 2.9;

  bool goesOn(const Job& job) const { return iterations_ < options_.most_iterations && !job.cancelled(); }

  bool keepIfBetter() {
    const PeakRank reached = peaks_.rank(state_.torque_Nm);
    if (!(best_rank_ < reached)) return false;
    best_rank_ = reached;
    best_ = state_;
    return true;
  }

  /// Makes missed motions count for more. False if none is missed that could be reached.
  bool insist() {
    constexpr double kMore = 3, kMoreIfLost = 10;
    bool missed = false;
    for (PursuedPeak& p : peaks_.all()) {
      if (p.is_out_of_reach || p.isWithin(state_.torque_Nm)) continue;
      if (!std::exchange(p.was_missed, true)) {
        p.target.setTolerance(kLastTolerance_deg);
        p.is_out_of_reach = !p.was_within && isOutOfReach(p.target);
        if (p.is_out_of_reach) p.weight = 0;
      }
      if (p.is_out_of_reach) continue;
      p.weight *= p.was_within ? kMoreIfLost : kMore;
      missed = true;
    }
    return missed;
  }

  /// One motion more than at the best ratios, with its mirror image where the sides are alike, so that they stay so;
  /// those that are neither within nor wanted do not count. True if it came. One that never was there, whatever
  /// became of the others, is given up.
  bool bringAsWell(PursuedPeak& wanted, const MotionTorques::State& from, const Job& job) {
    constexpr int kRounds = 4, kMost = 12;
    constexpr double kWeight = 10;  // against the price of ratios
    state_ = from;
    for (PursuedPeak& p : peaks_.all()) {
      const bool is_within = p.isWithin(best_.torque_Nm);
      p.is_wanted = !is_within && (&p == &wanted || isMirrorOf(p, wanted));
      p.target.setTolerance(is_within ? kHeldTolerance_deg : kLastTolerance_deg);
      p.weight = is_within || p.is_wanted ? kWeight : 0;
    }
    bool came = false;
    for (int round = 0; round < kRounds && goesOn(job); ++round) {
      minimizeViolations(kMost, job);
      if (keepIfBetter()) return true;
      came = came || wanted.isWithin(state_.torque_Nm);
      if (!peaks_.holdFaster(state_.torque_Nm, best_.torque_Nm)) break;
    }
    for (PursuedPeak& p : peaks_.all()) p.is_out_of_reach = p.is_out_of_reach || (p.is_wanted && !came);
    return false;
  }

  bool isMirrorOf(const PursuedPeak& peak, const PursuedPeak& other) const {
    return !options_.mirror_motion_of.empty() &&
           options_.mirror_motion_of[peak.target.motion()] == static_cast<int>(other.target.motion());
  }

  bool isOutOfReach(const PeakTarget& target) const {
    constexpr int kRatios = 31, kRounds = 500;  // decides what is worth insisting on, not what is reported
    const std::size_t m = target.motion();
    return peakReach(torques_.geometry(), m, motions_[m], target.wantedTheta(), musculature_,
                     {kPeakTorqueTarget_deg, options_.largest_change, kRatios, kRounds}) == PeakReach::Out;
  }

  void minimizeViolations(int most_iterations, const Job& job) {
    minimize({[&](const auto& torque_Nm) { return peaks_.violations(torque_Nm); },
              options_.ratio_price,
              options_.largest_change,
              {}},
             most_iterations, job);
  }
  void minimize(const PeakObjective& objective, int most_iterations, const Job& job) {
    sinew::minimize(torques_, state_, objective, [&, last = iterations_ + most_iterations] {
      if (!goesOn(job) || iterations_ == last) return false;
      job.report(double(iterations_++) / options_.most_iterations, "peak torque");
      return true;
    });
  }

  MotionTorques& torques_;
  const std::vector<JointMotion>& motions_;
  const Musculature& musculature_;
  const PeakTorqueOptions& options_;
  const MotionTorques::State original_;
  MotionTorques::State state_, best_;
  PursuedPeaks peaks_;
  PeakRank best_rank_;
  int iterations_ = 0;
};

}  // namespace

PeakTorqueResult optimizePeakTorque(const TorqueGeometry& geometry, const std::vector<JointMotion>& motions,
                                    const std::vector<double>& wanted_theta, Musculature& musculature,
                                    const PeakTorqueOptions& options, const Job& job) {
  MotionTorques torques{geometry, musculature};
  PeakSearch search{torques, motions, wanted_theta, musculature, options};
  const std::vector<double> before = search.bestThetas();
  if (!search.isRight()) {
    search.bringWithin(job);
    search.bringOneByOne(job);
    search.bringNear(job);
    if (!options.mirror_of.empty()) search.makeSidesAlike();
  }
  if (job.cancelled()) return {.outcome = Outcome::Cancelled};
  setRatios(musculature, search.bestRatios());
  return peakTorqueResult(motions, wanted_theta, before, search.bestThetas(), search.bestRatios(),
                          search.iterations());
}

}  // namespace sinew
