#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <string_view>
#include <thread>
#include <vector>

#include "core/job.h"

namespace sinew {

/// Calls work(i) for every i below `count`, on all processors; who is free takes the next. Progress is reported on
/// the calling thread. The first exception is thrown on after all threads have stopped. Returns whether all was done:
/// false if the job was cancelled.
template <class Work>
bool forEachInParallel(std::size_t count, const Job& job, std::string_view stage, const Work& work) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr failure;
  std::mutex failing;
  const auto take = [&](bool reports) {
    try {
      for (std::size_t i = next++; i < count && !job.cancelled(); i = next++) {
        work(i);
        if (reports) job.report(static_cast<double>(i + 1) / static_cast<double>(count), stage);
      }
    } catch (...) {
      next = count;
      const std::lock_guard lock{failing};
      if (!failure) failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> threads;
    const std::size_t more = std::min<std::size_t>(std::max(1U, std::thread::hardware_concurrency()), count);
    for (std::size_t t = 1; t < more; ++t) threads.emplace_back(take, false);
    take(true);
  }
  if (failure) std::rethrow_exception(failure);
  return !job.cancelled();
}

}  // namespace sinew
