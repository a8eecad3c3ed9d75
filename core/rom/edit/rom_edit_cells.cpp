#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/angle.h"
#include "core/kernel/batch.h"
#include "core/posture/twist_swing.h"
#include "core/rom/edit/rom_edit_cells_internal.h"
#include "core/rom/maps/rom_cells_internal.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

constexpr double kBeyondAthlete_rad =
    30 * kRadPerDeg;  // as far as the cells of a hinge go: edits may go beyond stops

Musculature onlyUnits(const Musculature& all, const std::vector<int>& units) {
  Musculature some;
  for (const int u : units) some.units.push_back(all.units[std::size_t(u)]);
  return some;
}

ThresholdColumn sorted(const std::vector<double>& value) {
  ThresholdColumn column;
  column.sample.resize(value.size());
  std::iota(column.sample.begin(), column.sample.end(), 0u);
  std::ranges::stable_sort(column.sample, {}, [&](std::uint32_t s) { return value[s]; });
  for (const auto s : column.sample) column.value.push_back(value[s]);
  return column;
}

}  // namespace

JointCells::JointCells(const Model& model, int joint, const std::vector<HeldPosture>& held, const Job& job)
    : joint_{joint},
      first_coordinate_{model.skeleton.joints[joint].first_coordinate},
      ball_{model.skeleton.joints[joint].type == JointType::Ball},
      held_{held},
      units_{unitsOverJoint(model, joint)},
      compiled_{model.skeleton, onlyUnits(model.musculature, units_)} {
  const Joint& j = model.skeleton.joints[joint];
  if (ball_) {
    const RomMap map{j.name, romMapFrame(model.skeleton, joint), {}};
    cells_ = RomMap::kCells;
    std::vector<Eigen::Matrix3d> swings;
    for (int p = 0; p < RomMap::kPolars; ++p)
      for (int a = 0; a < RomMap::kAzimuths; ++a) swings.push_back(map.swing_J(p, a));
    for (int t = 0; t < RomMap::kTwists; ++t) {
      const Eigen::Matrix3d twist = rotationAbout<double>(map.frame.shaft_J, RomMap::twist_rad(t));
      for (const Eigen::Matrix3d& swing : swings) {
        const Eigen::Matrix3d R_JB = swing * twist;
        cell_vector_.push_back(vectorFromQuaternion(Eigen::Quaterniond{R_JB}));
      }
    }
  } else {
    const Coordinate& c = model.skeleton.coordinates[first_coordinate_];
    const double low = std::floor((c.athlete_min_rad - kBeyondAthlete_rad) / kRadPerDeg);
    const double high = std::ceil((c.athlete_max_rad + kBeyondAthlete_rad) / kRadPerDeg);
    first_angle_rad_ = (low + 0.5) * kRadPerDeg;  // cells between whole degrees: no stop lies on a cell
    cells_ = static_cast<std::size_t>(high - low);
  }
  measure(job);
}

double JointCells::angle_rad(std::size_t cell) const {
  return first_angle_rad_ + double(cell) * kRadPerDeg;
}

Posture JointCells::posture(const Posture& held, std::size_t cell) const {
  Posture q = held;
  if (ball_)
    q.segment<3>(first_coordinate_) = cell_vector_[cell];
  else
    q[first_coordinate_] = angle_rad(cell);
  return q;
}

void JointCells::measure(const Job& job) {
  std::vector<std::vector<double>> length_m(units_.size(), std::vector<double>(sampleCount()));
  constexpr std::size_t kChunk = 1024;
  PoseTable lengths;
  for (std::size_t first = 0; first < sampleCount() && !job.cancelled(); first += kChunk) {
    const std::size_t count = std::min(kChunk, sampleCount() - first);
    PoseTable postures{count, std::size_t(compiled_.coordinateCount())};
    for (std::size_t i = 0; i < count; ++i)
      postures.set(i, posture(held_[(first + i) / cells_].posture, (first + i) % cells_));
    batchLengths(compiled_, postures, lengths);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t u = 0; u < units_.size(); ++u) length_m[u][first + i] = lengths(i, u);
  }
  for (const auto& values : length_m)
    if (!job.cancelled()) columns_.push_back(sorted(values));
}

std::vector<std::uint8_t> JointCells::allowed(const std::vector<double>& longest_m) const {
  std::vector<std::uint8_t> result(sampleCount(), 1);
  for (std::size_t u = 0; u < units_.size(); ++u) {
    const auto& [value, sample] = columns_[u];
    for (auto i = value.size(); i > 0 && value[i - 1] > longest_m[std::size_t(units_[u])]; --i)
      result[sample[i - 1]] = 0;
  }
  return result;
}

}  // namespace sinew
