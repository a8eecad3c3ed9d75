#include "app/bench/measure.h"

#include <benchmark/benchmark.h>

#include <algorithm>

namespace sinew {
namespace {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Keeps every window; prints nothing.
class Collector : public benchmark::BenchmarkReporter {
 public:
  Collector(const std::map<std::string, Workload>& workloads, std::map<std::string, Timing>& timings)
      : workloads_{workloads}, timings_{timings} {}
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
      const std::string& name = run.run_name.function_name;
      const double items = static_cast<double>(run.iterations) * workloads_.at(name).items;
      timings_[name].cpu_s.push_back(run.cpu_accumulated_time / items);
      timings_[name].wall_s.push_back(run.real_accumulated_time / items);
    }
  }

 private:
  const std::map<std::string, Workload>& workloads_;
  std::map<std::string, Timing>& timings_;
};

}  // namespace

double Timing::medianCpu_s() const {
  return median(cpu_s);
}
double Timing::bestCpu_s() const {
  return *std::ranges::min_element(cpu_s);
}
double Timing::medianWall_s() const {
  return median(wall_s);
}

std::map<std::string, Timing> measure(const std::map<std::string, Workload>& workloads, int windows,
                                      double window_s) {
  std::map<std::string, Timing> timings;
  std::string program = "sinew-bench", interleave = "--benchmark_enable_random_interleaving=true";
  char* arguments[] = {program.data(), interleave.data(), nullptr};
  int count = 2;
  benchmark::Initialize(&count, arguments);
  for (const auto& [name, workload] : workloads)
    benchmark::RegisterBenchmark(name.c_str(),
                                 [&run = workload.run](benchmark::State& state) {
                                   for (auto _ : state) run();
                                 })
        ->Repetitions(windows)
        ->MinTime(window_s)
        ->MeasureProcessCPUTime()  // of all threads
        ->Unit(benchmark::kMicrosecond);
  Collector collector{workloads, timings};
  benchmark::RunSpecifiedBenchmarks(&collector);
  benchmark::ClearRegisteredBenchmarks();
  benchmark::Shutdown();
  return timings;
}

}  // namespace sinew
