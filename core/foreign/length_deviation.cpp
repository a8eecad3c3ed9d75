#include "core/foreign/length_deviation.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/foreign/foreign_from_model.h"
#include "core/muscle/muscle_path.h"
#include "core/rom/poses/pose_sampler.h"
#include "core/rom/poses/range_postures.h"
#include "core/skeleton/clinical_angles.h"

namespace sinew {
namespace {

constexpr double kExact_m = 1e-4;
constexpr double kStep_deg = 10;
constexpr int kRandomPostures = 100;

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Absolute differences: [unit][posture].
std::vector<std::vector<double>> differences(const Model& model, const std::vector<Posture>& postures,
                                             const std::function<Eigen::VectorXd(const Posture&)>& theirs) {
  const auto& units = model.musculature.units;
  std::vector<std::vector<double>> off_m(units.size());
  for (const Posture& q : postures) {
    const auto X_WB = segmentPoses(model.skeleton, q);
    const Eigen::VectorXd length_m = theirs(q);
    for (std::size_t u = 0; u < units.size(); ++u)
      off_m[u].push_back(std::abs(length_m[static_cast<Eigen::Index>(u)] - pathLength(units[u], X_WB)));
  }
  return off_m;
}

std::string lengthsText(const LengthDeviation& deviation) {
  if (deviation.units.empty()) return "no muscles";
  const UnitDeviation& worst = deviation.worst();
  std::string text = fmt::format(
      "Lengths against the original over {} postures of the adult norm and {} random ones: {} of {} muscles within "
      "0.1 mm",
      deviation.norm_postures, deviation.random_postures, deviation.exactUnits(), deviation.units.size());
  if (!worst.isExact())
    text += fmt::format("; the others deviate by up to {:.1f} mm in the median, {:.1f} mm at most ({})",
                        1000 * deviation.medianOfMaxima_m(), 1000 * std::max(worst.max_norm_m, worst.max_random_m),
                        worst.unit);
  return text;
}

std::string boxedRangesText(const LengthDeviation& deviation) {
  std::string names;
  for (const std::string& joint : deviation.boxed_ranges) names += (names.empty() ? "" : ", ") + joint;
  return names.empty() ? names : "; edited ranges are exported as the box of clinical angles about them: " + names;
}

}  // namespace

bool UnitDeviation::isExact() const {
  return std::max(max_norm_m, max_random_m) < kExact_m;
}

int LengthDeviation::exactUnits() const {
  return static_cast<int>(std::ranges::count_if(units, &UnitDeviation::isExact));
}

double LengthDeviation::medianOfMaxima_m() const {
  std::vector<double> maxima;
  for (const auto& u : units)
    if (!u.isExact()) maxima.push_back(std::max(u.max_norm_m, u.max_random_m));
  return median(maxima);
}

const UnitDeviation& LengthDeviation::worst() const {
  require(!units.empty(), "a model with units");
  return *std::ranges::max_element(units, {},
                                   [](const UnitDeviation& u) { return std::max(u.max_norm_m, u.max_random_m); });
}

LengthDeviation lengthDeviation(const Model& model, const std::function<Eigen::VectorXd(const Posture&)>& theirs) {
  const auto sweeps = rangePostures(model.skeleton, kStep_deg, 0);
  const auto random = normalPostures(model.skeleton, kRandomPostures);
  const auto norm_off_m = differences(model, sweeps, theirs), random_off_m = differences(model, random, theirs);
  LengthDeviation deviation{static_cast<int>(sweeps.size()), static_cast<int>(random.size()), {}, {}, {}};
  for (std::size_t u = 0; u < model.musculature.units.size(); ++u) {
    const MusculotendonUnit& unit = model.musculature.units[u];
    UnitDeviation of{.unit = unit.name};
    for (const PathPoint& p : unit.path) {
      of.blended = of.blended || p.anchors.size() > 1;
      for (const Anchor& a : p.anchors)
        of.on_driven = of.on_driven || a.segment >= model.skeleton.movingSegmentCount();
    }
    of.median_norm_m = median(norm_off_m[u]);
    of.max_norm_m = std::ranges::max(norm_off_m[u]);
    of.median_random_m = median(random_off_m[u]);
    of.max_random_m = std::ranges::max(random_off_m[u]);
    deviation.units.push_back(of);
  }
  return deviation;
}

LengthDeviation lengthDeviation(const Model& model, const ForeignModel& foreign) {
  std::vector<int> coordinate, unit;
  for (const auto& c : model.skeleton.coordinates) coordinate.push_back(foreign.coordinateIndex(c.name));
  for (const auto& u : model.musculature.units) unit.push_back(foreign.musculature.unitIndex(u.name));
  LengthDeviation deviation = lengthDeviation(model, [&](const Posture& posture) {
    const Eigen::VectorXd clinical = clinicalFromPosture(model.skeleton, posture);
    ForeignPosture q = defaultPosture(foreign);
    for (std::size_t i = 0; i < coordinate.size(); ++i) q[coordinate[i]] = clinical[static_cast<Eigen::Index>(i)];
    const Eigen::VectorXd theirs_m = foreignLengths(foreign, q);
    Eigen::VectorXd length_m(static_cast<Eigen::Index>(unit.size()));
    for (std::size_t u = 0; u < unit.size(); ++u) length_m[static_cast<Eigen::Index>(u)] = theirs_m[unit[u]];
    return length_m;
  });
  for (const Joint& joint : model.skeleton.joints)
    if (!joint.edited.steps.empty()) deviation.boxed_ranges.push_back(joint.name);
  deviation.structures = structureDeviation(model, foreign);
  return deviation;
}

std::string summaryText(const LengthDeviation& deviation) {
  return lengthsText(deviation) + (deviation.structures ? "; " + summaryText(*deviation.structures) : "") +
         boxedRangesText(deviation);
}

}  // namespace sinew
