#include "core/kernel/sweep.h"

#include <algorithm>
#include <numeric>

#include "core/kernel/compiled_arrays_internal.h"

namespace sinew {
namespace {

constexpr std::size_t kChunk = 32 * PoseTable::kBlock;  // postures in memory at a time

/// The sweep of one model in one precision, with its working memory.
class Sweeper {
 public:
  Sweeper(const CompiledModel& model, Precision precision)
      : model_{model}, scratch_{model}, single_{precision == Precision::Single} {}

  /// The first `poses` postures of one block.
  void block(const double* q, int poses, long first, PostureSweep& sweep, std::uint8_t* state) {
    const KernelTable& table = kernels(model_.isa());
    const double* limit_m = model_.longest_m().data();
    if (single_)
      table.sweep_float(model_.arrays().view<float>(), q, poses, first, scratch_.get(), limit_m,
                        sweep.longest_m.data(), sweep.longest_posture.data(), state);
    else
      table.sweep(model_.arrays().view<double>(), q, poses, first, scratch_.get(), limit_m, sweep.longest_m.data(),
                  sweep.longest_posture.data(), state);
  }

  void chunk(const PoseTable& postures, std::size_t first, PostureSweep& sweep) {
    for (std::size_t b = 0; b < postures.blockCount(); ++b) {
      const std::size_t begin = b * PoseTable::kBlock;
      const int poses = static_cast<int>(std::min(PoseTable::kBlock, postures.poseCount() - begin));
      block(postures.block(b), poses, static_cast<long>(first + begin), sweep, &sweep.valid[first + begin]);
    }
  }

 private:
  CompiledModel model_;
  KernelScratch scratch_;
  bool single_;
};

PostureSweep emptySweep(const CompiledModel& model, std::size_t count) {
  const auto units = static_cast<std::size_t>(model.unitCount());
  return {std::vector<double>(units, 0.0), std::vector<long>(units, 0), std::vector<std::uint8_t>(count, 0)};
}

/// One posture alone, in double.
class Referee {
 public:
  Referee(const CompiledModel& model, const PostureReader& read)
      : model_{model}, read_{read}, sweeper_{model, Precision::Double} {}

  PostureSweep operator()(std::size_t posture) {
    PoseTable one{1, static_cast<std::size_t>(model_.coordinateCount())};
    read_(posture, one);
    PostureSweep sweep = emptySweep(model_, 1);
    sweeper_.chunk(one, 0, sweep);
    return sweep;
  }

 private:
  const CompiledModel& model_;
  const PostureReader& read_;
  Sweeper sweeper_;
};

/// What single precision leaves open.
void settleInDouble(const CompiledModel& model, const PostureReader& read, PostureSweep& sweep) {
  Referee referee{model, read};
  for (std::size_t i = 0; i < sweep.valid.size(); ++i)
    if (sweep.valid[i] == static_cast<std::uint8_t>(CellState::Close)) sweep.valid[i] = referee(i).valid[0];
  std::vector<std::size_t> units(sweep.longest_m.size());
  std::iota(units.begin(), units.end(), std::size_t{0});
  std::ranges::stable_sort(units, {}, [&](std::size_t u) { return sweep.longest_posture[u]; });
  PostureSweep at;
  long posture = -1;
  for (const std::size_t u : units) {
    if (sweep.longest_posture[u] != posture)
      at = referee(static_cast<std::size_t>(posture = sweep.longest_posture[u]));
    sweep.longest_m[u] = at.longest_m[u];
  }
}

}  // namespace

std::size_t PostureSweep::validCount() const {
  return static_cast<std::size_t>(std::ranges::count(valid, 1));
}

PostureSweep sweepPostures(const CompiledModel& model, std::size_t count, const PostureReader& read,
                           Precision precision) {
  PostureSweep sweep = emptySweep(model, count);
  Sweeper sweeper{model, precision};
  PoseTable chunk;
  for (std::size_t first = 0; first < count; first += kChunk) {
    const std::size_t poses = std::min(kChunk, count - first);
    if (chunk.poseCount() != poses) chunk = PoseTable{poses, static_cast<std::size_t>(model.coordinateCount())};
    read(first, chunk);
    sweeper.chunk(chunk, first, sweep);
  }
  if (precision == Precision::Single && count > 0) settleInDouble(model, read, sweep);
  return sweep;
}

}  // namespace sinew
