#include "core/model/audit_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "core/model/audit_patterns_internal.h"
#include "core/muscle/hill.h"
#include "core/muscle/muscle_path.h"

namespace sinew {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

const MusculotendonUnit* findUnit(const Musculature& musculature, const std::string& name) {
  const auto found = std::ranges::find(musculature.units, name, &MusculotendonUnit::name);
  return found == musculature.units.end() ? nullptr : &*found;
}

/// Points of a segment by name: its landmarks, its origin and the centres of the joints that hang on it.
std::map<std::string, Eigen::Vector3d> pointsOf(const Skeleton& skeleton, const std::string& segment) {
  const auto is = [&](int i) { return i >= 0 && skeleton.segments[static_cast<std::size_t>(i)].name == segment; };
  std::map<std::string, Eigen::Vector3d> points{{"origin", Eigen::Vector3d::Zero()}};
  for (const Landmark& landmark : skeleton.landmarks)
    if (is(landmark.segment)) points[landmark.name] = landmark.p_BL;
  for (const Joint& joint : skeleton.joints)
    if (is(joint.parent)) points["joint " + joint.name] = joint.X_PJ.translation();
  return points;
}

/// Root mean square distance of a segment's points from their middle, over the reference's; of the points that both
/// have. NaN if that says nothing.
double sizeRatio(const Skeleton& model, const Skeleton& reference, const std::string& segment) {
  const auto here = pointsOf(model, segment), there = pointsOf(reference, segment);
  Eigen::Matrix3Xd p(3, 0), q(3, 0);
  for (const auto& [name, point] : here) {
    const auto same = there.find(name);
    if (same == there.end()) continue;
    p.conservativeResize(3, p.cols() + 1);
    q.conservativeResize(3, q.cols() + 1);
    p.rightCols(1) = point;
    q.rightCols(1) = same->second;
  }
  const auto spread = [](const Eigen::Matrix3Xd& points) {
    return (points.colwise() - points.rowwise().mean()).norm();
  };
  const double ratio = spread(p) / spread(q);
  return ratio > 0 && std::isfinite(ratio) ? ratio : kNaN;
}

/// Size of every segment of `model` relative to the reference; a driven one has its parent's.
std::vector<double> segmentScales(const Skeleton& model, const Skeleton& reference) {
  std::vector<double> scales;
  for (const Segment& segment : model.segments) {
    double scale = sizeRatio(model, reference, segment.name);
    if (!std::isfinite(scale)) scale = segment.parent >= 0 ? scales[static_cast<std::size_t>(segment.parent)] : 1;
    scales.push_back(scale);
  }
  return scales;
}

/// Mean over the segments that a unit hangs on, by the weights of its anchors.
double scaleOf(const MusculotendonUnit& unit, const std::vector<double>& segment_scales) {
  double sum = 0, weights = 0;
  for (const PathPoint& point : unit.path)
    for (const Anchor& a : point.anchors) {
      if (a.segment < 0 || a.segment >= static_cast<int>(segment_scales.size())) continue;
      sum += a.weight * segment_scales[static_cast<std::size_t>(a.segment)];
      weights += a.weight;
    }
  return weights > 0 ? sum / weights : 1;
}

/// What makes the parameters of a unit no parameters; empty if they can be judged.
std::string brokenParameter(const MusculotendonUnit& unit, std::size_t segment_count) {
  const auto positive = [](double x) { return std::isfinite(x) && x > 0; };
  if (!positive(unit.max_isometric_force_N)) return "F_max is not a positive number";
  if (!positive(unit.optimal_fiber_length_m)) return "the optimal fibre length is not a positive number";
  if (!positive(unit.tendon_slack_length_m)) return "the tendon slack length is not a positive number";
  const double pennation = unit.pennation_angle_at_optimal_rad;
  if (!(pennation >= 0 && pennation < std::numbers::pi / 2)) return "the pennation is not from 0 to below 90 deg";
  if (unit.path.size() < 2) return "the path has fewer than two points";
  for (const PathPoint& point : unit.path)
    for (const Anchor& a : point.anchors)
      if (a.segment < 0 || a.segment >= static_cast<int>(segment_count) || !a.p_B.allFinite())
        return "a point of the path is nowhere (" + point.site + ")";
  return {};
}

class Auditor {
 public:
  Auditor(const Model& model, const Model& reference, const AuditRanges& ranges)
      : model_{model}, reference_{reference}, ranges_{ranges} {}

