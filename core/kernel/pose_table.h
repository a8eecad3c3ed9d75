#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <new>
#include <span>
#include <vector>

#include "core/skeleton/kinematics.h"

namespace sinew {

/// Doubles aligned for the widest vector registers.
template <class T>
struct LaneAllocator {
  using value_type = T;
  static constexpr std::align_val_t kAlignment{128};
  LaneAllocator() = default;
  template <class U>
  LaneAllocator(const LaneAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), kAlignment)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, kAlignment); }
  friend bool operator==(LaneAllocator, LaneAllocator) { return true; }
};
using LaneVector = std::vector<double, LaneAllocator<double>>;

/// A table of numbers, some for each of many poses, stored so that vector registers hold the same number of several
/// poses: blocks of 16 poses, in a block one entry after the other, 16 poses each. 16 is a multiple of every lane
/// count, so that the same table serves every processor. The last block is filled up with zeros.
class PoseTable {
 public:
  static constexpr std::size_t kBlock = 16;

  PoseTable() = default;
  PoseTable(std::size_t poses, std::size_t entries)
      : poses_{poses}, entries_{entries}, values_(blockCount() * kBlock * entries, 0.0) {}
  /// The postures themselves: one entry a coordinate. @pre all of one size.
  explicit PoseTable(std::span<const Posture> postures)
      : PoseTable{postures.size(), postures.empty() ? 0 : static_cast<std::size_t>(postures.front().size())} {
    for (std::size_t i = 0; i < postures.size(); ++i) set(i, postures[i]);
  }

  std::size_t poseCount() const { return poses_; }
  std::size_t entryCount() const { return entries_; }
  std::size_t blockCount() const { return (poses_ + kBlock - 1) / kBlock; }

  double& operator()(std::size_t pose, std::size_t entry) { return values_[index(pose, entry)]; }
  double operator()(std::size_t pose, std::size_t entry) const { return values_[index(pose, entry)]; }
  void set(std::size_t pose, const Posture& values) {
    for (std::size_t e = 0; e < entries_; ++e) (*this)(pose, e) = values[static_cast<Eigen::Index>(e)];
  }
  Eigen::VectorXd pose(std::size_t pose) const {
    Eigen::VectorXd values(static_cast<Eigen::Index>(entries_));
    for (std::size_t e = 0; e < entries_; ++e) values[static_cast<Eigen::Index>(e)] = (*this)(pose, e);
    return values;
  }

  double* block(std::size_t b) { return values_.data() + b * kBlock * entries_; }
  const double* block(std::size_t b) const { return values_.data() + b * kBlock * entries_; }

 private:
  std::size_t index(std::size_t pose, std::size_t entry) const {
    return (pose / kBlock * entries_ + entry) * kBlock + pose % kBlock;
  }
  std::size_t poses_ = 0, entries_ = 0;
  LaneVector values_;
};

}  // namespace sinew
