#pragma once
#include <cstdint>
#include <vector>

#include "core/job.h"

namespace sinew {

// Which samples a set of upper limits lets through, made as equal as possible to which samples are wanted. A sample
// passes if every column that knows it has a value at most the column's threshold: maps of a joint (samples are
// cells, columns muscles, values path lengths). The error, the weight of the samples that pass and should not or do
// not and should, is piecewise constant; with all other thresholds held the best of one column is found exactly in
// one pass over its sorted values. That gets stuck, so it is done from every start in three ways: columns in their
// order, in the reverse order, always the one that gains most.

struct ThresholdColumn {
  std::vector<double> value;          ///< ascending
  std::vector<std::uint32_t> sample;  ///< whose value it is
};

struct ThresholdProblem {
  std::vector<const ThresholdColumn*> columns;
  std::vector<std::uint8_t> wanted;  ///< by sample
  std::vector<double> weight;        ///< by sample; a multiple of 1/1024
};

struct ThresholdFit {
  Outcome outcome = Outcome::NotRun;
  std::vector<double> threshold;
  double error = 0;  ///< weight of the wrong samples
};

/// @param starts thresholds to begin from, at least one.
/// @param reference kept, bit for bit, by every column that it costs nothing to keep.
/// @param preferred by column: chosen among equally good values if the reference is not one of them.
ThresholdFit fitThresholds(const ThresholdProblem& problem, const std::vector<std::vector<double>>& starts,
                           const std::vector<double>& reference, const std::vector<double>& preferred,
                           const Job& job = {});

/// From one start, columns in their order alone: to where no single column can gain anything. Every column that it
/// costs nothing keeps its start, bit for bit; another takes the best value nearest to it. Quick, for many columns.
ThresholdFit descendThresholds(const ThresholdProblem& problem, const std::vector<double>& start,
                               const Job& job = {});

/// Weight of the wrong samples.
double thresholdError(const ThresholdProblem& problem, const std::vector<double>& threshold);

}  // namespace sinew
