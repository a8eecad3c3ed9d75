#include "core/model/physical_scaling.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/muscle/muscle_path.h"
#include "core/muscle/unit_selection.h"
#include "core/skeleton/shape/deformed_inertia.h"
#include "core/skeleton/shape/field_derivatives.h"

namespace sinew {
namespace {

/// Change of a small area across the direction t_W at one path point.
double areaScale(const Skeleton& reference, const PathPoint& point, const Eigen::Vector3d& t_W,
                 const std::vector<RigidTransform>& X_WB, const std::vector<double>& parameters) {
  double scale = 0;
  for (const Anchor& a : point.anchors) {
    const Eigen::Matrix3d J = fieldJacobian(reference, parameters, a.segment, a.p_B);
    const Eigen::Vector3d t_B = X_WB[std::size_t(a.segment)].linear().transpose() * t_W;
    scale += a.weight * J.determinant() * J.transpose().partialPivLu().solve(t_B).norm();
  }
  return scale;
}

double crossSectionScale(const Skeleton& reference, const MusculotendonUnit& unit,
                         const std::vector<double>& parameters, const std::vector<RigidTransform>& X_WB) {
  const auto points = pathPoints(unit, X_WB);
  double sum = 0, length_m = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double piece_m = (points[i + 1] - points[i]).norm();
    if (!(piece_m > 0)) continue;
    const Eigen::Vector3d t_W = (points[i + 1] - points[i]) / piece_m;
    for (const std::size_t end : {i, i + 1})
      sum += 0.5 * piece_m * areaScale(reference, unit.path[end], t_W, X_WB, parameters);
    length_m += piece_m;
  }
  return length_m > 0 ? sum / length_m : 1;
}

/// Factor that takes the mass of the deformed volume to the wanted one.
double massFactor(const std::string& segment, double deformed_kg, double reference_kg,
                  const PhysicsFactors& factors) {
  const auto factor = factors.mass_factors.find(segment), ratio = factors.mass_ratios.find(segment);
  if (ratio != factors.mass_ratios.end()) return ratio->second * reference_kg / deformed_kg;
  return factor != factors.mass_factors.end() ? factor->second : 1;
}

/// Stops of the age; those that are not where the age before had put them were moved by a person and stay.
void setStopsOfAge(Skeleton& skeleton, const Model& reference, const std::optional<double>& before_years,
                   const std::optional<double>& age_years) {
  Skeleton before = reference.skeleton, now = reference.skeleton;
  if (before_years) widenStops(before, reference.laxity, *before_years);
  if (age_years) widenStops(now, reference.laxity, *age_years);
  constexpr double kSame_rad = 1e-9;  // a model file keeps every digit
  for (std::size_t i = 0; i < skeleton.coordinates.size(); ++i) {
    Coordinate& c = skeleton.coordinates[i];
    const Coordinate &was = before.coordinates[i], &is = now.coordinates[i];
    if (std::abs(c.stop_min_rad - was.stop_min_rad) < kSame_rad) c.stop_min_rad = is.stop_min_rad;
    if (std::abs(c.stop_max_rad - was.stop_max_rad) < kSame_rad) c.stop_max_rad = is.stop_max_rad;
  }
}

void checkSegments(const Skeleton& skeleton, const PhysicsFactors& factors) {
  for (const auto* named : {&factors.mass_factors, &factors.mass_ratios})
    for (const auto& [segment, factor] : *named)
      if (skeleton.segmentIndex(segment) >= skeleton.movingSegmentCount())
        throw InputError{{"mass", segment, "a segment that carries mass", "a driven one"}};
  for (const auto& [segment, factor] : factors.mass_factors)
    if (factors.mass_ratios.contains(segment)) throw InputError{{"mass", segment, "a factor or a ratio", "both"}};
}

}  // namespace

double crossSectionScale(const Skeleton& reference, const MusculotendonUnit& unit,
                         const std::vector<double>& parameters) {
  return crossSectionScale(reference, unit, parameters, segmentPoses(reference, zeroPosture(reference)));
}

Model withPhysics(const Model& model, const Model& reference, const PhysicsFactors& factors) {
  checkSegments(model.skeleton, factors);
  const std::vector<double> parameters = toVector(model.shape);
  Model result = model;
  result.physics = factors;
  const auto deformed = deformedInertias(reference.skeleton, parameters);
  for (int i = 0; i < result.skeleton.movingSegmentCount(); ++i) {
    Segment& segment = result.skeleton.segments[std::size_t(i)];
    const auto at = std::size_t(reference.skeleton.segmentIndex(segment.name));
    const double factor =
        massFactor(segment.name, deformed[at].mass_kg, reference.skeleton.segments[at].mass_kg, factors);
    segment.mass_kg = factor * deformed[at].mass_kg;
    segment.p_BCom = deformed[at].p_BCom;
    segment.inertia_B_kgm2 = factor * deformed[at].inertia_B_kgm2;
  }
  setStopsOfAge(result.skeleton, reference, model.physics ? model.physics->age_years : std::nullopt,
                factors.age_years);
  result.passive_moments = scaledStructures(reference.passive_moments, reference.skeleton, result.skeleton);
  constexpr double kByRule = -1;
  const auto strength = factorsByUnit(result.musculature, factors.strength_factors, kByRule);
  const auto X_WB = segmentPoses(reference.skeleton, zeroPosture(reference.skeleton));
  for (std::size_t i = 0; i < strength.size(); ++i) {
    MusculotendonUnit& unit = result.musculature.units[i];
    const MusculotendonUnit& own = reference.musculature.unit(unit.name);
    unit.max_isometric_force_N =
        own.max_isometric_force_N *
        (strength[i] == kByRule ? crossSectionScale(reference.skeleton, own, parameters, X_WB) : strength[i]);
  }
  return result;
}

double volumeMass_kg(const Skeleton& reference, const ShapeParameters& shape) {
  double mass_kg = 0;
  for (const Segment& segment : deformedInertias(reference, toVector(shape))) mass_kg += segment.mass_kg;
  return mass_kg;
}

std::map<std::string, double> massFactorsFor(const Skeleton& reference, const ShapeParameters& shape,
                                             double mass_kg) {
  const double volume_kg = volumeMass_kg(reference, shape);
  const double factor = mass_kg / volume_kg;
  constexpr double kMost = 5;
  if (!(factor > 1 / kMost && factor < kMost)) {
    char found[96];
    std::snprintf(found, sizeof found, "%.1f kg, where bones of this size belong to a body of about %.0f kg", mass_kg,
                  volume_kg);
    throw InputError{{"body", "mass_kg", "the mass of this body", found}};
  }
  std::map<std::string, double> factors;
  for (int i = 0; i < reference.movingSegmentCount(); ++i) factors[reference.segments[std::size_t(i)].name] = factor;
  return factors;
}

}  // namespace sinew
