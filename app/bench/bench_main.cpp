// sinew-bench: the table of docs/validation.md, "Speed". Both columns are measured in this run; a peer that is not
// installed is "not measured".
#include <CLI/CLI.hpp>
#include <iostream>
#include <optional>
#include <set>

#include "app/bench/bench_rows.h"
#include "app/bench/retarget_rows.h"
#include "core/file.h"
#include "core/strict_json.h"
#include "core/text.h"
#include "core/version.h"

namespace sinew {
namespace {

struct BenchOptions {
  std::filesystem::path resources, out;
  std::vector<int> rows;  ///< empty: all
  int windows = 9;
  double window_s = 0.1;
  bool json = false;
};

/// "231 ns", "4.1 us", "87 ms": three digits.
std::string timeText(double seconds) {
  const char* unit = seconds < 1e-6 ? "ns" : seconds < 1e-3 ? "us" : seconds < 1 ? "ms" : "s";
  const double value = seconds * (seconds < 1e-6 ? 1e9 : seconds < 1e-3 ? 1e6 : seconds < 1 ? 1e3 : 1);
  return fixed(value, value < 10 ? 2 : value < 100 ? 1 : 0) + " " + unit;
}

std::string timesText(const Timing& t, double items) {
  return timeText(t.medianCpu_s() * items) + " / " + timeText(t.bestCpu_s() * items) + " / " +
         timeText(t.medianWall_s() * items);
}

std::string ratioText(double ratio) {
  return fixed(ratio, ratio < 10 ? 1 : 0);
}

Json timingJson(const Timing& t, double items) {
  Json windows = Json::array();
  for (std::size_t i = 0; i < t.cpu_s.size(); ++i)
    windows.push_back({{"cpu_s", t.cpu_s[i] * items}, {"wall_s", t.wall_s[i] * items}});
  return {{"median_cpu_s", t.medianCpu_s() * items},
          {"min_cpu_s", t.bestCpu_s() * items},
          {"median_wall_s", t.medianWall_s() * items},
          {"windows", windows}};
}

class Table {
 public:
  Table(const std::vector<BenchRow>& rows, Isa isa, const std::map<std::string, Timing>& timings)
      : rows_{rows}, isa_{isa}, timings_{timings} {}

  Json json() const {
    Json rows = Json::array();
    for (const BenchRow& row : rows_)
      if (const auto* ours = timing("ours", row)) rows.push_back(rowJson(row, *ours, timing("peer", row)));
    return {{"format", "sinew.bench"},
            {"version", 1},
            {"program", std::string{"sinew "} + kVersion},
            {"isa", isaName(isa_)},
            {"rows", rows}};
  }

  std::string text() const {
    std::string text =
        "Instruction set: " + std::string{isaName(isa_)} +
        ". One thread; rows 7, 8, 14 all processors, CPU of all threads. Times are CPU median / CPU smallest / wall "
        "median of an item; ratio of the smallest.\n\n"
        "| row | task | lanes | ours | peer | peer's time | ratio | target |\n"
        "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
    for (const BenchRow& row : rows_) {
      const auto *ours = timing("ours", row), *peer = timing("peer", row);
      if (ours == nullptr) continue;
      text += "| " + row.id + " | " + row.task + " (a " + row.item + ") | " + std::to_string(row.lanes) + " " +
              row.real + " | " + timesText(*ours, row.items) + " | " + row.peer_name + " | " +
              (peer ? timesText(*peer, row.items) : "not measured") + " | " +
              (peer ? ratioText(peer->bestCpu_s() / ours->bestCpu_s()) : "-") + " | " + ratioText(row.target_ratio) +
              " |\n";
    }
    return text;
  }

 private:
  const Timing* timing(const std::string& who, const BenchRow& row) const {
    const auto found = timings_.find(who + " " + row.id);
    return found == timings_.end() ? nullptr : &found->second;
  }

  static Json rowJson(const BenchRow& row, const Timing& ours, const Timing* peer) {
    Json json{{"row", row.number},
              {"id", row.id},
              {"task", row.task},
              {"item", row.item},
              {"lanes", row.lanes},
              {"real", row.real},
              {"peer", row.peer_name},
              {"target_ratio", row.target_ratio},
              {"ours", timingJson(ours, row.items)}};
    json["peer_times"] = peer ? timingJson(*peer, row.items) : Json{};
    json["ratio"] = peer ? Json(peer->bestCpu_s() / ours.bestCpu_s()) : Json{};
    json["ratio_of_medians"] = peer ? Json(peer->medianCpu_s() / ours.medianCpu_s()) : Json{};
    return json;
  }

  const std::vector<BenchRow>& rows_;
  Isa isa_;
  const std::map<std::string, Timing>& timings_;
};

void run(const BenchOptions& o) {
  constexpr int kLastKernelRow = 6;
  const auto asksFor = [&](const auto& which) { return o.rows.empty() || std::ranges::any_of(o.rows, which); };
  std::optional<BenchRows> kernels;
  std::optional<RetargetRows> retargeting;
  std::vector<BenchRow> rows;
  if (asksFor([](int row) { return row <= kLastKernelRow; })) {
    kernels.emplace(loadReferenceModel(o.resources));
    rows = kernels->rows();
    std::erase_if(rows, [&](const BenchRow& row) {
      return !o.rows.empty() && std::ranges::find(o.rows, row.number) == o.rows.end();
    });
  }
  if (asksFor([](int row) { return row > kLastKernelRow; })) {
    retargeting.emplace(o.resources, o.rows);
    rows.insert(rows.end(), retargeting->rows().begin(), retargeting->rows().end());
  }
  std::map<std::string, Workload> workloads;
  for (const BenchRow& row : rows) {
    workloads["ours " + row.id] = row.ours;
    if (row.peer) workloads["peer " + row.id] = *row.peer;
  }
  const auto timings = measure(workloads, o.windows, o.window_s);
  const Table table{rows, kernels ? kernels->isa() : chosenIsa(), timings};
  if (!o.out.empty()) writeFileAtomically(o.out, table.json().dump(1) + "\n");
  std::cout << (o.json ? table.json().dump(1) + "\n" : table.text());
}

int main(int argc, char** argv) {
  BenchOptions o;
  CLI::App app{"Speed against other programs on the same model, measured in one run.", "sinew-bench"};
  app.add_option("--resources", o.resources, "folder of the reference data")->required();
  app.add_option("--row", o.rows, "rows of the table, 1 to 8 and 14; all if not given")
      ->check(CLI::IsMember({1, 2, 3, 4, 5, 6, 7, 8, 14}));
  app.add_option("--windows", o.windows, "measurements of each")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--window-seconds", o.window_s, "shortest time of one")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--out", o.out, "file for the JSON document");
  app.add_flag("--json", o.json, "print JSON instead of the table");
  CLI11_PARSE(app, argc, argv);
  try {
    run(o);
    return 0;
  } catch (const InputError& error) {
    std::cerr << error.what() << "\n";
    return 2;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}

}  // namespace
}  // namespace sinew

int main(int argc, char** argv) {
  return sinew::main(argc, argv);
}
