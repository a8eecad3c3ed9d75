#include <algorithm>
#include <set>

#include "core/kernel/unit_nodes_internal.h"

namespace sinew {
namespace {

/// From a segment to the root, itself included.
std::vector<int> chain(const SegmentTree& tree, int segment) {
  std::vector<int> segments;
  for (; segment >= 0; segment = tree.links[segment].parent) segments.push_back(segment);
  return segments;
}

/// Spanned segments, leaves first.
std::vector<int> spannedSegments(const SegmentTree& tree, const MusculotendonUnit& unit) {
  std::set<int> anchored;
  for (const auto& point : unit.path)
    for (const Anchor& a : point.anchors) anchored.insert(a.segment);
  std::vector<std::size_t> carried(tree.links.size(), 0);  // anchored segments that hang on this one or are it
  for (const int segment : anchored)
    for (const int s : chain(tree, segment)) ++carried[s];
  std::vector<int> spanned;
  for (std::size_t s = 0; s < carried.size(); ++s)
    if (carried[s] > 0 && carried[s] < anchored.size()) spanned.push_back(static_cast<int>(s));
  std::ranges::stable_sort(spanned, std::greater{}, [&](int s) { return chain(tree, s).size(); });
  return spanned;
}

}  // namespace

ChangingPath changingPath(const MusculotendonUnit& unit) {
  ChangingPath path;
  const auto fixedTogether = [](const PathPoint& a, const PathPoint& b) {
    return a.anchors.size() == 1 && b.anchors.size() == 1 && a.anchors[0].segment == b.anchors[0].segment;
  };
  bool in_run = false;
  for (std::size_t i = 1; i < unit.path.size(); ++i) {
    const PathPoint &a = unit.path[i - 1], &b = unit.path[i];
    if (fixedTogether(a, b)) {
      path.constant_m += (b.anchors[0].p_B - a.anchors[0].p_B).norm();
      in_run = false;
      continue;
    }
    if (!in_run) path.runs.push_back({&a});
    path.runs.back().push_back(&b);
    in_run = true;
  }
  return path;
}

SegmentTree segmentTree(const Skeleton& skeleton) {
  SegmentTree tree;
  tree.links.resize(skeleton.segments.size());
  for (const Joint& joint : skeleton.joints)
    tree.links[joint.child] = {joint.parent, joint.type == JointType::Revolute ? NodeView::Revolute : NodeView::Ball,
                               -1, joint.first_coordinate, joint.coordinate_count};
  for (int i = 0; i < 2; ++i) {
    const auto& patella = skeleton.patellae[i];
    tree.links[patella.segment] = {patella.femur, NodeView::Patella, i, patella.knee_coordinate, 1};
    const auto& radius = skeleton.radii[i];
    tree.links[radius.segment] = {radius.ulna, NodeView::Radius, i,
                                  skeleton.joints[radius.wrist_joint].first_coordinate, 3};
  }
  return tree;
}

int UnitNodes::slotOf(int segment) const {
  const auto found = std::ranges::find(nodes, segment, &NodeView::segment);
  return found == nodes.end() ? -1 : static_cast<int>(found - nodes.begin());
}

UnitNodes nodesOf(const SegmentTree& tree, const MusculotendonUnit& unit) {
  const std::vector<int> spanned = spannedSegments(tree, unit);
  std::set<int> coordinates;
  for (const int segment : spanned)
    for (int i = 0; i < tree.links[segment].coordinate_count; ++i)
      coordinates.insert(tree.links[segment].first_coordinate + i);
  UnitNodes result;
  result.coordinates.assign(coordinates.begin(), coordinates.end());
  std::set<int> written;
  for (const int segment : spanned) {
    const SegmentTree::Link& link = tree.links[segment];
    const auto entry =
        std::ranges::lower_bound(result.coordinates, link.first_coordinate) - result.coordinates.begin();
    const bool adds = !written.insert(link.first_coordinate).second;
    result.nodes.push_back({link.kind, segment, link.driver, -1, static_cast<int>(entry), adds});
  }
  for (NodeView& node : result.nodes) node.parent_slot = result.slotOf(tree.links[node.segment].parent);
  return result;
}

}  // namespace sinew
