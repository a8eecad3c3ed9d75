#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/kernel/pose_table.h"
#include "core/skeleton/kinematics.h"

namespace sinew {

// Many postures: what a body has been seen to do, or may do. Single precision (0.2 kB a posture, 2e-7 rad), handed
// out in blocks so that whoever sweeps over them needs no memory of its own for all.

/// Postures as columns, 50 x n, at most kPoseBlock of them.
using PoseVisitor = std::function<void(const Eigen::MatrixXd& postures)>;
/// Anything that hands out postures: a set in memory, a file, a generator. May be asked repeatedly.
using PoseStream = std::function<void(const PoseVisitor& visit)>;
inline constexpr int kPoseBlock = 256;

/// The posture seen in the mirror Z = 0: right and left change places.
class PoseMirror {
 public:
  explicit PoseMirror(const Skeleton& skeleton);
  Posture operator()(const Posture& q) const;

 private:
  std::vector<int> from_;     ///< by entry: where it comes from
  std::vector<double> sign_;  ///< and its sign
};

class PoseSet {
 public:
  /// @param source what made it, in words: "average-adult, seed 2026", "walk.bvh".
  PoseSet(const Skeleton& skeleton, std::string source);

  void add(const Posture& q);
  void append(const PoseSet& other);  ///< of the same coordinates (a bug of the caller otherwise)
  std::size_t size() const { return values_.size() / names_.size(); }
  Posture posture(std::size_t i) const;
  const std::string& source() const { return source_; }
  const std::vector<std::string>& coordinateNames() const { return names_; }

  void visit(const PoseVisitor& visit) const;
  /// Fills `table` with the postures from number `first` on, as many as it has room for.
  void read(std::size_t first, PoseTable& table) const;
  PoseStream stream() const {
    return [this](const PoseVisitor& v) { visit(v); };
  }

  /// Own binary file, "sinew.pose_set" version 1: eight bytes "SINEWPOS", length of a JSON header, the header
  /// (source, coordinate names, count), then count x 50 little-endian 32-bit floats.
  void save(const std::filesystem::path& file) const;

 private:
  friend PoseSet loadPoseSet(const std::filesystem::path& file, const Skeleton& skeleton);
  std::vector<std::string> names_;
  std::string source_;
  std::vector<float> values_;
};

/// @throws InputError: file, field, expected, found; for values that are no finite numbers too.
PoseSet loadPoseSet(const std::filesystem::path& file, const Skeleton& skeleton);
/// What a file says of itself. @throws InputError as loadPoseSet.
struct PoseFileHeader {
  std::string source;
  std::size_t count = 0;
};
PoseFileHeader readPoseFileHeader(const std::filesystem::path& file, const Skeleton& skeleton);
/// Postures of a file without loading it whole. @throws InputError as loadPoseSet.
void visitPoseFile(const std::filesystem::path& file, const Skeleton& skeleton, const PoseVisitor& visit);

/// The set and its mirror images, alternating.
PoseSet withMirrorImages(const PoseSet& set, const Skeleton& skeleton);
/// Every `step`-th posture, from the first.
PoseSet subsampled(const PoseSet& set, int step, const Skeleton& skeleton);
/// Without postures that no body takes: some coordinate more than `tolerance_rad` beyond the athlete envelope.
/// `rejected`: how many were left out.
PoseSet withoutOutliers(const PoseSet& set, const Skeleton& skeleton, double tolerance_rad, std::size_t& rejected);

}  // namespace sinew
