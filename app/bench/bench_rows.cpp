#include "app/bench/bench_rows.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "app/bench/bench_postures.h"
#include "core/kernel/joint_grid.h"
#include "core/kernel/sweep.h"
#include "core/muscle/hill.h"
#include "core/muscle/muscle_path.h"
#include "core/rom/maps/rom_cells_internal.h"
#include "core/rom/maps/rom_map.h"

namespace sinew {
namespace {

constexpr std::size_t kBatch = 256;     // postures: tables stay in the second-level cache
constexpr std::size_t kSweep = 70'000;  // postures of the sweep
constexpr double kSame_m = 1e-9;        // two ways of rounding

void demand(bool same, const std::string& row, const std::string& what) {
  if (!same) throw std::runtime_error{"row " + row + " is not timed: " + what + " differ"};
}

KernelLanes lanesOf(const CompiledModel& model) {
  return kernelLanes(model.isa());
}

/// All anchors of the unit on one segment a point, none on a driven segment: what MuJoCo computes exactly as we do.
bool isPlain(const Skeleton& skeleton, const MusculotendonUnit& unit) {
  return std::ranges::all_of(unit.path, [&](const PathPoint& point) {
    return point.anchors.size() == 1 && point.anchors.front().segment < skeleton.movingSegmentCount();
  });
}

}  // namespace

/// The map of the right hip with the knee straight.
struct BenchRows::GridWork {
  int joint;
  Posture held;
  RomMap map;
  std::vector<int> spanning;
  std::vector<Eigen::VectorXd> dart_positions;  ///< by cell
  std::vector<std::uint8_t> ours, peers;
};

BenchRows::BenchRows(const Model& model)
    : model_{model},
      compiled_{model_.skeleton, model_.musculature},
      postures_{benchPostures(model_.skeleton, kBatch)},
      table_{postures_},
      all_units_(model_.musculature.units.size()),
      dart_{DartPeer::make(model_)},
      mujoco_{MujocoPeer::make(model_)} {
  std::iota(all_units_.begin(), all_units_.end(), 0);
  for (const Posture& q : postures_) {
    if (dart_) dart_positions_.push_back(dart_->positions(q));
    if (mujoco_) mujoco_positions_.push_back(mujoco_->positions(q));
  }
  addKinematics();
  addLengths();
  addGradients();
  addGrid();
  addSweep();
}

BenchRows::~BenchRows() = default;

void BenchRows::addKinematics() {
  batchPoses(compiled_, table_, X_WB_);
  for (std::size_t i = 0; i < kBatch; ++i) {
    const auto expected = segmentPoses(model_.skeleton, postures_[i]);
    if (dart_) dart_->moveTo(dart_positions_[i]);
    for (std::size_t s = 0; s < expected.size(); ++s)
      for (int k = 0; k < 12; ++k) {
        demand(std::abs(X_WB_(i, 12 * s + k) - expected[s](k / 4, k % 4)) < kSame_m, "1", "poses");
        if (dart_)
          demand(std::abs(dart_->X_WB(int(s))(k / 4, k % 4) - expected[s](k / 4, k % 4)) < kSame_m, "1",
                 "poses of DART");
      }
  }
  BenchRow row{1,
               "1",
               "kinematics of 23 segments, batch",
               "posture",
               1,
               "double",
               lanesOf(compiled_).doubles,
               15,
               DartPeer::version(),
               {[this] { batchPoses(compiled_, table_, X_WB_); }, kBatch},
               std::nullopt};
  if (dart_)
    row.peer = Workload{[this] {
                          for (const auto& x : dart_positions_) dart_->moveTo(x);
                        },
                        kBatch};
  rows_.push_back(row);
}

void BenchRows::addLengths() {
  batchLengths(compiled_, table_, lengths_);
  for (std::size_t i = 0; i < kBatch; ++i) {
    const auto X_WB = segmentPoses(model_.skeleton, postures_[i]);
    if (dart_) dart_->moveTo(dart_positions_[i]), dart_->lengths(all_units_, peer_lengths_);
    for (std::size_t u = 0; u < all_units_.size(); ++u) {
      const double expected_m = pathLength(model_.musculature.units[u], X_WB);
      demand(std::abs(lengths_(i, u) - expected_m) < kSame_m, "2", "lengths");
      if (dart_) demand(std::abs(peer_lengths_[u] - expected_m) < kSame_m, "2", "lengths of DART");
    }
  }
  BenchRow row{2,
               "2",
               "all lengths, kinematics included, batch",
               "posture",
               1,
               "double",
               lanesOf(compiled_).doubles,
               13,
               DartPeer::version() + ", plain loop",
               {[this] { batchLengths(compiled_, table_, lengths_); }, kBatch},
               std::nullopt};
  if (dart_)
    row.peer = Workload{[this] {
                          for (const auto& x : dart_positions_) {
                            dart_->moveTo(x);
                            dart_->lengths(all_units_, peer_lengths_);
                          }
                        },
                        kBatch};
  rows_.push_back(row);
}

void BenchRows::addGradients() {
  batchGradients(compiled_, table_, lengths_, gradients_);
  const auto alone = std::make_shared<PostureKernel>(compiled_);
  for (std::size_t i = 0; i < kBatch; ++i) {
    const Kinematics k = kinematics(model_.skeleton, postures_[i]);
    alone->evaluate(postures_[i]);
    if (mujoco_) mujoco_->setPositions(mujoco_positions_[i]), mujoco_->lengthsAndGradients();
    for (std::size_t u = 0; u < all_units_.size(); ++u) {
      const MusculotendonUnit& unit = model_.musculature.units[u];
      const Eigen::VectorXd expected = lengthGradient(unit, k);
      for (int e = compiled_.gradientStart()[u]; e < compiled_.gradientStart()[u + 1]; ++e) {
        const double slope = expected[compiled_.gradientCoordinate()[e]];
        demand(std::abs(gradients_(i, e) - slope) < kSame_m, "3", "gradients");
        demand(std::abs(alone->gradients()[e] - slope) < kSame_m, "4", "gradients");
      }
      if (mujoco_ && isPlain(model_.skeleton, unit))
        demand(std::abs(mujoco_->length_m(int(u)) - pathLength(unit, k.X_WB)) < kSame_m, "3", "lengths of MuJoCo");
    }
  }
  BenchRow row{3,
               "3",
               "all lengths and gradients, kinematics included, batch",
               "posture",
               1,
               "double",
               lanesOf(compiled_).doubles,
               22,
               MujocoPeer::version(),
               {[this] { batchGradients(compiled_, table_, lengths_, gradients_); }, kBatch},
               std::nullopt};
  if (mujoco_)
    row.peer = Workload{[this] {
                          for (const auto& x : mujoco_positions_) {
                            mujoco_->setPositions(x);
                            mujoco_->lengthsAndGradients();
                          }
                        },
                        kBatch};
  rows_.push_back(row);
  row.number = 4;
  row.id = "4";
  row.task = "the same, one posture at a time";
  row.lanes = lanesOf(compiled_).single;
  row.target_ratio = 9;
  row.ours = {[this, alone] {
                for (const Posture& q : postures_) alone->evaluate(q);
              },
              kBatch};
  rows_.push_back(row);
}

void BenchRows::addGrid() {
  const int joint = model_.skeleton.jointIndex("hip_r");
  grid_ = std::make_unique<GridWork>(
      GridWork{joint,
               zeroPosture(model_.skeleton),
               romMap(model_, "hip_r", zeroPosture(model_.skeleton), {.joint_limits = false}),
               unitsSpanning(model_.skeleton, model_.musculature, joint),
               {},
               {},
               {}});
  GridWork& g = *grid_;
  g.ours = g.map.valid;
  g.peers.resize(RomMap::kCells);
  if (dart_)
    for (int i = 0; i < RomMap::kCells; ++i) {
      Posture q = g.held;
      const int polars = RomMap::kPolars * RomMap::kAzimuths;
      q.segment<3>(model_.skeleton.joints[joint].first_coordinate) =
          vectorFromRotation(g.map.R_JB(i / polars, i % polars / RomMap::kAzimuths, i % RomMap::kAzimuths));
      g.dart_positions.push_back(dart_->positions(q));
    }
  const auto peerMap = [this, &g](const std::vector<int>& units) {
    for (int i = 0; i < RomMap::kCells; ++i) {
      dart_->moveTo(g.dart_positions[i]);
      dart_->lengths(units, peer_lengths_);
      g.peers[i] = 1;
      for (std::size_t k = 0; k < units.size() && g.peers[i]; ++k)
        g.peers[i] = peer_lengths_[k] <= compiled_.longest_m()[units[k]];
    }
  };
  BenchRow row{5,
               "5",
               "map of the right hip, 23,328 cells, against the loop over all units",
               "map",
               1,
               "single",
               lanesOf(compiled_).floats,
               250,
               DartPeer::version() + ", plain loop",
               {[this, &g] { g.ours = cellsWithinMuscles(model_, g.joint, g.held, g.map); }, 1},
               std::nullopt};
  if (dart_) {
    peerMap(g.spanning);
    demand(g.peers == g.ours, "5", "cells of DART");
    row.peer = Workload{[this, peerMap] { peerMap(all_units_); }, 1};
  }
  rows_.push_back(row);
  row.id = "5 spanning";
  row.task = "the same, against the loop over the " + std::to_string(g.spanning.size()) + " units that span the hip";
  row.target_ratio = 80;
  if (dart_) row.peer = Workload{[peerMap, &g] { peerMap(g.spanning); }, 1};
  rows_.push_back(row);
}

void BenchRows::addSweep() {
  // The same postures again and again in another order of blocks: as much work and memory as 70,000 different ones.
  sweep_postures_ = PoseTable{kSweep, table_.entryCount()};
  for (std::size_t i = 0; i < kSweep; ++i) sweep_postures_.set(i, postures_[(i * 7 + i / kBatch) % kBatch]);
  const PostureReader read = [this](std::size_t first, PoseTable& chunk) {
    if (chunk.poseCount() == 1) return chunk.set(0, sweep_postures_.pose(first));  // one that is asked for again
    const std::size_t block = chunk.entryCount() * PoseTable::kBlock;
    std::copy_n(sweep_postures_.block(first / PoseTable::kBlock), chunk.blockCount() * block, chunk.block(0));
  };
  const auto peerSweep = [this] {  // of the batch alone: its time does not depend on how many follow
    std::vector<double> longest_m(all_units_.size(), 0.0);
    int valid = 0;
    for (const auto& x : dart_positions_) {
      dart_->moveTo(x);
      dart_->lengths(all_units_, peer_lengths_);
      bool allowed = true;
      for (std::size_t u = 0; u < all_units_.size(); ++u) {
        longest_m[u] = std::max(longest_m[u], peer_lengths_[u]);
        allowed = allowed && peer_lengths_[u] <= compiled_.longest_m()[u];
      }
      valid += allowed;
    }
    return std::pair{longest_m, valid};
  };
  const std::vector<double> peer_longest_m = dart_ ? peerSweep().first : std::vector<double>{};
  for (const bool single : {false, true}) {
    const auto precision = single ? Precision::Single : Precision::Double;
    const PostureSweep sweep = sweepPostures(compiled_, kSweep, read, precision);
    for (std::size_t u = 0; u < all_units_.size(); ++u) {
      double expected_m = 0;
      for (std::size_t i = 0; i < kBatch; ++i) expected_m = std::max(expected_m, lengths_(i, u));
      demand(std::abs(sweep.longest_m[u] - expected_m) < 1e-5, "6", "longest paths");
      if (dart_) demand(std::abs(peer_longest_m[u] - expected_m) < 1e-5, "6", "longest paths of DART");
    }
    BenchRow row{6,
                 single ? "6 single" : "6",
                 "validity and longest paths over 70,000 postures",
                 "sweep",
                 double(kSweep),
                 single ? "single" : "double",
                 single ? lanesOf(compiled_).floats : lanesOf(compiled_).doubles,
                 single ? 25.0 : 13.0,
                 DartPeer::version() + ", plain loop",
                 {[this, read, precision] { sweepPostures(compiled_, kSweep, read, precision); }, double(kSweep)},
                 std::nullopt};
    if (dart_) row.peer = Workload{[peerSweep] { peerSweep(); }, kBatch};
    rows_.push_back(row);
  }
}

}  // namespace sinew
