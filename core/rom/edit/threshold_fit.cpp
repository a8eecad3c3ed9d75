#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/rom/edit/threshold_fit_internal.h"

namespace sinew {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Weights are multiples of this: sums of integers are exact, whatever their order.
constexpr double kWeightUnit = 1.0 / 1024;

/// Thresholds as numbers of accepted entries, and how many columns forbid each sample.
class Descent {
 public:
  explicit Descent(const ThresholdProblem& problem) {
    for (std::size_t s = 0; s < problem.wanted.size(); ++s) {
      const int weight = static_cast<int>(std::lround(problem.weight[s] / kWeightUnit));
      samples_.push_back({problem.wanted[s] ? weight : -weight, 0});
    }
    for (const ThresholdColumn* column : problem.columns) addColumn(*column);
  }

  void set(std::size_t column, double threshold) {
    const auto& value = values_[column];
    move(column, std::size_t(std::ranges::upper_bound(value, threshold) - value.begin()));
  }
  void move(std::size_t column, std::size_t accepted) {
    const auto& entries = entries_[column];
    auto& present = accepted_[column];
    for (; present < accepted; ++present) --samples_[entries[present] >> 1].violations;
    for (; present > accepted; --present) ++samples_[entries[present - 1] >> 1].violations;
  }

  /// Weight of the wrong samples, in units.
  long error() const {
    long sum = 0;
    for (const Sample& s : samples_)
      if ((s.violations == 0) != (s.gain > 0)) sum += std::abs(s.gain);
    return sum;
  }

  /// To where no single column can gain anything: one after the other, from the first or from the last.
  void descendInOrder(bool backwards, const Job& job) {
    const std::size_t count = entries_.size();
    for (bool moved = true; moved && !job.cancelled();) {
      moved = false;
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t column = backwards ? count - 1 - i : i;
        const Move best = bestMove(column);
        if (best.gain > 0) move(column, best.accepted), moved = true;
      }
    }
  }

  /// The same, always the column that gains most.
  void descendSteepest(const Job& job) {
    while (!job.cancelled()) {
      Move most;
      std::size_t of = 0;
      for (std::size_t column = 0; column < entries_.size(); ++column)
        if (const Move best = bestMove(column); best.gain > most.gain) most = best, of = column;
      if (most.gain <= 0) return;
      move(of, most.accepted);
    }
  }

  /// Among the best values of one column the one that is `reference`, or nearest to it and then nearest to
  /// `preferred`; well inside the gap between two samples.
  double bestValue(std::size_t column, double reference, double preferred) const {
    const auto& value = values_[column];
    long most = std::numeric_limits<long>::min();
    double chosen = reference, distance = kInfinity;
    const auto consider = [&](std::size_t accepted, long gain) {
      if (gain < most) return;
      if (gain > most) most = gain, distance = kInfinity;
      const double low = accepted > 0 ? value[accepted - 1] : -kInfinity;
      const double high = accepted < value.size() ? value[accepted] : kInfinity;
      const double apart = reference < low ? low - reference : reference >= high ? reference - high : 0;
      if (apart > 0 ? apart >= distance : distance == 0) return;
      distance = apart;
      chosen = reference >= low && reference < high ? reference : inside(low, high, preferred);
    };
    consider(0, 0);
    scan(column, consider);
    return chosen;
  }

  const std::vector<std::size_t>& accepted() const { return accepted_; }

 private:
  struct Sample {
    int gain;  ///< of letting it pass
    int violations;
  };

  struct Move {
    std::size_t accepted = 0;
    long gain = 0;
  };

  Move bestMove(std::size_t column) const {
    long most = 0, present = 0;
    std::size_t where = 0;
    scan(column, [&](std::size_t accepted, long gain) {
      if (gain > most) most = gain, where = accepted;
      if (accepted == accepted_[column]) present = gain;
    });
    return {where, most - present};
  }

