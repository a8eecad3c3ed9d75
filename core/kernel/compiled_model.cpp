#include "core/kernel/compiled_model.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/kernel/compiled_arrays_internal.h"
#include "core/kernel/unit_nodes_internal.h"
#include "core/muscle/hill.h"

namespace sinew {
namespace {

template <class Target, class Source>
void copyTo(Target* target, const Source& source) {
  for (Eigen::Index r = 0, i = 0; r < source.rows(); ++r)
    for (Eigen::Index c = 0; c < source.cols(); ++c) target[i++] = static_cast<Target>(source(r, c));
}

template <class Real>
JointView<Real> jointView(const Skeleton& skeleton, const Joint& joint) {
  JointView<Real> view{};
  const bool free = joint.type == JointType::Free;
  view.kind = joint.type == JointType::Revolute ? JointView<Real>::Revolute
              : free                            ? JointView<Real>::Free
                                                : JointView<Real>::Ball;
  view.parent = joint.parent;
  view.child = joint.child;
  view.coordinate = joint.first_coordinate + (free ? 3 : 0);
  view.turned = joint.X_PJ.linear() != Eigen::Matrix3d::Identity();
  copyTo(view.R_PJ, joint.X_PJ.linear());
  copyTo(view.p_PJ, joint.X_PJ.translation());
  copyTo(view.axis, skeleton.coordinates[view.coordinate].axis);
  return view;
}

template <class Real>
PatellaView<Real> patellaView(const PatellaDriver& d) {
  const auto samples = d.knee_flexion_rad.size();
  require(samples >= 2 && samples <= PatellaView<Real>::kMaxSamples, "a patella's curve has 2 to 32 samples");
  PatellaView<Real> view{};
  view.segment = d.segment;
  view.femur = d.femur;
  view.coordinate = d.knee_coordinate;
  copyTo(view.R_FK, d.R_FK);
  copyTo(view.p_FK, d.p_FK);
  view.radius_m = Real(d.radius_m);
  view.cos_start = Real(std::cos(d.start_rad));
  view.sin_start = Real(std::sin(d.start_rad));
  view.samples = static_cast<int>(samples) - 1;
  for (std::size_t i = 0; i < samples; ++i) view.rate[i] = Real(d.quadriceps_arm_m[i] / d.reference_radius_m);
  for (std::size_t i = 0; i + 1 < samples; ++i) {
    const double span = d.knee_flexion_rad[i + 1] - d.knee_flexion_rad[i];
    view.knot[i] = Real(d.knee_flexion_rad[i]);
    view.span[i] = Real(span);
    view.slope[i] = Real((d.quadriceps_arm_m[i + 1] - d.quadriceps_arm_m[i]) / (span * d.reference_radius_m));
  }
  return view;
}

template <class Real>
RadiusView<Real> radiusView(const Skeleton& skeleton, const RadiusDriver& d) {
  RadiusView<Real> view{};
  view.segment = d.segment;
  view.ulna = d.ulna;
  view.coordinate = skeleton.joints[d.wrist_joint].first_coordinate;
  copyTo(view.p_UR, d.p_UR);
  copyTo(view.axis, d.axis_U);
  return view;
}

template <class Real>
RealArrays<Real> realArrays(const Skeleton& skeleton, std::span<const ChangingPath> paths) {
  RealArrays<Real> arrays;
  for (const Joint& joint : skeleton.joints) arrays.joints.push_back(jointView<Real>(skeleton, joint));
  for (const auto& d : skeleton.patellae) arrays.patellae.push_back(patellaView<Real>(d));
  for (const auto& d : skeleton.radii) arrays.radii.push_back(radiusView<Real>(skeleton, d));
  for (const ChangingPath& path : paths) {
    arrays.unit_constant_m.push_back(Real(path.constant_m));
    for (const auto& run : path.runs)
      for (const PathPoint* point : run)
        for (const Anchor& a : point->anchors) {
          const Eigen::Vector3d wx = a.weight * a.p_B;
          arrays.terms.push_back({Real(wx.x()), Real(wx.y()), Real(wx.z()), Real(a.weight)});
        }
  }
  return arrays;
}

void addPath(const ChangingPath& path, const UnitNodes& nodes, CompiledArrays& arrays) {
  for (const auto& run : path.runs) {
    for (const PathPoint* point : run) {
      const bool single = point->anchors.size() == 1;
      require(!single || point->anchors.front().weight == 1, "the weights of a path point add up to 1");
      for (const Anchor& a : point->anchors) {
        arrays.term_offset.push_back(12 * a.segment);
        arrays.term_slot.push_back(nodes.slotOf(a.segment));
      }
      arrays.point_terms.push_back(static_cast<int>(arrays.term_offset.size()));
    }
    arrays.run_points.push_back(static_cast<int>(arrays.point_terms.size()) - 1);
  }
  arrays.unit_runs.push_back(static_cast<int>(arrays.run_points.size()) - 1);
}

void addUnit(const SegmentTree& tree, const MusculotendonUnit& unit, const ChangingPath& path,
             CompiledArrays& arrays) {
  UnitNodes nodes = nodesOf(tree, unit);
  addPath(path, nodes, arrays);
  for (NodeView& node : nodes.nodes) {
    node.entry += arrays.gradient_start.back();
    arrays.nodes.push_back(node);
  }
  arrays.unit_nodes.push_back(static_cast<int>(arrays.nodes.size()));
  arrays.gradient_coordinate.insert(arrays.gradient_coordinate.end(), nodes.coordinates.begin(),
                                    nodes.coordinates.end());
  arrays.gradient_start.push_back(static_cast<int>(arrays.gradient_coordinate.size()));
  arrays.longest_m.push_back(longestLength_m(unit));
  arrays.max_nodes = std::max(arrays.max_nodes, static_cast<int>(nodes.nodes.size()));
}

/// Units in groups of about as many points as their working memory leaves room for in the first-level cache.
void groupUnits(CompiledArrays& arrays) {
  constexpr int kPoints = 24;
  const auto firstPoint = [&](int unit) { return arrays.run_points[arrays.unit_runs[unit]]; };
  const int units = static_cast<int>(arrays.unit_runs.size()) - 1;
  for (int first = 0, end; first < units; first = end) {
    for (end = first + 1; end < units && firstPoint(end + 1) - firstPoint(first) <= kPoints;) ++end;
    arrays.group_units.push_back(end);
    arrays.max_points = std::max(arrays.max_points, firstPoint(end) - firstPoint(first));
    arrays.max_terms =
        std::max(arrays.max_terms, arrays.point_terms[firstPoint(end)] - arrays.point_terms[firstPoint(first)]);
  }
}

}  // namespace

CompiledModel::CompiledModel(const Skeleton& skeleton, const Musculature& musculature, Isa isa) : isa_{isa} {
  auto arrays = std::make_shared<CompiledArrays>();
  arrays->segment_count = static_cast<int>(skeleton.segments.size());
  arrays->coordinate_count = skeleton.coordinateCount();
  std::vector<ChangingPath> paths;
  for (const auto& unit : musculature.units) paths.push_back(changingPath(unit));
  arrays->doubles = realArrays<double>(skeleton, paths);
  arrays->floats = realArrays<float>(skeleton, paths);
  arrays->group_units = arrays->unit_runs = arrays->run_points = arrays->point_terms = arrays->unit_nodes =
      arrays->gradient_start = {0};
  const SegmentTree tree = segmentTree(skeleton);
  for (std::size_t u = 0; u < paths.size(); ++u) addUnit(tree, musculature.units[u], paths[u], *arrays);
  groupUnits(*arrays);
  arrays_ = std::move(arrays);
}

int CompiledModel::unitCount() const {
  return static_cast<int>(arrays_->longest_m.size());
}
int CompiledModel::segmentCount() const {
  return arrays_->segment_count;
}
int CompiledModel::coordinateCount() const {
  return arrays_->coordinate_count;
}
std::span<const double> CompiledModel::longest_m() const {
  return arrays_->longest_m;
}
std::span<const int> CompiledModel::gradientStart() const {
  return arrays_->gradient_start;
}
std::span<const int> CompiledModel::gradientCoordinate() const {
  return arrays_->gradient_coordinate;
}

}  // namespace sinew
