#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/rom/threshold_fit_internal.h"

namespace sinew {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Thresholds as numbers of accepted entries, and how many columns forbid each sample.
class Descent {
 public:
  explicit Descent(const ThresholdProblem& problem) : p_{problem}, violations_(problem.wanted.size(), 0) {
    accepted_.assign(p_.columns.size(), 0);
    for (std::size_t c = 0; c < p_.columns.size(); ++c) {
      accepted_[c] = p_.columns[c]->value.size();
    }
  }

  void set(std::size_t column, double threshold) {
    const auto& value = p_.columns[column]->value;
    move(column, std::size_t(std::ranges::upper_bound(value, threshold) - value.begin()));
  }
  void move(std::size_t column, std::size_t accepted) {
    const auto& sample = p_.columns[column]->sample;
    for (; accepted_[column] < accepted; ++accepted_[column]) --violations_[sample[accepted_[column]]];
    for (; accepted_[column] > accepted; --accepted_[column]) ++violations_[sample[accepted_[column] - 1]];
  }

  double error() const {
    double sum = 0;
    for (std::size_t s = 0; s < violations_.size(); ++s)
      if ((violations_[s] == 0) != bool(p_.wanted[s])) sum += p_.weight[s];
    return sum;
  }

  /// Best number of accepted entries of one column, and what moving there gains; the present one if none is better.
  std::pair<std::size_t, double> best(std::size_t column) const {
    const auto& [value, sample] = *p_.columns[column];
    double gain = 0, most = 0, present = 0;
    std::size_t where = 0;
    for (std::size_t i = 0; i < value.size(); ++i) {
      const std::uint32_t s = sample[i];
      if (violations_[s] == (i >= accepted_[column])) gain += p_.wanted[s] ? p_.weight[s] : -p_.weight[s];
      if (i + 1 < value.size() && value[i + 1] == value[i]) continue;
      if (gain > most) most = gain, where = i + 1;
      if (i + 1 == accepted_[column]) present = gain;
    }
    return most > present ? std::pair{where, most - present} : std::pair{accepted_[column], 0.0};
  }

  /// To where no single column can gain anything. @returns the error.
  double descend(double error, const Job& job, std::ptrdiff_t held_open = -1) {
    for (bool moved = true; moved && !job.cancelled();) {
      moved = false;
      for (std::size_t c = 0; c < p_.columns.size(); ++c) {
        if (std::ptrdiff_t(c) == held_open) continue;
        const auto [accepted, gain] = best(c);
        if (gain <= 0) continue;
        move(c, accepted);
        error -= gain;
        moved = true;
      }
    }
    return error;
  }

  /// Among the best values of one column the one that is `reference`, or nearest to it and then nearest to
  /// `preferred`; well inside the gap between two samples.
  double bestValue(std::size_t column, double reference, double preferred) const {
    const auto& [value, sample] = *p_.columns[column];
    double gain = 0, most = -kInfinity;
    double chosen = reference, distance = kInfinity;
    const auto consider = [&](double low, double high) {
      if (gain < most) return;
      if (gain > most) most = gain, distance = kInfinity;
      const double apart = reference < low ? low - reference : reference >= high ? reference - high : 0;
      if (apart >= distance) return;
      distance = apart;
      chosen = apart == 0 ? reference : inside(low, high, preferred);
    };
    if (!value.empty()) consider(-kInfinity, value.front());
    for (std::size_t i = 0; i < value.size(); ++i) {
      const std::uint32_t s = sample[i];
      if (violations_[s] == (i >= accepted_[column])) gain += p_.wanted[s] ? p_.weight[s] : -p_.weight[s];
      if (i + 1 < value.size() && value[i + 1] == value[i]) continue;
      consider(value[i], i + 1 < value.size() ? value[i + 1] : kInfinity);
    }
    return chosen;
  }

  std::vector<std::size_t> accepted() const { return accepted_; }
  void restore(const std::vector<std::size_t>& accepted) {
    for (std::size_t c = 0; c < accepted.size(); ++c) move(c, accepted[c]);
  }

 private:
  static double inside(double low, double high, double preferred) {
    constexpr double kMargin_m = 1e-5;  // twice what maps decide in double (GridView::kClose_m)
    const double margin = std::min(kMargin_m, (high - low) / 2);
    return std::clamp(preferred, low + margin, high - margin);
  }

