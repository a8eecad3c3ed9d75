#include "core/skeleton/fit/fit_movement_internal.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/angle.h"
#include "core/text.h"

namespace sinew {
namespace {

constexpr double kTwoSided95 = 1.959964;
constexpr double kMm = 1000;
constexpr double kLeastTurn_deg = 0.5, kLeastSway_mm = 2;  // what is worth a word, if it is certain

/// Length of a vector whose entries have `sd`, with the interval along its own direction.
ExposureMovement::Amount amountOf(const Eigen::VectorXd& standardized, const Eigen::MatrixXd& covariance, double sd) {
  const double length = standardized.norm();
  const Eigen::VectorXd along =
      length > 0 ? Eigen::VectorXd{standardized / length} : Eigen::VectorXd::Unit(standardized.size(), 0);
  const double half = kTwoSided95 * std::sqrt(along.dot(covariance * along));
  return {sd * length, sd * std::max(0.0, length - half), sd * (length + half)};
}

/// A pattern of bending: coordinates with their shares.
struct BendPattern {
  std::vector<std::string> joints;
  std::map<std::string, double> shares;  ///< by coordinate
  double needed_sigmas;                  ///< before it is believed
};

/// A joint by itself is one of many hypotheses: a chance of 1 in 7000 each. That both knees give is what patients do.
constexpr double kSingleJoint_sigmas = 3.8, kBothKnees_sigmas = 2.8;
/// Less is how anybody stands, and within the prior.
constexpr double kLeastBend_rad = 2 * kRadPerDeg;

std::vector<BendPattern> bendPatterns() {
  std::vector<BendPattern> patterns;
  for (const char* single : {"hip_flexion", "hip_adduction", "hip_internal_rotation", "knee_flexion",
                             "ankle_dorsiflexion", "ankle_inversion", "ankle_internal_rotation"})
    for (const std::string side : {"_r", "_l"}) {
      const std::string name = single;
      patterns.push_back({{name.substr(0, name.find('_')) + side}, {{name + side, 1}}, kSingleJoint_sigmas});
    }
  const auto crouch = [](const std::string& side, std::map<std::string, double>& shares) {
    shares["hip_flexion" + side] = shares["ankle_dorsiflexion" + side] = 0.5;
    shares["knee_flexion" + side] = 1;
  };
  for (const std::string side : {"_r", "_l"}) {
    BendPattern leg{{"knee" + side}, {}, kSingleJoint_sigmas};
    crouch(side, leg.shares);
    patterns.push_back(leg);
  }
  BendPattern both{{"knee_r", "knee_l"}, {}, kBothKnees_sigmas};
  crouch("_r", both.shares);
  crouch("_l", both.shares);
  patterns.push_back(both);
  patterns.push_back({{"knee_r", "knee_l"}, {{"knee_flexion_r", 1}, {"knee_flexion_l", 1}}, kBothKnees_sigmas});
  return patterns;
}

/// The pattern as a direction among the changes of an exposure, per radian; empty if a share of it cannot be seen.
Eigen::VectorXd directionOf(const BendPattern& pattern, const Skeleton& skeleton, const Nuisances& nuisances,
                            int exposure) {
  const auto changes = nuisances.jointChanges(exposure);
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(changes.size()));
  for (const auto& [name, share] : pattern.shares) {
    const Coordinate& coordinate = skeleton.coordinates[skeleton.coordinateIndex(name)];
    bool seen = false;
    for (std::size_t i = 0; i < changes.size(); ++i) {
      const double along = changes[i].joint == coordinate.joint ? changes[i].axis.dot(coordinate.axis) : 0;
      if (std::abs(along) < 1e-9) continue;
      direction[static_cast<Eigen::Index>(i)] += share * along / nuisances.jointSd_rad();
      seen = true;
    }
    if (!seen) return {};
  }
  return direction;
}

std::string withInterval(const ExposureMovement::Amount& amount, int decimals, const std::string& unit) {
  const auto text = [&](double value) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.*f", decimals, value);
    return std::string{digits};
  };
  return text(amount.value) + " " + unit + " (" + text(amount.lower95) + "-" + text(amount.upper95) + ")";
}

}  // namespace

