#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/rom/rom_edit_stops_internal.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTolerance_rad = 1e-9;    // as maps have it
constexpr double kLeastWidth_rad = 0.017;  // of an interval of stops
constexpr int kMostRounds = 8;

/// One of the six ends as an upper limit: sign * angle <= sign * end.
struct End {
  int angle;
  double sign;
  double& of(StopBox& box) const { return sign > 0 ? box.max_rad[angle] : box.min_rad[angle]; }
  double of(const StopBox& box) const { return sign > 0 ? box.max_rad[angle] : box.min_rad[angle]; }
};

struct Candidate {
  double value, gain;
};

bool inside(const StopBox& box, const Eigen::Vector3d& reading) {
  return ((reading - box.min_rad).array() >= -kTolerance_rad).all() &&
         ((box.max_rad - reading).array() >= -kTolerance_rad).all();
}

/// What each cell needs of one end, all others held; sorted.
std::vector<Candidate> candidates(const JointCells& cells, const std::vector<std::uint32_t>& relevant,
                                  const std::vector<double>& gain, StopBox box, const End& end) {
  end.of(box) = end.sign * kInfinity;
  std::vector<Candidate> list;
  for (const std::uint32_t cell : relevant) {
    double needed = kInfinity;
    for (const Eigen::Vector3d& reading : cells.readings(cell))
      if (inside(box, reading)) needed = std::min(needed, end.sign * reading[end.angle]);
    if (needed < kInfinity) list.push_back({needed, gain[cell]});
  }
  std::ranges::sort(list, {}, &Candidate::value);
  return list;
}

/// The best upper limit: `reference` if it is one, else the one nearest to `carried`.
double bestEnd(const std::vector<Candidate>& list, double least_allowed, double reference, double carried) {
  double gain = 0, most = -kInfinity, chosen = carried, distance = kInfinity;
  const auto consider = [&](double low, double high) {
    low = std::max(low, least_allowed);
    if (low > high || gain < most) return;
    if (gain > most) most = gain, distance = kInfinity;
    const double margin = std::min(1e-4, (high - low) / 2);
    const double value =
        reference >= low && reference < high ? reference : std::clamp(carried, low + margin, high - margin);
    const double apart = value == reference ? -1 : std::abs(value - carried);
    if (apart < distance) distance = apart, chosen = value;
  };
  consider(-kInfinity, list.empty() ? kInfinity : list.front().value);
  for (std::size_t i = 0; i < list.size(); ++i) {
    gain += list[i].gain;
    const double next = i + 1 < list.size() ? list[i + 1].value : kInfinity;
    if (next > list[i].value) consider(list[i].value, next);
  }
  return chosen;
}

}  // namespace

bool StopBox::holds(const std::array<Eigen::Vector3d, 2>& readings) const {
  return inside(*this, readings[0]) || inside(*this, readings[1]);
}

StopBox stopBoxOf(const Skeleton& skeleton, int joint) {
  StopBox box;
  for (int i = 0; i < 3; ++i) {
    const Coordinate& c = skeleton.coordinates[skeleton.joints[joint].first_coordinate + i];
    box.min_rad[i] = c.stop_min_rad;
    box.max_rad[i] = c.stop_max_rad;
  }
  return box;
}

StopBox carriedStopBox(const Skeleton& skeleton, const RomTransform& transform, int joint) {
  const StopBox reference = stopBoxOf(skeleton, joint);
  const int first = skeleton.joints[joint].first_coordinate;
  StopBox carried = reference;
  for (int i = 0; i < 3; ++i)
    for (const double sign : {1.0, -1.0}) {
      const End end{i, sign};
      Eigen::VectorXd clinical = Eigen::VectorXd::Zero(skeleton.coordinateCount());
      clinical[first + i] = end.of(reference);
      const Posture q = transform.inverse(postureFromClinical(skeleton, clinical));
      end.of(carried) = clinicalFromPosture(skeleton, q)[first + i];
    }
  for (int i = 0; i < 3; ++i)
    if (carried.max_rad[i] - carried.min_rad[i] < kLeastWidth_rad) {
      carried.min_rad[i] = reference.min_rad[i];
      carried.max_rad[i] = reference.max_rad[i];
    }
  return carried;
}

StopBox fittedStopBox(const JointCells& cells, const std::vector<double>& gain, const StopBox& start,
                      const StopBox& reference, const StopBox& carried) {
  std::vector<std::uint32_t> relevant;
  for (std::size_t cell = 0; cell < cells.cellCount(); ++cell)
    if (gain[cell] != 0) relevant.push_back(static_cast<std::uint32_t>(cell));
  StopBox box = start;
  for (int round = 0; round < kMostRounds; ++round) {
    const StopBox before = box;
    for (int i = 0; i < 3; ++i)
      for (const double sign : {1.0, -1.0}) {
        const End end{i, sign}, other{i, -sign};
        const double least = sign * other.of(box) + kLeastWidth_rad;
        end.of(box) = sign * bestEnd(candidates(cells, relevant, gain, box, end), least, sign * end.of(reference),
                                     sign * end.of(carried));
      }
    if (box.min_rad == before.min_rad && box.max_rad == before.max_rad) break;
  }
  return box;
}

}  // namespace sinew
