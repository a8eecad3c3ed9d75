#include "core/rom/pose_sample.h"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <random>

#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

constexpr double kDegPerRad = 180 / std::numbers::pi;

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

bool isSampled(const Coordinate& c) {
  return !c.name.starts_with("pelvis_") && !c.name.ends_with("_l") && !c.translational;
}

int rightIndex(const Skeleton& skeleton, std::string name) {
  if (name.starts_with("-")) name.erase(0, 1);
  return skeleton.coordinateIndex(name + "_r");
}

bool isAllowed(const Skeleton& skeleton, const Eigen::VectorXd& clinical) {
  constexpr double kTolerance_deg = 1e-6;
  return std::ranges::all_of(normalPoseCouplings(), [&](const PoseCoupling& c) {
    const double sign = c.first.starts_with("-") ? -1 : 1;
    const double left =
        sign * clinical[rightIndex(skeleton, c.first)] + c.slope * clinical[rightIndex(skeleton, c.second)];
    return left * kDegPerRad <= c.limit_deg + kTolerance_deg;
  });
}

/// The cube [-1, 1]^n on the ball, radially.
Eigen::VectorXd intoBall(const Eigen::VectorXd& cube) {
  const double norm = cube.norm();
  return norm > 0 ? Eigen::VectorXd{cube * (cube.lpNorm<Eigen::Infinity>() / norm)} : cube;
}

/// -1 .. 0 .. 1 to lower limit .. neutral .. upper limit. Hinges have no neutral inside: -1 .. 1 to the interval.
double withinLimits(const Coordinate& c, bool hinge, double x) {
  if (hinge) return c.normal_min_rad + 0.5 * (1 + x) * (c.normal_max_rad - c.normal_min_rad);
  return x < 0 ? -x * c.normal_min_rad : x * c.normal_max_rad;
}

/// Ends of clinical tests: what must be possible, so that the fit does not hang on where the sample happens to fall.
std::vector<Eigen::VectorXd> testEnds(const Skeleton& skeleton) {
  const std::vector<std::map<std::string, double>> ends_deg{
      {{"hip_flexion_r", 86}},                            // straight-leg raise
      {{"hip_flexion_r", 90}, {"knee_flexion_r", 8}},     // popliteal angle
      {{"hip_flexion_r", 120}, {"knee_flexion_r", 120}},  // Thomas, the flexed leg
      {{"hip_flexion_r", -20}},                           // Staheli
      {{"hip_flexion_r", -5}, {"knee_flexion_r", 90}},    // prone extension with bent knee
      {{"knee_flexion_r", 125}},                          // Duncan-Ely
      {{"hip_flexion_r", 90}, {"knee_flexion_r", 140}},
      {{"ankle_dorsiflexion_r", 12}},  // Silfverskioeld, straight
      {{"ankle_dorsiflexion_r", 20}, {"knee_flexion_r", 90}}};
  std::vector<Eigen::VectorXd> ends;
  for (const auto& end : ends_deg) ends.push_back(clinicalFromPosture(skeleton, postureFromDegrees(skeleton, end)));
  for (int i = 0; i < skeleton.coordinateCount(); ++i) {
    if (!isSampled(skeleton.coordinates[i])) continue;
    for (const double limit : {skeleton.coordinates[i].normal_min_rad, skeleton.coordinates[i].normal_max_rad}) {
      ends.emplace_back(Eigen::VectorXd::Zero(skeleton.coordinateCount()));
      ends.back()[i] = limit;
    }
  }
  return ends;
}

}  // namespace

const std::vector<PoseCoupling>& normalPoseCouplings() {
  static const std::vector<PoseCoupling> couplings{
      {"hip_flexion", -0.5, "knee_flexion", 86,
       "hamstrings: straight-leg raise 74 (Youdas 2005) and popliteal angle 33 at hip 90 (Youdas 2005), both at the "
       "end "
       "an examiner feels; the fibre's longest length is a little beyond it"},
      {"knee_flexion", -6, "hip_flexion", 125,
       "rectus femoris: Duncan-Ely 125 (Kendall), knee 53 with the hip 12 extended (Harvey 1998)"},
      {"ankle_dorsiflexion", -0.4, "knee_flexion", 12,
       "gastrocnemius: Silfverskioeld 10 and 21, plateau at 20 to 30 of knee flexion (DiGiovanni 2002, Baumbach "
       "2014)"},
      {"-hip_adduction", -0.07, "knee_flexion", 39,
       "gracilis: abduction 39 with straight knee (Roaas 1982), 45 with bent"},
      {"hip_adduction", -1, "hip_flexion", 20,
       "iliotibial tract: modified Ober 15 with the hip 5 extended (Reese 2003)"}};
  return couplings;
}

std::vector<Posture> normalPostures(const Skeleton& skeleton, int random_count, unsigned seed) {
  std::vector<Posture> postures;
  for (const Eigen::VectorXd& end : testEnds(skeleton))
    if (isAllowed(skeleton, end)) postures.push_back(postureFromClinical(skeleton, end));

  const ScrambledHalton halton{skeleton.coordinateCount(), seed};
  const std::size_t wanted = postures.size() + static_cast<std::size_t>(random_count);
  for (int index = 1; postures.size() < wanted; ++index) {
    Eigen::VectorXd clinical = Eigen::VectorXd::Zero(skeleton.coordinateCount());
    int dimension = 0;
    for (const Joint& joint : skeleton.joints) {
      if (!isSampled(skeleton.coordinates[joint.first_coordinate])) continue;
      Eigen::VectorXd x(joint.coordinate_count);
      for (double& u : x) u = 2 * halton(index, dimension++) - 1;
      x = intoBall(x);
      for (int i = 0; i < joint.coordinate_count; ++i)
        clinical[joint.first_coordinate + i] =
            withinLimits(skeleton.coordinates[joint.first_coordinate + i], joint.coordinate_count == 1, x[i]);
    }
    if (isAllowed(skeleton, clinical)) postures.push_back(postureFromClinical(skeleton, clinical));
  }
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