std::optional<LegBend> likeliestBend(const Skeleton& skeleton, const Nuisances& nuisances, const Eigen::VectorXd& y,
                                     const Eigen::MatrixXd& covariance) {
  std::optional<LegBend> likeliest;
  const auto patterns = bendPatterns();
  for (int e = 1; e < nuisances.exposureCount(); ++e) {
    std::vector<int> entries;
    for (const auto& change : nuisances.jointChanges(e)) entries.push_back(change.y);
    if (entries.empty()) continue;
    // With a prior of SD 1, the images alone say information P^-1 - 1 and score P^-1 y at y = 0.
    const Eigen::LLT<Eigen::MatrixXd> root{covariance(entries, entries)};
    const Eigen::VectorXd score = root.solve(y(entries));
    for (const BendPattern& pattern : patterns) {
      const Eigen::VectorXd direction = directionOf(pattern, skeleton, nuisances, e);
      if (direction.size() == 0) continue;
      const double information = direction.dot(root.solve(direction)) - direction.squaredNorm();
      if (!(information > 1e-6 * direction.squaredNorm())) continue;
      const double along = direction.dot(score), sigmas = std::abs(along) / std::sqrt(information);
      const double angle_rad = along / information;
      if (sigmas < pattern.needed_sigmas || std::abs(angle_rad) < kLeastBend_rad) continue;
      if (!likeliest || sigmas > likeliest->sigmas) likeliest = {e, pattern.joints, angle_rad, sigmas};
    }
  }
  return likeliest;
}

std::vector<ExposureMovement> describeMovements(const Skeleton& skeleton, std::span<const FitView> views,
                                                const Nuisances& nuisances, const Eigen::VectorXd& y,
                                                const Eigen::MatrixXd& covariance,
                                                const std::optional<LegBend>& bend) {
  std::vector<ExposureMovement> movements;
  const MovementPrior& prior = nuisances.movementPrior();
  for (int e = 1; e < nuisances.exposureCount(); ++e) {
    ExposureMovement movement;
    for (std::size_t v = 0; v < views.size(); ++v)
      if (nuisances.exposureOf(static_cast<int>(v)) == e) movement.exposure = views[v].exposure;
    const int first = nuisances.movementBegin(e);
    movement.turn_deg =
        amountOf(y.segment<3>(first), covariance.block<3, 3>(first, first), prior.turn_rad / kRadPerDeg);
    movement.sway_mm =
        amountOf(y.segment<3>(first + 3), covariance.block<3, 3>(first + 3, first + 3), kMm * prior.shift_m);
    movement.moved = movement.turn_deg.lower95 > kLeastTurn_deg || movement.sway_mm.lower95 > kLeastSway_mm;
    std::map<int, std::vector<int>> entries_of;  // of y, by joint
    for (const auto& change : nuisances.jointChanges(e)) entries_of[change.joint].push_back(change.y);
    for (const auto& [joint, entries] : entries_of) {
      const Eigen::VectorXd estimate = y(entries);
      const Eigen::MatrixXd spread = covariance(entries, entries);
      const std::string& name = skeleton.joints[joint].name;
      movement.joints.push_back({name, amountOf(estimate, spread, prior.joint_rad / kRadPerDeg),
                                 bend && bend->exposure == e && std::ranges::count(bend->joints, name) > 0});
    }
    movements.push_back(std::move(movement));
  }
  return movements;
}

void warnOfMovement(const std::vector<ExposureMovement>& movements, Warnings& warnings) {
  for (const ExposureMovement& movement : movements) {
    std::vector<const ExposureMovement::JointChange*> moved;
    for (const auto& joint : movement.joints)
      if (joint.moved) moved.push_back(&joint);
    std::ranges::sort(moved, [](auto* a, auto* b) { return a->turn_deg.value > b->turn_deg.value; });
    std::string names;
    for (const auto* joint : moved) {
      const std::string side = joint->joint.ends_with("_r") ? "right " : joint->joint.ends_with("_l") ? "left " : "";
      names += (names.empty() ? "the " : ", the ") + side + joint->joint.substr(0, joint->joint.find('_')) + " by " +
               withInterval(joint->turn_deg, 1, "deg");
    }
    if (!names.empty())
      warnings.push_back({"joint_moved", "the posture changed between the exposures: " + names +
                                             ". The figures allow for it and are those of the first exposure"});
    if (movement.moved)
      warnings.push_back({"patient_moved", "the patient turned by " + withInterval(movement.turn_deg, 1, "deg") +
                                               " and swayed by " + withInterval(movement.sway_mm, 0, "mm") +
                                               " between the exposures. The figures allow for it"});
  }
}

}  // namespace sinew
