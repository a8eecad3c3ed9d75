#include <algorithm>
#include <cmath>
#include <set>

#include "core/model/model.h"
#include "core/muscle/hill.h"
#include "core/muscle/muscle_path.h"
#include "core/text.h"

namespace sinew {
namespace {

/// Collects doubts; `what` is the thing they are about.
class Findings {
 public:
  void add(const std::string& code, const std::string& what, const std::string& message) {
    warnings_.push_back({code, what + ": " + message});
  }
  Warnings take() { return std::move(warnings_); }

 private:
  Warnings warnings_;
};

std::string mm(double length_m) {
  return fixed(1000 * length_m, 2) + " mm";
}

bool isSegment(const Skeleton& s, int index) {
  return index >= 0 && index < static_cast<int>(s.segments.size());
}

/// A joint's coordinates: as many as its type has, in a row, about unit axes; the second axis of a sequence is normal
/// to the third (the first may be oblique, as the forearm's is).
void checkCoordinates(const Skeleton& s, const Joint& joint, Findings& findings) {
  const int count = joint.type == JointType::Free ? 6 : joint.type == JointType::Ball ? 3 : 1;
  const int first = joint.first_coordinate, end = first + joint.coordinate_count;
  if (joint.coordinate_count != count || first < 0 || end > s.coordinateCount())
    return findings.add("joint_coordinates", joint.name, "it does not have the coordinates of its type");
  for (int i = first; i < end; ++i) {
    const Coordinate& c = s.coordinates[i];
    if (std::abs(c.axis.norm() - 1) > 1e-9) findings.add("coordinate_axis", c.name, "its axis is no unit vector");
    if (!(c.normal_min_rad < c.normal_max_rad)) findings.add("coordinate_limits", c.name, "its range is empty");
    const bool middle = count > 1 && i == end - 2;
    if (middle && std::abs(c.axis.dot(s.coordinates[i + 1].axis)) > 1e-6)
      findings.add("coordinate_axis", c.name, "its axis is not normal to the next one");
  }
}

/// Driven segments hang on the right ones; masses and inertias need none of this.
void checkDrivers(const Skeleton& s, Findings& findings) {
  for (const PatellaDriver& d : s.patellae)
    if (!isSegment(s, d.segment) || !isSegment(s, d.femur) || d.knee_coordinate < 0 ||
        d.knee_coordinate >= s.coordinateCount() || !(d.radius_m > 0))
      findings.add("driven_segment", "patella", "it has no knee to glide on");
  for (const RadiusDriver& d : s.radii)
    if (!isSegment(s, d.segment) || !isSegment(s, d.ulna) || d.wrist_joint < 0 ||
        d.wrist_joint >= static_cast<int>(s.joints.size()) || std::abs(d.axis_U.norm() - 1) > 1e-9)
      findings.add("driven_segment", "radius", "it has no axis to turn about");
}

void checkSkeleton(const Skeleton& s, Findings& findings) {
  for (const Joint& joint : s.joints) {
    const Eigen::Matrix3d R = joint.X_PJ.linear();
    if ((R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() > 1e-9)
      findings.add("joint_frame", joint.name, "its frame is not a rotation");
    if (joint.parent >= joint.child) findings.add("joint_order", joint.name, "its parent comes after its child");
  }
  for (const Joint& joint : s.joints) checkCoordinates(s, joint, findings);
  for (const Coordinate& c : s.coordinates)
    if (c.athlete_min_rad > c.normal_min_rad || c.athlete_max_rad < c.normal_max_rad)
      findings.add("coordinate_limits", c.name, "the normal range reaches beyond the athlete envelope");
  for (int i = 0; i < s.movingSegmentCount(); ++i) {
    const Segment& segment = s.segments[i];
    const Eigen::Matrix3d& I = segment.inertia_B_kgm2;
    if (!(segment.mass_kg > 0)) findings.add("segment_mass", segment.name, "its mass is not positive");
    for (int a = 0; a < 3; ++a)
      if (!(I(a, a) > 0) || I(a, a) > I((a + 1) % 3, (a + 1) % 3) + I((a + 2) % 3, (a + 2) % 3) + 1e-12)
        findings.add("segment_inertia", segment.name, "no body has these moments of inertia");
  }
  checkDrivers(s, findings);
}

/// Segments that a unit hangs on; empty if an anchor is unusable.
std::set<int> checkAnchors(const MusculotendonUnit& unit, const Skeleton& s, Findings& findings) {
  std::set<int> segments;
  for (const PathPoint& point : unit.path) {
    double sum = 0;
    for (const Anchor& a : point.anchors) {
      if (!isSegment(s, a.segment) || !a.p_B.allFinite()) {
        findings.add("muscle_anchor", unit.name, "a point hangs on nothing (" + point.site + ")");
        return {};
      }
      if (a.weight < 0) findings.add("muscle_weights", unit.name, "a weight is negative (" + point.site + ")");
      sum += a.weight;
      segments.insert(a.segment);
    }
    if (std::abs(sum - 1) > 1e-9)
      findings.add("muscle_weights", unit.name, "weights add up to " + std::to_string(sum) + " (" + point.site + ")");
  }
  return segments;
}

void checkUnit(const MusculotendonUnit& unit, const Skeleton& s, const std::vector<RigidTransform>& X_WB,
               bool shortened, Findings& findings) {
  if (!(unit.max_isometric_force_N > 0) || !(unit.optimal_fiber_length_m > 0) || !(unit.tendon_slack_length_m > 0))
    return findings.add("muscle_parameters", unit.name, "force, fibre or tendon length is not positive");
  const double pennation = unit.pennation_angle_at_optimal_rad;
  if (!std::isfinite(unit.max_isometric_force_N + unit.optimal_fiber_length_m + unit.tendon_slack_length_m) ||
      !(pennation >= 0 && pennation < 1.5))
    return findings.add("muscle_parameters", unit.name, "a figure is infinite, or pennation is not from 0 to 86 deg");
  if (unit.path.size() < 2) return findings.add("muscle_path", unit.name, "fewer than two points");
  for (std::size_t i = 0; i < unit.path.size(); ++i)
    if (unit.path[i].role != (i == 0                     ? PathPointRole::Origin
                              : i + 1 < unit.path.size() ? PathPointRole::Via
                                                         : PathPointRole::Insertion))
      findings.add("muscle_path", unit.name,
                   "not origin, via points, insertion in order (" + unit.path[i].site + ")");
  const auto segments = checkAnchors(unit, s, findings);
  if (segments.empty()) return;
  if (segments.size() == 1) findings.add("muscle_spans_no_joint", unit.name, "all points are on one segment");
  const auto points = pathPoints(unit, X_WB);
  constexpr double kCoincident_m = 1e-4;
  for (std::size_t i = 1; i < points.size(); ++i)
    if ((points[i] - points[i - 1]).norm() < kCoincident_m)
      findings.add("muscle_path", unit.name, "two points coincide (" + unit.path[i].site + ")");
  const double length_m = pathLength(unit, X_WB);
  const double fiber = equilibrium(unit, length_m, 0).normalized_fiber_length;
  if (fiber > 1.15 || fiber < 0.3)  // what the fit of lengths leaves out in the reference, with a margin for shapes
    findings.add("muscle_standing_fiber", unit.name,
                 "its fibre is at " + fixed(fiber, 2) + " of its optimal length when standing upright" +
                     (shortened ? ", as expected of a muscle that the examination found short" : ""));
  if (length_m > longestLength_m(unit))
    findings.add("muscle_overstretched", unit.name,
                 "standing stretches it " + mm(length_m - longestLength_m(unit)) + " beyond its longest length");
}

/// The undeformed body is its own mirror image.
void checkMirror(const Model& model, const std::vector<RigidTransform>& X_WB, Findings& findings) {
  constexpr double kTolerance_m = 1e-9;
  std::map<std::string, const MusculotendonUnit*> by_name;
  for (const auto& unit : model.musculature.units) by_name[unit.name] = &unit;
  for (const auto& [name, unit] : by_name) {
    if (!name.ends_with("_r")) continue;
    const auto left = by_name.find(std::string{withoutSide(name)} + "_l");
    if (left == by_name.end()) {
      findings.add("muscle_side_missing", name, "has no counterpart on the left");
      continue;
    }
    const auto here = pathPoints(*unit, X_WB), there = pathPoints(*left->second, X_WB);
    bool same = here.size() == there.size();
    for (std::size_t i = 0; same && i < here.size(); ++i) same = (mirrored(here[i]) - there[i]).norm() < kTolerance_m;
    if (!same) findings.add("muscle_mirror", name, "left and right paths are not mirror images");
    const MusculotendonUnit &r = *unit, &l = *left->second;
    const bool examined = model.length_factors.contains(r.name) || model.length_factors.contains(l.name);
    if (r.max_isometric_force_N != l.max_isometric_force_N ||
        r.pennation_angle_at_optimal_rad != l.pennation_angle_at_optimal_rad ||
        (!examined && (r.optimal_fiber_length_m != l.optimal_fiber_length_m ||
                       r.tendon_slack_length_m != l.tendon_slack_length_m)))
      findings.add("muscle_sides_differ", name,
                   "left and right have different figures in a body without deformation");
  }
}

/// Whoever asks a stop and whoever asks the structures there must get the same answer (core/passive/structures.h).
void checkStructures(const Model& model, Findings& findings) {
  constexpr double kSame_rad = 1e-9;
  const auto& coordinates = model.skeleton.coordinates;
  if (model.passive_moments.empty()) return;
  if (model.passive_moments.size() != coordinates.size())
    return findings.add("passive_structures", "passive_moments", "are not one a coordinate");
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const PassiveMoment& m = model.passive_moments[i];
    if ((m.upper_Nm > 0 && std::abs(m.upper_rad - coordinates[i].stop_max_rad) > kSame_rad) ||
        (m.lower_Nm > 0 && std::abs(m.lower_rad - coordinates[i].stop_min_rad) > kSame_rad))
      findings.add("passive_structures", coordinates[i].name, "has structures that end elsewhere than its stop");
  }
}

}  // namespace

Warnings validateModel(const Model& model) {
  Findings findings;
  const Skeleton& s = model.skeleton;
  checkSkeleton(s, findings);
  checkStructures(model, findings);
  for (const Landmark& landmark : s.landmarks)
    if (!isSegment(s, landmark.segment) || !landmark.p_BL.allFinite())
      findings.add("landmark", landmark.name, "is on no segment");
  for (const BoneMesh& bone : *model.bones)
    if (!isSegment(s, bone.segment)) findings.add("bone_segment", bone.bone, "is on no segment");

  const auto X_WB = segmentPoses(s, zeroPosture(s));
  std::set<std::string> names;
  for (const auto& unit : model.musculature.units) {
    if (!names.insert(unit.name).second) findings.add("muscle_name", unit.name, "exists twice");
    const auto factor = model.length_factors.find(unit.name);
    checkUnit(unit, s, X_WB, factor != model.length_factors.end() && factor->second < 1, findings);
  }
  for (const auto& [name, factor] : model.length_factors)
    if (!names.contains(name) || !(factor > 0))
      findings.add("length_factor", name, "is for no muscle or not positive: " + std::to_string(factor));
  Warnings warnings = findings.take();
  const bool sound = std::ranges::none_of(warnings, [](const Warning& w) { return w.code == "muscle_anchor"; });
  const bool own_bones = std::ranges::any_of(*model.bones, &BoneMesh::supplied);  // a person's sides differ
  if (sound && model.shape == ShapeParameters{} && !own_bones) {
    Findings mirror;
    checkMirror(model, X_WB, mirror);
    for (auto& w : mirror.take()) warnings.push_back(std::move(w));
  }
  return warnings;
}

}  // namespace sinew
