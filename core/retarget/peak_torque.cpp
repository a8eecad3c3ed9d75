#include "core/retarget/peak_torque.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "core/retarget/peak_minimize_internal.h"
#include "core/retarget/peak_reach.h"
#include "core/retarget/peak_result_internal.h"
#include "core/retarget/peak_target_internal.h"

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
        state_{torques.original()} {
    for (std::size_t m = 0; m < motions.size(); ++m) {
      const MotionTorques::Samples torque_Nm = state_.torque_Nm.col(Eigen::Index(m));
      if (std::isnan(wanted_theta[m]) || !(torque_Nm.maxCoeff() > 0)) continue;
      Pursued& p = pursued_.emplace_back(Pursued{{m, motions[m], wanted_theta[m], torque_Nm}});
      p.was_within = p.target.isWithin(torque_Nm);
      p.target.setTolerance(kFirstTolerance_deg);
    }
    best_ = state_;
    best_rank_ = rank(state_);
  }

  const Eigen::VectorXd& bestRatios() const { return best_.ratio; }
  std::vector<double> bestThetas() const {
    std::vector<double> thetas;
    for (const auto torque_Nm : best_.torque_Nm.colwise()) thetas.push_back(peakTheta(torque_Nm));
    return thetas;
  }
  int iterations() const { return iterations_; }

  /// A body whose angles are right already - the reference itself - needs nothing.
  bool isRight() const {
    constexpr double kRight_deg = 0.01;
    return std::ranges::all_of(
        pursued_, [&](const Pursued& p) { return p.target.off_deg(of(p, state_.torque_Nm)) <= kRight_deg; });
  }

  /// As many motions as possible within the target. After each round, those that are still missed count for more:
  /// what cannot be had together is then missed by few instead of by all.
  void bringWithin(const Job& job) {
    constexpr int kPatience = 3;
    for (int without_gain = 0; without_gain < kPatience && goesOn(job); ++without_gain) {
      minimize(Part::Conditions, options_.most_iterations, job);
      const bool has_lost = rank(state_).within < 0;
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
      for (const Pursued& wanted : pursued_)
        if (!wanted.is_out_of_reach && !wanted.target.isWithin(of(wanted, best_.torque_Nm)))
          gained = bringAsWell(wanted, job) || gained;
    }
  }

  /// All angles as near as possible, from the best ratios so far; the number of motions within the target stays.
  void bringNear(const Job& job) {
    constexpr int kMost = 12;
    constexpr double kHold = 1000;  // of the conditions of a motion that is within, beside angles
    state_ = best_;
    for (Pursued& p : pursued_) {
      p.target.setTolerance(kLastTolerance_deg);
      p.weight = kHold;
    }
    minimize(Part::Angles, kMost, job);
    keepIfBetter();
  }

  /// Both sides with the ratios of the better one, unless that leaves fewer motions within the target: the search
  /// goes through them one after the other and may end in two places.
  void makeSidesAlike() {
    std::optional<std::pair<Rank, MotionTorques::State>> better;
    for (const bool from_second : {false, true}) {
      Eigen::VectorXd ratio = best_.ratio;
      for (std::size_t u = 0; u < options_.mirror_of.size(); ++u) {
        const auto [first, second] = std::minmax({static_cast<int>(u), options_.mirror_of[u]});
        if (first >= 0) ratio[Eigen::Index(u)] = best_.ratio[from_second ? second : first];
      }
      MotionTorques::State state = best_;
      torques_.move(state, ratio);
      const Rank reached = rank(state);
      if (!better || better->first < reached) better.emplace(reached, std::move(state));
    }
    if (better->first.within >= best_rank_.within) std::tie(best_rank_, best_) = std::move(*better);
  }

 private:
  static constexpr double kFirstTolerance_deg = 1.5, kLastTolerance_deg = 2.7, kHeldTolerance_deg = 2.9;

  struct Pursued {
    PeakTarget target;
    double weight = 1;                                 ///< 0: does not count
    bool was_within = false;                           ///< before anything was changed
    bool was_missed = false, is_out_of_reach = false;  ///< after a round
  };
  struct Rank {
    int within = 0;     ///< motions; negative: motions that were within and have left
    double energy = 0;  ///< the paper's: sum of (theta - wanted)^2
    bool operator<(const Rank& other) const {
      return within != other.within ? within < other.within : energy > other.energy;
    }
  };
  enum class Part { Conditions, Angles };

  bool goesOn(const Job& job) const { return iterations_ < options_.most_iterations && !job.cancelled(); }

  Rank rank(const MotionTorques::State& state) const {
    Rank rank;
    int lost = 0;
    for (const Pursued& p : pursued_) {
      const auto torque_Nm = of(p, state.torque_Nm);
      const bool is_within = p.target.isWithin(torque_Nm);
      rank.within += is_within;
      lost += p.was_within && !is_within;
      rank.energy += std::pow(p.target.off(torque_Nm), 2);
    }
    if (lost > 0) rank.within = -lost;
    return rank;
  }

  bool keepIfBetter() {
    const Rank reached = rank(state_);
    if (!(best_rank_ < reached)) return false;
    best_rank_ = reached;
    best_ = state_;
    return true;
  }

  /// Makes missed motions count for more. False if none is missed that could be reached.
  bool insist() {
    constexpr double kMore = 3, kMoreIfLost = 10;
    bool missed = false;
    for (Pursued& p : pursued_) {
      if (p.is_out_of_reach || p.target.isWithin(of(p, state_.torque_Nm))) continue;
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

  /// From the best ratios, one motion more; those that are neither within nor this one do not count. True if it came.
  bool bringAsWell(const Pursued& wanted, const Job& job) {
    constexpr int kRounds = 4, kMost = 12;
    constexpr double kWeight = 10;
    state_ = best_;
    for (Pursued& p : pursued_) {
      const bool is_within = p.target.isWithin(of(p, best_.torque_Nm));
      p.target.setTolerance(is_within ? kHeldTolerance_deg : kLastTolerance_deg);
      p.weight = is_within || &p == &wanted ? kWeight : 0;
    }
    for (int round = 0; round < kRounds && goesOn(job); ++round) {
      minimize(Part::Conditions, kMost, job);
      if (keepIfBetter()) return true;
      if (!holdFaster(state_.torque_Nm, &wanted)) return false;
    }
    return false;
  }

  /// Makes motions count for more that are within the target at the best ratios, or wanted, but not within at these
  /// torques. False if there are none.
  bool holdFaster(const MotionTorques::Table& torque_Nm, const Pursued* wanted = nullptr) {
    constexpr double kMore = 10;
    bool has_lost = false;
    for (Pursued& p : pursued_) {
      const bool is_held = &p == wanted || p.target.isWithin(of(p, best_.torque_Nm));
      if (!is_held || p.target.isWithin(of(p, torque_Nm))) continue;
      p.weight *= kMore;
      has_lost = true;
    }
    return has_lost;
  }

  bool isOutOfReach(const PeakTarget& target) const {
    constexpr int kRatios = 31, kRounds = 500;  // decides what is worth insisting on, not what is reported
    const std::size_t m = target.motion();
    return peakReach(torques_.geometry(), m, motions_[m], target.wantedTheta(), musculature_,
                     {kPeakTorqueTarget_deg, options_.largest_change, kRatios, kRounds}) == PeakReach::Out;
  }

  static MotionTorques::Table::ConstColXpr of(const Pursued& p, const MotionTorques::Table& torque_Nm) {
    return torque_Nm.col(static_cast<Eigen::Index>(p.target.motion()));
  }

  std::vector<WeightedResiduals> residuals(Part part, const MotionTorques::Table& torque_Nm) const {
    std::vector<WeightedResiduals> list;
    for (const Pursued& p : pursued_) {
      if (p.weight == 0) continue;
      const bool holds = part == Part::Conditions || p.target.isWithin(of(p, best_.torque_Nm));
      WeightedResiduals left{p.target.motion(), p.weight,
                             holds ? p.target.violations(of(p, torque_Nm)) : TorqueResiduals{}};
      if (!left.residuals.empty()) list.push_back(std::move(left));
      if (part == Part::Angles) list.push_back({p.target.motion(), 1, p.target.deviation(of(p, torque_Nm))});
    }
    return list;
  }

  /// Where it is worth going near, it is not worth as large changes as for coming within.
  double price(Part part) const { return options_.ratio_price * (part == Part::Angles ? 10 : 1); }

  void minimize(Part part, int most_iterations, const Job& job) {
    PeakObjective objective{[&](const MotionTorques::Table& torque_Nm) { return residuals(part, torque_Nm); },
                            price(part),
                            options_.largest_change,
                            {}};
    if (part == Part::Angles)
      objective.allows = [&](const MotionTorques::Table& torque_Nm) { return !holdFaster(torque_Nm); };
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
  MotionTorques::State state_, best_;
  Rank best_rank_;
  std::vector<Pursued> pursued_;
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
