#pragma once
#include <vector>

#include "core/kernel/model_view_internal.h"
#include "core/muscle/musculature.h"
#include "core/skeleton/skeleton.h"

namespace sinew {

/// The segments as a tree, driven ones included: what each hangs on, and which coordinates turn it against that.
struct SegmentTree {
  struct Link {
    int parent = -1;  ///< segment; -1 = world
    int kind = 0;     ///< NodeView::Kind; of no meaning for the root
    int driver = -1;  ///< index of the patella or radius
    int first_coordinate = 0, coordinate_count = 0;
  };
  std::vector<Link> links;  ///< by segment
};
SegmentTree segmentTree(const Skeleton& skeleton);

/// The segments whose wrenches turn joints when a unit pulls: all that it is anchored to and what they hang on, below
/// the segment that they all hang on.
struct UnitNodes {
  std::vector<NodeView> nodes;   ///< leaves first; `entry` counts from the unit's first
  std::vector<int> coordinates;  ///< of the unit's gradient entries, ascending
  int slotOf(int segment) const;
};
UnitNodes nodesOf(const SegmentTree& tree, const MusculotendonUnit& unit);

/// The part of a path that changes. A segment of the path between two points of one bone has a constant length and
/// pulls that bone nowhere; what is left falls into runs of points that follow each other. Points inside a bone are
/// in none.
struct ChangingPath {
  double constant_m = 0;
  std::vector<std::vector<const PathPoint*>> runs;
};
ChangingPath changingPath(const MusculotendonUnit& unit);

}  // namespace sinew