  const ThresholdProblem& p_;
  std::vector<std::uint16_t> violations_;
  std::vector<std::size_t> accepted_;
};

/// Largest wanted value of every column: no threshold above it is better than itself.
std::vector<double> outerBounds(const ThresholdProblem& problem) {
  std::vector<double> bounds;
  for (const ThresholdColumn* c : problem.columns) {
    auto i = c->sample.size();
    while (i > 0 && !problem.wanted[c->sample[i - 1]]) --i;
    bounds.push_back(i > 0 ? c->value[i - 1] : kInfinity);
  }
  return bounds;
}

/// The problem without the samples that its outer bounds forbid: no best fit lets them pass.
struct CompactProblem {
  std::vector<ThresholdColumn> columns;
  ThresholdProblem problem;
};

CompactProblem compact(const ThresholdProblem& problem, const std::vector<double>& bounds) {
  std::vector<std::uint8_t> forbidden(problem.wanted.size(), 0);
  for (std::size_t c = 0; c < problem.columns.size(); ++c) {
    const auto& [value, sample] = *problem.columns[c];
    for (auto i = value.size(); i > 0 && value[i - 1] > bounds[c]; --i) forbidden[sample[i - 1]] = 1;
  }
  CompactProblem small;
  std::vector<std::uint32_t> number(problem.wanted.size());
  for (std::size_t s = 0; s < number.size(); ++s) {
    if (forbidden[s] || problem.weight[s] == 0) continue;
    number[s] = static_cast<std::uint32_t>(small.problem.wanted.size());
    small.problem.wanted.push_back(problem.wanted[s]);
    small.problem.weight.push_back(problem.weight[s]);
  }
  small.columns.resize(problem.columns.size());
  for (std::size_t c = 0; c < problem.columns.size(); ++c) {
    const auto& [value, sample] = *problem.columns[c];
    for (std::size_t i = 0; i < value.size(); ++i)
      if (const auto s = sample[i]; !forbidden[s] && problem.weight[s] > 0) {
        small.columns[c].value.push_back(value[i]);
        small.columns[c].sample.push_back(number[s]);
      }
  }
  for (const auto& column : small.columns) small.problem.columns.push_back(&column);
  return small;
}

}  // namespace

double thresholdError(const ThresholdProblem& problem, const std::vector<double>& threshold) {
  Descent d{problem};
  for (std::size_t c = 0; c < threshold.size(); ++c) d.set(c, threshold[c]);
  return d.error();
}

ThresholdFit fitThresholds(const ThresholdProblem& problem, const std::vector<std::vector<double>>& starts,
                           const std::vector<double>& reference, const std::vector<double>& preferred,
                           const Job& job) {
  require(!starts.empty(), "fitThresholds: a start");
  const std::vector<double> bounds = outerBounds(problem);
  const CompactProblem small = compact(problem, bounds);
  const std::size_t columns = problem.columns.size();
  Descent descent{small.problem};
  std::vector<std::size_t> best;
  double least = kInfinity;
  const auto keep = [&](double error) {
    if (error >= least) return false;
    least = error;
    best = descent.accepted();
    return true;
  };
  for (const auto& start : starts) {
    for (std::size_t c = 0; c < columns; ++c) descent.set(c, std::min(start[c], bounds[c]));
    keep(descent.descend(descent.error(), job));
  }
  // Opened one at a time: a column may have taken what another one does better.
  for (bool improved = true; improved && !job.cancelled();) {
    improved = false;
    for (std::size_t c = 0; c < columns && !job.cancelled(); ++c) {
      descent.restore(best);
      descent.move(c, small.columns[c].value.size());
      descent.descend(0, job, std::ptrdiff_t(c));
      descent.descend(0, job);
      improved = keep(descent.error()) || improved;
    }
  }
  ThresholdFit fit;
  if (job.cancelled()) {
    fit.outcome = Outcome::Cancelled;
    return fit;
  }
  // In the whole problem: thresholds as lengths, as near to the reference as the error allows.
  Descent whole{problem};
  for (std::size_t c = 0; c < columns; ++c) {
    const auto& value = small.columns[c].value;
    fit.threshold.push_back(best[c] == value.size() ? bounds[c] : best[c] > 0 ? value[best[c] - 1] : -kInfinity);
    whole.set(c, fit.threshold.back());
  }
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t c = 0; c < columns; ++c) {
      fit.threshold[c] = whole.bestValue(c, reference[c], preferred[c]);
      whole.set(c, fit.threshold[c]);
    }
  fit.error = whole.error();
  fit.outcome = Outcome::Converged;
  return fit;
}

}  // namespace sinew