  /// Samples that weigh nothing are left out.
  void addColumn(const ThresholdColumn& column) {
    std::vector<std::uint32_t> entries;
    std::vector<double> values;
    for (std::size_t i = 0; i < column.value.size(); ++i) {
      if (samples_[column.sample[i]].gain == 0) continue;
      if (!values.empty() && values.back() != column.value[i]) entries.back() |= 1;
      entries.push_back(column.sample[i] << 1);
      values.push_back(column.value[i]);
    }
    if (!entries.empty()) entries.back() |= 1;
    accepted_.push_back(values.size());
    entries_.push_back(std::move(entries));
    values_.push_back(std::move(values));
  }

  /// Calls see(accepted, gain) for every place of the column's threshold but the first, given all others.
  template <class See>
  void scan(std::size_t column, const See& see) const {
    const auto& entries = entries_[column];
    long gain = 0;
    const auto over = [&](std::size_t begin, std::size_t end, int others_allow) {
      for (std::size_t i = begin; i < end; ++i) {
        const Sample s = samples_[entries[i] >> 1];
        gain += s.gain & -int(s.violations == others_allow);
        if (entries[i] & 1) see(i + 1, gain);
      }
    };
    over(0, accepted_[column], 0);
    over(accepted_[column], entries.size(), 1);
  }

  static double inside(double low, double high, double preferred) {
    constexpr double kMargin_m = 1e-5;  // twice what maps decide in double (GridView::kClose_m)
    const double margin = std::min(kMargin_m, (high - low) / 2);
    return std::clamp(preferred, low + margin, high - margin);
  }

  std::vector<Sample> samples_;
  std::vector<std::vector<std::uint32_t>> entries_;  ///< by column: 2 * sample + 1 if the next value is another one
  std::vector<std::vector<double>> values_;
  std::vector<std::size_t> accepted_;
};

/// Thresholds as lengths, as near to the reference as the error that was reached allows.
void settle(Descent& descent, const std::vector<double>& reference, const std::vector<double>& preferred,
            ThresholdFit& fit) {
  fit.threshold.resize(reference.size());
  for (std::size_t c = 0; c < reference.size(); ++c) {
    fit.threshold[c] = descent.bestValue(c, reference[c], preferred[c]);
    descent.set(c, fit.threshold[c]);
  }
  fit.error = double(descent.error()) * kWeightUnit;
  fit.outcome = Outcome::Converged;
}

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
  return double(d.error()) * kWeightUnit;
}

ThresholdFit descendThresholds(const ThresholdProblem& problem, const std::vector<double>& start, const Job& job) {
  Descent descent{problem};
  for (std::size_t c = 0; c < start.size(); ++c) descent.set(c, start[c]);
  descent.descendInOrder(false, job);
  ThresholdFit fit{.outcome = Outcome::Cancelled};
  if (job.cancelled()) return fit;
  settle(descent, start, start, fit);
  return fit;
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
  long least = std::numeric_limits<long>::max();
  const auto from = [&](const std::vector<double>& start, const auto& descend) {
    for (std::size_t c = 0; c < columns; ++c) descent.set(c, std::min(start[c], bounds[c]));
    descend();
    if (const long error = descent.error(); error < least) least = error, best = descent.accepted();
  };
  for (const auto& start : starts) {
    from(start, [&] { descent.descendInOrder(false, job); });
    from(start, [&] { descent.descendInOrder(true, job); });
    from(start, [&] { descent.descendSteepest(job); });
  }
  ThresholdFit fit;
  if (job.cancelled()) {
    fit.outcome = Outcome::Cancelled;
    return fit;
  }
  // In the whole problem.
  Descent whole{problem};
  for (std::size_t c = 0; c < columns; ++c) {
    const auto& value = small.columns[c].value;
    fit.threshold.push_back(best[c] == value.size() ? bounds[c] : best[c] > 0 ? value[best[c] - 1] : -kInfinity);
    whole.set(c, fit.threshold[c]);
  }
  settle(whole, reference, preferred, fit);
  return fit;
}

}  // namespace sinew