  ModelAudit audit() {
    const auto scales = segmentScales(model_.skeleton, reference_.skeleton);
    const auto X_WB = segmentPoses(model_.skeleton, zeroPosture(model_.skeleton));
    const auto X_WB_reference = segmentPoses(reference_.skeleton, zeroPosture(reference_.skeleton));
    for (const auto& unit : model_.musculature.units) {
      const std::string broken = brokenParameter(unit, model_.skeleton.segments.size());
      audit_.units.push_back(figures(unit, broken, scaleOf(unit, scales), X_WB));
      if (!broken.empty()) {
        audit_.findings.push_back({.unit = unit.name,
                                   .quantity = "parameters",
                                   .value = kNaN,
                                   .low = kNaN,
                                   .high = kNaN,
                                   .reason = broken});
        continue;
      }
      const auto factor = model_.length_factors.find(unit.name);
      const double changed_by = factor != model_.length_factors.end() && factor->second > 0 ? factor->second : 1;
      MusculotendonUnit before = unit;
      before.optimal_fiber_length_m /= changed_by;
      before.tendon_slack_length_m /= changed_by;
      judgeUnit(audit_.units.back(), figures(before, {}, scaleOf(unit, scales), X_WB), changed_by, X_WB_reference);
    }
    judgeWholeMuscles();
    return std::move(audit_);
  }

 private:
  /// The row for a quantity of a unit: of several the last, so that named rows go before those for all.
  const LiteratureRange* rangeFor(const std::string& unit, const std::string& quantity) const {
    const LiteratureRange* found = nullptr;
    for (const auto& range : ranges_.ranges)
      if (range.quantity == quantity && fits(range.units, unit)) found = &range;
    return found;
  }

  AuditedUnit figures(const MusculotendonUnit& unit, const std::string& broken, double scale,
                      const std::vector<RigidTransform>& X_WB) const {
    AuditedUnit u;
    u.name = unit.name;
    u.body_scale = scale;
    u.max_isometric_force_N = unit.max_isometric_force_N;
    u.optimal_fiber_length_m = unit.optimal_fiber_length_m;
    u.tendon_slack_length_m = unit.tendon_slack_length_m;
    u.pennation_rad = unit.pennation_angle_at_optimal_rad;
    u.tendon_to_fiber = unit.tendon_slack_length_m / unit.optimal_fiber_length_m;
    const auto* tension = rangeFor(unit.name, "source_tension_N_cm2");
    u.source_tension_N_cm2 = tension ? tension->low : kNaN;
    u.pcsa_cm2 = unit.max_isometric_force_N / u.source_tension_N_cm2;
    const auto* published = findUnit(ranges_.published, unit.name);
    u.published_force_N = published ? published->max_isometric_force_N : kNaN;
    u.published_fiber_length_m = published ? published->optimal_fiber_length_m : kNaN;
    u.published_tendon_length_m = published ? published->tendon_slack_length_m : kNaN;
    u.path_length_m = broken.empty() ? pathLength(unit, X_WB) : kNaN;
    u.standing_fiber = broken.empty() ? equilibrium(unit, u.path_length_m, 0).normalized_fiber_length : kNaN;
    return u;
  }

  /// What is judged of one unit, by quantity.
  std::vector<std::pair<std::string, double>> quantities(const AuditedUnit& u, double reference_path_m) const {
    const double fiber_m = u.optimal_fiber_length_m / u.body_scale;
    return {{"specific_tension_N_cm2", u.source_tension_N_cm2},
            {"force_of_published", u.max_isometric_force_N / u.published_force_N},
            {"optimal_fiber_length_cm", 100 * fiber_m},
            {"fiber_of_published", fiber_m / u.published_fiber_length_m},
            {"tendon_to_fiber_of_published",
             u.tendon_to_fiber * u.published_fiber_length_m / u.published_tendon_length_m},
            {"pennation_deg", u.pennation_rad * 180 / std::numbers::pi},
            {"standing_fiber", u.standing_fiber},
            {"path_of_reference", u.path_length_m / u.body_scale / reference_path_m}};
  }

