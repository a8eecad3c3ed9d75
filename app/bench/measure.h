#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace sinew {

/// Seconds that one item took, over the windows of one measurement.
struct Timing {
  std::vector<double> cpu_s, wall_s;  ///< one entry a window
  double medianCpu_s() const;
  double bestCpu_s() const;
  double medianWall_s() const;
};

/// Something to be timed.
struct Workload {
  std::function<void()> run;
  double items = 1;  ///< that one call of `run` does
};

/// Times all workloads by Google Benchmark, `windows` windows of at least `window_s` each, windows of different
/// workloads in random order, so that a disturbance meets all alike.
std::map<std::string, Timing> measure(const std::map<std::string, Workload>& workloads, int windows, double window_s);

}  // namespace sinew
