#include "core/rom/poses/pose_sampler.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "core/angle.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

constexpr double kTolerance_rad = 1e-9;

/// Halton sequence with digits permuted by the seed (plain Halton lines up in high dimensions).
class ScrambledHalton {
 public:
  ScrambledHalton(int dimensions, unsigned seed) {
    std::mt19937 random{seed};
    for (int candidate = 2; static_cast<int>(bases_.size()) < dimensions; ++candidate) {
      if (std::ranges::any_of(bases_, [&](const Base& b) { return candidate % b.prime == 0; })) continue;
      Base base{candidate, std::vector<int>(static_cast<std::size_t>(candidate))};
      std::iota(base.digit.begin(), base.digit.end(), 0);
      for (int i = candidate - 1; i > 1; --i)  // own shuffle: the library's differs between compilers; 0 stays 0
        std::swap(base.digit[i], base.digit[1 + random() % static_cast<unsigned>(i)]);
      bases_.push_back(std::move(base));
    }
  }

  /// Coordinate in [0, 1) of point `index` >= 1.
  double operator()(int index, int dimension) const {
    const Base& base = bases_[static_cast<std::size_t>(dimension)];
    double value = 0, place = 1;
    for (int i = index; i > 0; i /= base.prime) value += (place /= base.prime) * base.digit[i % base.prime];
    return value;
  }

 private:
  struct Base {
    int prime;
    std::vector<int> digit;
  };
  std::vector<Base> bases_;
};

/// The cube [-1, 1]^n on the ball, radially.
Eigen::VectorXd intoBall(const Eigen::VectorXd& cube) {
  const double norm = cube.norm();
  return norm > 0 ? Eigen::VectorXd{cube * (cube.lpNorm<Eigen::Infinity>() / norm)} : cube;
}

/// Ranges by coordinate index and couplings of both sides.
class Domain {
 public:
  Domain(const Skeleton& skeleton, const RomPreset& preset) : skeleton_{&skeleton} {
    min_ = max_ = Eigen::VectorXd::Zero(skeleton.coordinateCount());
    for (const SidedBound& b : sidedBounds(skeleton, preset)) {
      const auto [coordinate, factor] = b.terms.front();
      if (b.terms.size() > 1)
        couplings_.push_back(b);
      else
        (factor > 0 ? max_ : min_)[coordinate] = factor * b.limit_rad;
    }
  }

  /// x in [-1, 1]: lower limit .. neutral .. upper limit for a ball joint, the interval for a hinge.
  double value(int coordinate, bool hinge, double x) const {
    const double low = min_[coordinate], high = max_[coordinate];
    if (hinge) return low + 0.5 * (1 + x) * (high - low);
    return x < 0 ? -x * low : x * high;
  }

  bool allows(const Eigen::VectorXd& clinical) const {
    for (const SidedBound& c : couplings_)
      if (c.excess_rad(clinical) > kTolerance_rad) return false;
    for (Eigen::Index i = 0; i < clinical.size(); ++i) {
      if (skeleton_->joints[skeleton_->coordinates[i].joint].type == JointType::Free) continue;
      if (clinical[i] < min_[i] - kTolerance_rad || clinical[i] > max_[i] + kTolerance_rad) return false;
    }
    return true;
  }

  double min(int coordinate) const { return min_[coordinate]; }
  double max(int coordinate) const { return max_[coordinate]; }

 private:
  const Skeleton* skeleton_;
  Eigen::VectorXd min_, max_;
  std::vector<SidedBound> couplings_;
};

bool nearGimbalLock(const Skeleton& skeleton, const Eigen::VectorXd& clinical) {
  constexpr double kLeastCosine = 0.02;
  return std::ranges::any_of(skeleton.joints, [&](const Joint& joint) {
    return joint.type == JointType::Ball && std::abs(std::cos(clinical[joint.first_coordinate + 1])) < kLeastCosine;
  });
}

/// Every bound at its limit: so that the fit does not hang on where the sample happens to fall.
std::vector<Eigen::VectorXd> ends(const Skeleton& skeleton, const RomPreset& preset,
                                  const std::vector<ClinicalTest>& tests, const Domain& domain) {
  std::vector<Eigen::VectorXd> result;
  const auto add = [&](const Eigen::VectorXd& clinical) {
    if (domain.allows(clinical) && !nearGimbalLock(skeleton, clinical)) result.push_back(clinical);
  };
  for (const RomBound& bound : preset.bounds) {
    Eigen::VectorXd clinical = Eigen::VectorXd::Zero(skeleton.coordinateCount());
    const auto test = std::ranges::find(tests, bound.test, &ClinicalTest::id);
    if (test != tests.end()) clinical = clinicalFromPosture(skeleton, test->posture(skeleton, 'r'));
    const SidedBound b = sidedBound(skeleton, bound, 'r');
    const auto [first, factor] = b.terms[0];
    // The first coordinate goes to where the bound is met; the second, if there is one, over its range.
    const auto meet = [&] {
      clinical[first] -= b.excess_rad(clinical) / factor;
      add(clinical);
    };
    meet();
    constexpr int kSteps = 12;
    if (b.terms.size() > 1)
      for (int i = 0; i <= kSteps; ++i) {
        const int second = b.terms[1].first;
        clinical[second] = std::lerp(domain.min(second), domain.max(second), double(i) / kSteps);
        meet();
      }
  }
  return result;
}