  /// @param before figures before the examination changed the unit's length by `factor`.
  void judgeUnit(const AuditedUnit& u, const AuditedUnit& before, double factor,
                 const std::vector<RigidTransform>& X_WB_reference) {
    const auto* same = findUnit(reference_.musculature, u.name);
    const double reference_path_m = same ? pathLength(*same, X_WB_reference) : kNaN;
    const auto values = quantities(u, reference_path_m), values_before = quantities(before, reference_path_m);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto& [quantity, value] = values[i];
      const double growth = quantity == "force_of_published" ? u.body_scale * u.body_scale : 1;
      AuditFinding* finding = judge(u.name, u.name, quantity, value, growth);
      if (factor != 1 && finding && finding->verdict == AuditVerdict::Outlier &&
          verdictOn(u.name, quantity, values_before[i].second, growth).first != AuditVerdict::Outlier) {
        finding->verdict = AuditVerdict::Explained;
        finding->reason = "the examination changed its length; before, it was within the range";
      }
    }
  }

  /// PCSA of whole muscles, a side at a time. F_max of a scaled body may have stayed or have grown with the area.
  void judgeWholeMuscles() {
    std::set<std::string> judged;
    for (const AuditedUnit& first : audit_.units) {
      const auto* range = rangeFor(first.name, "pcsa_cm2");
      if (!range) {
        audit_.unjudged.push_back(first.name + ": pcsa_cm2");
        continue;
      }
      const std::string side = first.name.substr(withoutSide(first.name).size());
      std::string label;
      for (const auto& pattern : range->units) label += (label.empty() ? "" : "+") + pattern + side;
      if (!judged.insert(label).second) continue;
      double sum_cm2 = 0, scale = 0;
      int count = 0;
      for (const AuditedUnit& u : audit_.units) {
        if (!fits(range->units, u.name) || u.name.substr(withoutSide(u.name).size()) != side) continue;
        sum_cm2 += u.pcsa_cm2;
        scale += u.body_scale;
        ++count;
      }
      judge(first.name, label, "pcsa_cm2", sum_cm2, std::pow(scale / count, 2));
    }
  }

  /// Verdict on a value, and the reason if it is explained. There is a range for the quantity.
  /// @param growth by which the quantity may have grown with the body, or not: widens the range.
  std::pair<AuditVerdict, std::string> verdictOn(const std::string& unit, const std::string& quantity, double value,
                                                 double growth) const {
    const auto within = [&](double low, double high) {
      return value >= low * std::min(1.0, growth) && value <= high * std::max(1.0, growth);
    };
    const auto* range = rangeFor(unit, quantity);
    if (within(range->low, range->high)) return {AuditVerdict::Inside, ""};
    for (const auto& e : ranges_.explanations)
      if (e.quantity == quantity && fits(e.units, unit) && within(e.low, e.high))
        return {AuditVerdict::Explained, e.reason};
    return {AuditVerdict::Outlier, ""};
  }

  /// @returns the finding; nullptr if there is no range or no value, which is noted.
  AuditFinding* judge(const std::string& unit, const std::string& label, const std::string& quantity, double value,
                      double growth) {
    const auto* range = rangeFor(unit, quantity);
    if (!range || std::isnan(value)) {
      audit_.unjudged.push_back(unit + ": " + quantity);
      return nullptr;
    }
    const auto [verdict, reason] = verdictOn(unit, quantity, value, growth);
    audit_.findings.push_back({.unit = label,
                               .quantity = quantity,
                               .value = value,
                               .low = range->low,
                               .high = range->high,
                               .verdict = verdict,
                               .verified = range->verified,
                               .source = range->source,
                               .reason = reason});
    return &audit_.findings.back();
  }

  const Model &model_, &reference_;
  const AuditRanges& ranges_;
  ModelAudit audit_;
};

}  // namespace

long ModelAudit::count(AuditVerdict verdict) const {
  return std::ranges::count(findings, verdict, &AuditFinding::verdict);
}

ModelAudit auditModel(const Model& model, const Model& reference, const AuditRanges& ranges) {
  return Auditor{model, reference, ranges}.audit();
}

}  // namespace sinew
