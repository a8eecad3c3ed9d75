#include "core/skeleton/fit/side_exchange.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/skeleton/fit/exchange_words_internal.h"
#include "core/skeleton/shape/bone_field.h"

namespace sinew {
namespace {

constexpr double kMost = 25;                  // what one pick can cost: gross errors of another kind do not decide
constexpr double kMedianOfRayleigh = 1.1774;  // of a residual's length, in sigmas
constexpr double kFacingAway = 40;            // cost of a body with its back to where the rig says forward
constexpr double kBad = 4;                    // sigmas: 1 of 3000 picks by chance
constexpr double kWorthAMove = 9;             // least fall of the cost
constexpr int kRounds = 4;

struct Residual {
  Eigen::Vector2d px;
  double sigmas = 0;
};

/// One naming of the picks and how well a body fits it.
struct Trial {
  std::vector<bool> swapped;  ///< by pair
  SkeletonFit fit;
  std::vector<std::optional<Residual>> of;  ///< by pick; nothing for those that the fit does not use
  double away = 0;                          ///< kFacingAway, or 0
};

class ExchangeSearch {
 public:
  ExchangeSearch(const Skeleton& reference, std::span<const View> views, std::span<const LandmarkObservation> picks,
                 std::span<const ShapePrior> priors, const ExchangeOptions& options, const Job& job)
      : reference_{reference},
        views_{exactViews(views)},
        picks_{picks},
        priors_{priors},
        options_{options},
        job_{job} {
    collectPairs();
  }

  ExchangeFinding run() {
    ExchangeFinding finding;
    job_.report(0.5, "looking for exchanged sides");
    const std::vector<bool> none(pairs_.size());
    const Trial as_named = fitted(none);
    if (pairs_.empty() || job_.cancelled()) return finding;
    std::vector<Trial> ends;
    for (const auto& start : starts()) {
      ends.push_back(improved(start == none ? as_named : fitted(start)));
      if (job_.cancelled()) return finding;
    }
    const auto ofLeastCost = [&](double scale) {
      return *std::ranges::min_element(ends, {}, [&](const Trial& t) { return costOf(t, scale); });
    };
    Trial best = ofLeastCost(scaleOf(*std::ranges::min_element(ends, {}, &ExchangeSearch::scaleOf)));
    for (int round = 0; round < kRounds && !isClean(best) && !job_.cancelled(); ++round) {
      Trial other = improved(bestMove(best));
      if (round == 0) {  // what the starts exchanged on their way may be wrong itself
        Trial fresh = improved(bestMove(as_named));
        if (costOf(fresh, scaleOf(best)) < costOf(other, scaleOf(best))) other = std::move(fresh);
      }
      if (costOf(other, scaleOf(best)) > costOf(best, scaleOf(best)) - kWorthAMove) break;
      best = std::move(other);
    }
    const double scale = scaleOf(best);
    finding.evidence = costOf(as_named, scale) - costOf(best, scale);
    if (best.swapped != none) name(best, scale, finding);
    return finding;
  }

 private:
  /// Every landmark with a right and a left that is picked in a view.
  void collectPairs() {
    std::map<std::pair<int, std::string>, NamedPair> found;
    for (int i = 0; i < int(picks_.size()); ++i) {
      const std::string base{withoutSide(picks_[std::size_t(i)].landmark)};
      if (base == picks_[std::size_t(i)].landmark) continue;
      const auto landmark = std::ranges::find(reference_.landmarks, picks_[std::size_t(i)].landmark, &Landmark::name);
      if (landmark == reference_.landmarks.end() || landmark->segment >= reference_.movingSegmentCount()) continue;
      NamedPair& pair = found[{picks_[std::size_t(i)].view, base}];
      pair.view = picks_[std::size_t(i)].view;
      pair.landmark = base;
      pair.bone = withoutSide(reference_.segments[std::size_t(landmark->segment)].name);
      (sideSign(picks_[std::size_t(i)].landmark) > 0 ? pair.right : pair.left) = i;
    }
    for (auto& [key, pair] : found) pairs_.push_back(std::move(pair));
  }

  /// Namings to begin with: as they are, one view exchanged, all views.
  std::vector<std::vector<bool>> starts() const {
    std::vector<std::vector<bool>> list{std::vector<bool>(pairs_.size())};
    std::set<int> seen;
    for (const auto& pair : pairs_) seen.insert(pair.view);
    for (const int view : seen) {
      std::vector<bool> swapped;
      for (const auto& pair : pairs_) swapped.push_back(pair.view == view);
      list.push_back(swapped);
    }
    if (seen.size() > 1) list.emplace_back(pairs_.size(), true);
    return list;
  }

