#pragma once
#include "core/parallel.h"

namespace sinew {

struct RowRange {
  int begin = 0, end = 0;
};

/// Runs `work(RowRange)` over bands of image rows on all processors. Rows must be independent of each other: then the
/// result is the same on any machine.
template <class Work>
void forEachRowBand(int height, const Work& work) {
  constexpr int kBands = 8;
  forEachInParallel(kBands, {}, "rows", [&](std::size_t band) {
    const int b = static_cast<int>(band);
    work(RowRange{height * b / kBands, height * (b + 1) / kBands});
  });
}

}  // namespace sinew
