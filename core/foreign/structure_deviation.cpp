#include "core/foreign/structure_deviation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/random_source.h"

namespace sinew {
namespace {

constexpr double kExact_Nm = 1e-6;
constexpr int kSteps = 24, kRandom = 100;
constexpr std::uint64_t kSeed = 53;

bool isJoint(const Skeleton& skeleton, const Coordinate& c) {
  return skeleton.joints[static_cast<std::size_t>(c.joint)].type != JointType::Free;
}

Eigen::VectorXd randomClinical(const Skeleton& skeleton, RandomSource& random) {
  Eigen::VectorXd clinical = Eigen::VectorXd::Zero(skeleton.coordinateCount());
  for (int i = 0; i < skeleton.coordinateCount(); ++i) {
    const Coordinate& c = skeleton.coordinates[static_cast<std::size_t>(i)];
    if (isJoint(skeleton, c)) clinical[i] = random.uniform(c.stop_min_rad, c.stop_max_rad);
  }
  return clinical;
}

}  // namespace

bool StructureDeviation::isExact() const {
  return std::max(alone_Nm, random_Nm) < kExact_Nm;
}

StructureDeviation structureDeviation(const Model& model,
                                      const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& theirs) {
  const Skeleton& skeleton = model.skeleton;
  StructureDeviation deviation;
  if (model.passive_moments.empty()) return deviation;
  const auto differences = [&](const Eigen::VectorXd& clinical) -> Eigen::VectorXd {
    Eigen::VectorXd ours = Eigen::VectorXd::Zero(clinical.size());
    for (Eigen::Index i = 0; i < ours.size(); ++i)
      ours[i] = passiveMoment_Nm(model.passive_moments[static_cast<std::size_t>(i)], clinical[i]);
    return (theirs(clinical) - ours).cwiseAbs();
  };
  for (int i = 0; i < skeleton.coordinateCount(); ++i) {
    const Coordinate& c = skeleton.coordinates[static_cast<std::size_t>(i)];
    const PassiveMoment& m = model.passive_moments[static_cast<std::size_t>(i)];
    for (int k = 0; isJoint(skeleton, c) && k <= kSteps; ++k) {
      Eigen::VectorXd clinical = Eigen::VectorXd::Zero(skeleton.coordinateCount());
      clinical[i] = std::lerp(c.stop_min_rad, c.stop_max_rad, double(k) / kSteps);
      const double off_Nm = differences(clinical)[i];
      deviation.alone_share = std::max(deviation.alone_share, off_Nm / std::max(m.upper_Nm, m.lower_Nm));
      if (off_Nm <= deviation.alone_Nm) continue;
      deviation.alone_Nm = off_Nm;
      deviation.alone_coordinate = c.name;
    }
  }
  RandomSource random{kSeed};
  for (int k = 0; k < kRandom; ++k) {
    Eigen::Index worst = 0;
    const double off_Nm = differences(randomClinical(skeleton, random)).maxCoeff(&worst);
    if (off_Nm <= deviation.random_Nm) continue;
    deviation.random_Nm = off_Nm;
    deviation.random_coordinate = skeleton.coordinates[static_cast<std::size_t>(worst)].name;
  }
  return deviation;
}

StructureDeviation structureDeviation(const Model& model, const ForeignModel& foreign) {
  return structureDeviation(model, [&](const Eigen::VectorXd& clinical) {
    Eigen::VectorXd moments_Nm = Eigen::VectorXd::Zero(clinical.size());
    for (const ForeignCoordinateForce& force : foreign.coordinate_forces) {
      const int i =
          model.skeleton.coordinateIndex(foreign.coordinates[static_cast<std::size_t>(force.coordinate)].name);
      moments_Nm[i] += coordinateForce(force, clinical[i]);
    }
    return moments_Nm;
  });
}

std::string summaryText(const StructureDeviation& d) {
  if (d.isExact()) return "capsules and ligaments exactly";
  char text[240];
  std::snprintf(text, sizeof text,
                "capsules and ligaments within %.1f N m with one coordinate moved (%s; %.1f %% of the moment at its "
                "stop at most), %.0f N m with all of a joint (%s)",
                d.alone_Nm, d.alone_coordinate.c_str(), 100 * d.alone_share, d.random_Nm,
                d.random_coordinate.c_str());
  return text;
}

}  // namespace sinew