  Trial fitted(const std::vector<bool>& swapped) const {
    std::vector<LandmarkObservation> named(picks_.begin(), picks_.end());
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      for (const int i : {pairs_[p].right, pairs_[p].left})
        if (swapped[p] && i >= 0) named[std::size_t(i)].landmark = withOtherSide(named[std::size_t(i)].landmark);
    Trial trial{swapped, fitSkeleton(reference_, views_, named, priors_, {}, {{}, job_.stop}), {}, 0};
    std::map<std::pair<int, std::string>, Residual> residuals;
    for (const auto& r : trial.fit.residuals) residuals[{r.view, r.landmark}] = {r.residual_px, r.sigmas};
    for (const auto& pick : named) {
      const auto found = residuals.find({pick.view, pick.landmark});
      trial.of.push_back(found == residuals.end() ? std::nullopt : std::optional{found->second});
    }
    if (options_.anterior_W && trial.fit.outcome == Outcome::Converged) {
      const auto X_WB = segmentPoses(deformedSkeleton(reference_, trial.fit.shape), trial.fit.posture);
      if (X_WB.front().linear().col(0).dot(*options_.anterior_W) < 0) trial.away = kFacingAway;
    }
    return trial;
  }

  /// Picking error as the residuals show it, in stated ones; not less than one.
  static double scaleOf(const Trial& trial) {
    std::vector<double> sigmas;
    for (const auto& r : trial.of)
      if (r) sigmas.push_back(r->sigmas);
    if (sigmas.empty()) return std::numeric_limits<double>::infinity();
    std::ranges::nth_element(sigmas, sigmas.begin() + std::ptrdiff_t(sigmas.size() / 2));
    return std::max(1.0, sigmas[sigmas.size() / 2] / kMedianOfRayleigh);
  }

  static double priceOf(double sigmas, double scale) { return std::min(sigmas * sigmas / (scale * scale), kMost); }

  double costOf(const Trial& trial, double scale) const {
    if (trial.fit.outcome != Outcome::Converged) return kMost * double(picks_.size()) + kFacingAway;
    double sum = trial.away;
    for (const auto& r : trial.of)
      if (r) sum += priceOf(r->sigmas, scale);
    return sum;
  }

  /// Fall of the cost if the names of a pair changed places where the body of the trial stands; 0 if unknown.
  double gainOf(const Trial& trial, std::size_t p, double scale) const {
    const NamedPair& pair = pairs_[p];
    if (pair.right < 0 || pair.left < 0) return 0;
    const auto &a = picks_[std::size_t(pair.right)], &b = picks_[std::size_t(pair.left)];
    const auto &ra = trial.of[std::size_t(pair.right)], &rb = trial.of[std::size_t(pair.left)];
    if (!ra || !rb) return 0;
    const Eigen::Vector2d at_a = a.uv_px - ra->px, at_b = b.uv_px - rb->px;
    const double now = priceOf(ra->sigmas, scale) + priceOf(rb->sigmas, scale);
    const double then =
        priceOf((a.uv_px - at_b).norm() / a.sigma_px, scale) + priceOf((b.uv_px - at_a).norm() / b.sigma_px, scale);
    return now - then;
  }

  /// What pick and definition of a landmark let expect of its residual.
  static double expected_px(const std::optional<Residual>& residual, const LandmarkObservation& pick) {
    return residual->sigmas > 0 ? residual->px.norm() / residual->sigmas : pick.sigma_px;
  }

  /// Exchanges bones and pairs where that fits better, and fits again, until nothing changes.
  Trial improved(Trial trial) const {
    for (int round = 0; round < kRounds && trial.fit.outcome == Outcome::Converged; ++round) {
      const double scale = scaleOf(trial);
      std::vector<bool> next = trial.swapped;
      for (const auto& group : groups()) {
        double together = 0;
        for (const std::size_t p : group) together += gainOf(trial, p, scale);
        const bool whole = group.size() > 1 && together > options_.least_evidence;
        for (const std::size_t p : group) {
          const double gain = gainOf(trial, p, scale);
          if (whole ? gain > -options_.least_pair_evidence : gain > options_.least_pair_evidence) next[p] = !next[p];
        }
      }
      if (next == trial.swapped || job_.cancelled()) break;
      Trial other = fitted(next);
      if (costOf(other, scale) >= costOf(trial, scale)) break;
      trial = std::move(other);
    }
    return trial;
  }

