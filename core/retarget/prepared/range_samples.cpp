#include "core/retarget/prepared/range_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/kernel/batch.h"
#include "core/muscle/hill.h"
#include "core/parallel.h"
#include "core/posture/twist_swing.h"
#include "core/posture/validity.h"
#include "core/rom/maps/rom_cells_internal.h"
#include "core/rom/maps/rom_map.h"
#include "core/rom/poses/pose_sampler.h"

namespace sinew {
namespace {

using Sample = JointRangeSamples::Sample;

constexpr int kWithinStops = 6144, kBeyondStops = 8192;  // drawn of a joint
constexpr int kFreeEvery = 3;  // every third with all other joints somewhere in their ranges
constexpr int kOtherPostures = 512;
constexpr std::uint32_t kOtherSeed = 41;  // not that of the pose set
constexpr double kBeyondHinge_rad = 30 * std::numbers::pi / 180;
/// Of the longest length: a posture in which every unit is shorter, or one is longer, says nothing in another body.
constexpr double kNear = 0.9, kFar = 1.15;

/// What an error counts: within the stops, where bodies move, four times what it counts beyond; twice as much with
/// the other joints at zero, as ranges are examined; a sixteenth for hinges, whose samples all lie on one line.
constexpr double kBeyond = 0.25, kFree = 0.5, kHinge = 1.0 / 16;
constexpr double kPerMille = 1000, kLeastValid = 50;

/// Point of an endless sequence that fills the cube [0, 1)^3 evenly (additive recurrence; Roberts 2018).
Eigen::Vector3d evenPoint(int index) {
  constexpr double kRatio = 1.22074408460575947536;  // x^4 = x + 1
  Eigen::Vector3d point;
  double step = 1;
  for (double& x : point) {
    step /= kRatio;
    const double value = 0.5 + index * step;
    x = value - std::floor(value);
  }
  return point;
}

/// Orientations of a joint, as entries of a posture.
class Draw {
 public:
  Draw(const Skeleton& skeleton, int joint) : skeleton_{skeleton}, joint_{skeleton.joints[joint]} {
    if (isBall()) frame_ = romMapFrame(skeleton, joint);
  }

  bool isBall() const { return joint_.type == JointType::Ball; }

  Eigen::Vector3d withinStops(const Eigen::Vector3d& x) const {
    if (!isBall()) return {std::lerp(coordinate(0).stop_min_rad, coordinate(0).stop_max_rad, x[0]), 0, 0};
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    for (int i = 0; i < 3; ++i) {
      const Coordinate& c = coordinate(i);
      R *= rotationAbout<double>(c.axis, std::lerp(c.stop_min_rad, c.stop_max_rad, x[i]));
    }
    return vectorFromRotation(R);
  }

  /// Evenly over twist, polar angle and azimuth, as maps are; false if it lies within the stops.
  bool beyondStops(const Eigen::Vector3d& x, Eigen::Vector3d& own) const {
    if (!isBall()) {
      const double beyond_rad = (2 * x[0] - 1) * kBeyondHinge_rad;
      own = {beyond_rad < 0 ? coordinate(0).stop_min_rad + beyond_rad : coordinate(0).stop_max_rad + beyond_rad, 0,
             0};
      return true;
    }
    constexpr double kPi = std::numbers::pi;
    const double polar = kPi * x[1], azimuth = 2 * kPi * x[2];
    const Eigen::Vector3d aside = frame_.shaft_J.cross(frame_.forward_J),
                          across = std::cos(azimuth) * frame_.forward_J + std::sin(azimuth) * aside,
                          direction = std::cos(polar) * frame_.shaft_J + std::sin(polar) * across;
    const Eigen::Quaterniond R_JB = rotationOf(frame_.shaft_J, {(2 * x[0] - 1) * kPi, direction});
    own = vectorFromQuaternion(R_JB);
    return ballStopMargin_rad(skeleton_, joint_, R_JB.toRotationMatrix()) < 0;
  }

 private:
  const Coordinate& coordinate(int i) const { return skeleton_.coordinates[joint_.first_coordinate + i]; }