/// Collects postures with their mirror images into blocks.
class Blocks {
 public:
  Blocks(const Skeleton& skeleton, const PoseVisitor& visit) : mirror_{skeleton}, visit_{visit} {
    block_.resize(skeleton.coordinateCount(), kPoseBlock);
  }
  void add(const Posture& q) {
    block_.col(filled_++) = q;
    block_.col(filled_++) = mirror_(q);
    count_ += 2;
    if (filled_ == kPoseBlock) flush();
  }
  void flush() {
    if (filled_ > 0) visit_(block_.leftCols(filled_));
    filled_ = 0;
  }
  int count() const { return count_; }

 private:
  PoseMirror mirror_;
  const PoseVisitor& visit_;
  Eigen::MatrixXd block_;
  int filled_ = 0, count_ = 0;
};

/// Single precision, as pose sets store it: what is fitted and what is stored are the same postures.
Posture rounded(const Posture& q) {
  return q.cast<float>().cast<double>();
}

}  // namespace

void samplePoses(const Skeleton& skeleton, const RomPreset& preset, const std::vector<ClinicalTest>& tests,
                 const PoseSampleOptions& options, const PoseVisitor& visit) {
  const Domain domain{skeleton, preset};
  Blocks blocks{skeleton, visit};
  for (const Eigen::VectorXd& end : ends(skeleton, preset, tests, domain))
    blocks.add(rounded(postureFromClinical(skeleton, end)));

  const ScrambledHalton halton{skeleton.coordinateCount(), options.seed};
  for (int index = 1; blocks.count() < options.count; ++index) {
    Eigen::VectorXd clinical = Eigen::VectorXd::Zero(skeleton.coordinateCount());
    int dimension = 0;
    for (const Joint& joint : skeleton.joints) {
      if (joint.type == JointType::Free) continue;
      Eigen::VectorXd x(joint.coordinate_count);
      for (double& u : x) u = 2 * halton(index, dimension++) - 1;
      x = intoBall(x);
      for (int i = 0; i < joint.coordinate_count; ++i)
        clinical[joint.first_coordinate + i] =
            domain.value(joint.first_coordinate + i, joint.type == JointType::Revolute, x[i]);
    }
    if (domain.allows(clinical) && !nearGimbalLock(skeleton, clinical))
      blocks.add(rounded(postureFromClinical(skeleton, clinical)));
  }
  blocks.flush();
}

PoseSet sampledPoseSet(const Skeleton& skeleton, const RomPreset& preset, const std::vector<ClinicalTest>& tests,
                       const PoseSampleOptions& options) {
  PoseSet set{skeleton, "synthetic, preset " + preset.name + ", seed " + std::to_string(options.seed)};
  samplePoses(skeleton, preset, tests, options, [&](const Eigen::MatrixXd& postures) {
    for (Eigen::Index i = 0; i < postures.cols(); ++i) set.add(postures.col(i));
  });
  return set;
}

std::vector<Posture> normalPostures(const Skeleton& skeleton, int count, std::uint32_t seed) {
  RomPreset normal{.name = "normal limits"};
  for (const Coordinate& c : skeleton.coordinates) {
    if (skeleton.joints[c.joint].type == JointType::Free || c.name.ends_with("_l")) continue;
    const std::string name{withoutSide(c.name)};
    normal.bounds.push_back({.terms = {{name, 1}}, .end_deg = c.normal_max_rad / kRadPerDeg});
    normal.bounds.push_back({.terms = {{name, -1}}, .end_deg = -c.normal_min_rad / kRadPerDeg});
  }
  std::vector<Posture> postures;
  samplePoses(skeleton, normal, {}, {.count = 2 * (count + static_cast<int>(normal.bounds.size())), .seed = seed},
              [&](const Eigen::MatrixXd& block) {
                for (Eigen::Index i = 0; i < block.cols(); i += 2) postures.push_back(block.col(i));
              });
  postures.erase(postures.begin(), postures.end() - std::min<std::ptrdiff_t>(count, std::ssize(postures)));
  return postures;
}

std::vector<Posture> restingPostures(const Skeleton& skeleton) {
  // Neutral body posture: NASA Man-Systems Integration Standards 3000; arms: two thirds of 90 deg in the shoulder,
  // the rest in the girdle (Inman 1944).
  std::map<std::string, double> weightless, sideways;
  for (const std::string side : {"_r", "_l"}) {
    for (const auto& [name, deg] : std::map<std::string, double>{{"hip_flexion", 50},
                                                                 {"knee_flexion", 50},
                                                                 {"ankle_dorsiflexion", -20},
                                                                 {"shoulder_flexion", 35},
                                                                 {"shoulder_adduction", -35},
                                                                 {"elbow_flexion", 60}})
      weightless[name + side] = deg;
    sideways["shoulder_adduction" + side] = -67;
    sideways["girdle_elevation" + side] = 23;
  }
  return {zeroPosture(skeleton), postureFromDegrees(skeleton, weightless), postureFromDegrees(skeleton, sideways)};
}

}  // namespace sinew
