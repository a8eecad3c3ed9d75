#pragma once
#include <atomic>
#include <thread>

namespace sinew {

struct RowRange {
  int begin = 0, end = 0;
};

/// Runs `work(RowRange)` over bands of image rows on two threads. Rows must be independent of each other: then the
/// result is the same on any machine. `work` must not throw.
template <class Work>
void forEachRowBand(int height, const Work& work) {
  constexpr int kBands = 8;
  std::atomic<int> next{0};
  const auto run = [&] {
    for (int band = next++; band < kBands; band = next++)
      work(RowRange{height * band / kBands, height * (band + 1) / kBands});
  };
  std::jthread second{run};
  run();
}

}  // namespace sinew