  const Skeleton& skeleton_;
  const Joint& joint_;
  RomMapFrame frame_;
};

std::vector<Posture> otherPostures(const Skeleton& skeleton) {
  const PoseMirror mirror{skeleton};
  std::vector<Posture> others{zeroPosture(skeleton)};
  for (const Posture& q : normalPostures(skeleton, kOtherPostures, kOtherSeed)) {
    others.push_back(q);
    others.push_back(mirror(q));
  }
  return others;
}

/// Index of the other posture that is the mirror image.
std::uint16_t mirrored(std::uint16_t others) {
  return others == 0 ? 0 : ((others - 1) ^ 1) + 1;
}

/// The same in the mirror: a rotation vector keeps its turn about Z, a hinge its angle.
Sample mirrored(Sample sample, bool ball) {
  if (ball) sample.own[0] = -sample.own[0], sample.own[1] = -sample.own[1];
  sample.others = mirrored(sample.others);
  return sample;
}

/// Of a joint of the right side or the middle: first those within the stops, then those beyond. Verdicts are missing.
std::vector<Sample> drawn(const Skeleton& skeleton, int joint) {
  const Draw draw{skeleton, joint};
  const std::string& name = skeleton.joints[joint].name;
  const bool in_pairs = withoutSide(name) == name;
  std::vector<Sample> samples;
  int others = 0;
  const auto add = [&](const Eigen::Vector3d& own) {
    const bool free = samples.size() / (in_pairs ? 2 : 1) % kFreeEvery == kFreeEvery - 1;
    if (free) others = others % kOtherPostures + 1;
    samples.push_back({own.cast<float>(), static_cast<std::uint16_t>(free ? 2 * others - 1 : 0), false, 0});
    if (in_pairs) samples.push_back(mirrored(samples.back(), draw.isBall()));
  };
  int index = 0;
  while (samples.size() < kWithinStops) add(draw.withinStops(evenPoint(++index)));
  for (Eigen::Vector3d own; samples.size() < kWithinStops + kBeyondStops;)
    if (draw.beyondStops(evenPoint(++index), own)) add(own);
  return samples;
}

struct Verdict {
  bool valid = true, near = false, far = false;
};

/// Of all postures, by the reference.
std::vector<Verdict> judged(const RangeSamples& ranges, const Model& reference, const JointRangeSamples& joint) {
  std::vector<double> longest_m;
  for (const int u : joint.units)
    longest_m.push_back(longestLength_m(reference.musculature.units[static_cast<std::size_t>(u)]));
  std::vector<Verdict> verdicts(joint.samples.size());
  ranges.measure(joint, reference, [&](std::size_t first, std::size_t count, const PoseTable& lengths_m) {
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t u = 0; u < longest_m.size(); ++u) {
        Verdict& v = verdicts[first + i];
        v.valid = v.valid && lengths_m(i, u) <= longest_m[u];
        v.near = v.near || lengths_m(i, u) > kNear * longest_m[u];
        v.far = v.far || lengths_m(i, u) > kFar * longest_m[u];
      }
  });
  return verdicts;
}

/// Enters verdicts and weights; keeps what is near a longest length.
void sift(const std::vector<Verdict>& verdicts, bool hinge, JointRangeSamples& joint) {
  const auto kind = [&](std::size_t i) {
    return (i < kWithinStops ? 0 : 2) + (joint.samples[i].others == 0 ? 0 : 1);
  };
  std::array<double, 4> valid{};
  for (std::size_t i = 0; i < verdicts.size(); ++i) valid[kind(i)] += verdicts[i].valid;
  std::vector<Sample> kept;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    if (!verdicts[i].near || verdicts[i].far) continue;
    const int k = kind(i);
    const double counts = (hinge ? kHinge : 1) * (k >= 2 ? kBeyond : 1) * (k % 2 == 1 ? kFree : 1);
    kept.push_back(joint.samples[i]);
    kept.back().valid = verdicts[i].valid;
    kept.back().weight = static_cast<float>(counts * kPerMille / std::max(valid[k], kLeastValid));
  }
  joint.samples = std::move(kept);
}

}  // namespace

RangeSamples::RangeSamples(const Model& reference) : others_{otherPostures(reference.skeleton)} {
  const Skeleton& skeleton = reference.skeleton;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
    if (skeleton.joints[j].type != JointType::Free)
      joints_.push_back({static_cast<int>(j),
                         skeleton.joints[j].first_coordinate,
                         skeleton.joints[j].coordinate_count,
                         unitsOverJoint(reference, static_cast<int>(j)),
                         {}});
  forEachInParallel(joints_.size(), {}, "ranges of the reference", [&](std::size_t i) {
    JointRangeSamples& joint = joints_[i];
    const Joint& j = skeleton.joints[joint.joint];
    const bool left = j.name.ends_with("_l"), ball = j.type == JointType::Ball;
    joint.samples =
        drawn(skeleton, left ? skeleton.jointIndex(std::string{withoutSide(j.name)} + "_r") : joint.joint);
    if (left)
      for (Sample& sample : joint.samples) sample = mirrored(sample, ball);
    sift(judged(*this, reference, joint), !ball, joint);
  });
}

void RangeSamples::measure(const JointRangeSamples& joint, const Model& body, const Measured& measured) const {
  constexpr std::size_t kChunk = 512;
  Musculature units;
  for (const int u : joint.units) units.units.push_back(body.musculature.units[static_cast<std::size_t>(u)]);
  const CompiledModel model{body.skeleton, units};
  PoseTable postures{kChunk, static_cast<std::size_t>(model.coordinateCount())}, lengths_m;
  for (std::size_t first = 0; first < joint.samples.size(); first += kChunk) {
    read(joint, first, postures);
    batchLengths(model, postures, lengths_m, Precision::Single);
    measured(first, std::min(kChunk, joint.samples.size() - first), lengths_m);
  }
}

void RangeSamples::read(const JointRangeSamples& joint, std::size_t first, PoseTable& table) const {
  for (std::size_t i = 0; i < table.poseCount() && first + i < joint.samples.size(); ++i) {
    const JointRangeSamples::Sample& sample = joint.samples[first + i];
    table.set(i, others_[sample.others]);
    for (int k = 0; k < joint.coordinate_count; ++k)
      table(i, static_cast<std::size_t>(joint.first_coordinate + k)) = sample.own[k];
  }
}

}  // namespace sinew