  /// Of the namings that exchange a bone whose picks still disagree, in one view or in all, or exchange none of it,
  /// the one that fits best: a robust fit bends towards a bone that is wrong in every view, so that pair by pair
  /// nothing is gained.
  Trial bestMove(const Trial& from) const {
    const double scale = scaleOf(from);
    std::set<std::string> doubtful;
    for (const auto& pair : pairs_)
      for (const int i : {pair.right, pair.left})
        if (i >= 0 && isBad(from, std::size_t(i), scale)) doubtful.insert(pair.bone);
    constexpr int kAllViews = -1;
    Trial best = from;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& bone : doubtful)
      for (int view = kAllViews; view < int(views_.size()); ++view)
        for (const bool exchanged : {false, true}) {
          std::vector<bool> next = from.swapped;
          for (std::size_t p = 0; p < pairs_.size(); ++p)
            if (pairs_[p].bone == bone && (view == kAllViews || pairs_[p].view == view)) next[p] = exchanged;
          if (next == from.swapped || job_.cancelled()) continue;
          Trial trial = fitted(next);
          if (const double cost = costOf(trial, scale); cost < least) least = cost, best = std::move(trial);
        }
    return best;
  }

  static bool isBad(const Trial& trial, std::size_t pick, double scale) {
    return trial.of[pick] && trial.of[pick]->sigmas > kBad * scale;
  }

  /// At most one pick lies where chance does not take it.
  static bool isClean(const Trial& trial) {
    int bad = 0;
    for (std::size_t i = 0; i < trial.of.size(); ++i) bad += isBad(trial, i, scaleOf(trial));
    return trial.fit.outcome == Outcome::Converged && bad <= 1;
  }

  /// Pairs of one bone in one view.
  std::vector<std::vector<std::size_t>> groups() const {
    std::map<std::pair<int, std::string>, std::vector<std::size_t>> of_bone;
    for (std::size_t p = 0; p < pairs_.size(); ++p) of_bone[{pairs_[p].view, pairs_[p].bone}].push_back(p);
    std::vector<std::vector<std::size_t>> list;
    for (auto& [key, group] : of_bone) list.push_back(std::move(group));
    return list;
  }

  /// Says what the best naming exchanges. Pairs that lie together belong to either naming and follow their bone.
  void name(const Trial& best, double scale, ExchangeFinding& finding) const {
    std::vector<PairVerdict> verdicts;
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      const bool sure = gainOf(best, p, scale) < -options_.least_pair_evidence;
      verdicts.push_back(!sure             ? PairVerdict::Either
                         : best.swapped[p] ? PairVerdict::Exchanged
                                           : PairVerdict::AsNamed);
    }
    const ExchangeWords words = wordsFor(pairs_, verdicts, best.swapped, int(views_.size()));
    const bool whole = std::ranges::any_of(words.exchanges, &SideExchange::whole);
    const double least = whole ? options_.least_evidence : options_.least_pair_evidence;
    if (finding.evidence < least) return;
    finding.exchanges = words.exchanges;
    finding.what = words.what;
  }

  const Skeleton& reference_;
  std::vector<FitView> views_;
  std::span<const LandmarkObservation> picks_;
  std::span<const ShapePrior> priors_;
  const ExchangeOptions& options_;
  const Job& job_;
  std::vector<NamedPair> pairs_;
};

}  // namespace

std::string withOtherSide(std::string_view name) {
  std::string other{name};
  if (name.ends_with("_r")) other.back() = 'l';
  if (name.ends_with("_l")) other.back() = 'r';
  return other;
}

bool isExchanged(std::span<const SideExchange> exchanges, std::string_view name, int view) {
  const std::string_view base = withoutSide(name);
  return base != name && std::ranges::any_of(exchanges, [&](const SideExchange& e) {
           return e.view == view && std::ranges::find(e.landmarks, base) != e.landmarks.end();
         });
}

ExchangeFinding findExchangedSides(const Skeleton& reference, std::span<const View> views,
                                   std::span<const LandmarkObservation> observations,
                                   std::span<const ShapePrior> priors, const ExchangeOptions& options,
                                   const Job& job) {
  return ExchangeSearch{reference, views, observations, priors, options, job}.run();
}

}  // namespace sinew
