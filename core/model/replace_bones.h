#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/geometry/rigid_transform.h"
#include "core/model/model.h"

namespace sinew {

/// A bone surface of one's own, in the coordinates S of the scan that it comes from [m]. Bones of one segment share
/// S.
struct SuppliedBone {
  std::string bone;  ///< name of the bone that it replaces: "femur_r"
  TriangleMesh mesh;
};

/// A landmark of the model as seen on the supplied surface, in the same coordinates S [m].
struct SuppliedLandmark {
  std::string name;  ///< "femoral_head_center_r"
  Eigen::Vector3d p_S;
};

/// How a segment's supplied bones were brought into its frame B.
struct SegmentFit {
  std::string segment;
  int landmarks = 0;  ///< 0: taken as given, S = B
  RigidTransform X_BS = RigidTransform::Identity();
  double rms_m = 0;  ///< of the landmarks after the fit
};

/// A joint centre that the supplied landmarks moved in the frame of its parent segment.
struct MovedJoint {
  std::string joint;
  double moved_m = 0;
};

/// A path point that was brought onto the new surface.
struct MovedAttachment {
  std::string unit;  ///< "soleus_medial_r"
  int point = 0;     ///< 0 = origin
  std::string bone;
  double moved_m = 0;  ///< in the frame of the segment
};

struct BoneReplacement {
  Model model;
  std::vector<SegmentFit> fits;
  std::vector<MovedJoint> joints;
  std::vector<MovedAttachment> attachments;
  Warnings warnings;
};

/// The model with surfaces of one's own in the place of its bones.
/// - Surfaces are welded, must be closed, and are turned outwards if need be (with a warning).
/// - Landmarks of a segment (three or more, not in a line) register its bones: least-squares rotation and translation
///   (Umeyama 1991, scale 1). A landmark at the segment's own joint centre fixes the translation; one at the centre
///   of a joint that hangs on the segment moves that joint there; all others replace the model's landmarks. Without
///   landmarks the surfaces are in the segment frame already.
/// - Path points nearest to a replaced bone, within 30 mm of its surface, go to the nearest point of the new surface
/// and
///   keep their signed distance from it. Fibre and tendon lengths scale with the path at the zero posture.
/// @throws InputError: unknown or repeated bone or landmark, open surface, a size that speaks of a wrong unit, too
/// few landmarks.
BoneReplacement replaceBones(const Model& model, const std::vector<SuppliedBone>& bones,
                             const std::vector<SuppliedLandmark>& landmarks);

}  // namespace sinew
