#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/bench/dart_peer.h"
#include "app/bench/measure.h"
#include "app/bench/mujoco_peer.h"
#include "core/kernel/batch.h"
#include "core/model/model.h"

namespace sinew {

/// One line of the table.
struct BenchRow {
  int number = 0;
  std::string id;    ///< "6 single": the number, and the variant where there are several
  std::string task;  ///< in words
  std::string item;  ///< what the times are of: "posture", "map"
  double items = 1;  ///< so many of the workloads' items make the item
  std::string real;  ///< "double", "single"
  int lanes = 1;
  double target_ratio = 0;
  std::string peer_name;  ///< "DART 6.12.1"
  Workload ours;
  std::optional<Workload> peer;  ///< nullopt: not installed
};

/// The rows and what they work on. @throws std::runtime_error naming the row if ours and the readable code, or ours
/// and the peer, do not compute the same: a failure is not timed.
class BenchRows {
 public:
  explicit BenchRows(const Model& model);
  ~BenchRows();
  BenchRows(const BenchRows&) = delete;
  const std::vector<BenchRow>& rows() const { return rows_; }
  Isa isa() const { return compiled_.isa(); }

 private:
  void addKinematics();
  void addLengths();
  void addGradients();
  void addGrid();
  void addSweep();

  Model model_;
  CompiledModel compiled_;
  std::vector<Posture> postures_;
  PoseTable table_, X_WB_, lengths_, gradients_;
  std::vector<int> all_units_;
  std::unique_ptr<DartPeer> dart_;
  std::vector<Eigen::VectorXd> dart_positions_;
  std::unique_ptr<MujocoPeer> mujoco_;
  std::vector<Eigen::VectorXd> mujoco_positions_;
  struct GridWork;
  std::unique_ptr<GridWork> grid_;
  PoseTable sweep_postures_;
  std::vector<double> peer_lengths_;
  std::vector<BenchRow> rows_;
};

}  // namespace sinew
