#pragma once
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/mesh_distance.h"
#include "core/job.h"
#include "core/model/model.h"

namespace sinew {

// Do muscles run outside the bones? Measured on the bone meshes of a model, at any postures.

/// The bones of a model as distance fields, made once.
class BoneDistances {
 public:
  explicit BoneDistances(const Model& model);

  struct Bone {
    std::string name;
    int segment;
    Eigen::Vector3d low_B, high_B;  ///< box
    MeshDistance distance;
  };
  const std::vector<Bone>& bones() const { return bones_; }

  /// Nearest surface among the bones of one segment whose name begins with `bone` (all of the segment if empty).
  struct Surface {
    std::string bone;
    MeshDistance::Nearest nearest;  ///< segment frame
  };
  Surface nearest(int segment, const Eigen::Vector3d& p_B, std::string_view bone = {}) const;

 private:
  std::vector<Bone> bones_;
};

/// Deepest place of one unit's path inside any bone.
struct PathPenetration {
  double depth_m = 0;
  std::string bone;       ///< that it runs through; empty if none
  int posture = -1;       ///< index of the posture
  int path_segment = -1;  ///< between point i and i + 1
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
};

/// Signed distances of one unit's ends to the surface of the nearest bone of their segment [m], negative inside.
struct AttachmentDistance {
  double origin_m = 0, insertion_m = 0;
  std::string origin_bone, insertion_bone;
};

struct ClearanceOptions {
  double step_m = 0.002;  ///< between samples along the path
};

/// By segment: does the unit span it? Segments along the skeleton between those that the unit hangs on, with the
/// driven ones beside them: the bones that its path has to get around. Others come near it only where bodies collide.
std::vector<bool> spannedSegments(const Skeleton& skeleton, const MusculotendonUnit& unit);

/// By unit, against the bones of the segments that the unit spans (a hanging arm may well touch the hip). Sampled
/// along the path at every posture; no part of the path is left out. A cancelled job returns what was measured so
/// far.
std::vector<PathPenetration> measurePenetration(const Model& model, const BoneDistances& bones,
                                                std::span<const Posture> postures,
                                                const ClearanceOptions& options = {}, const Job& job = {});

std::vector<AttachmentDistance> measureAttachments(const Model& model, const BoneDistances& bones);

}  // namespace sinew
