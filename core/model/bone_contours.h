#pragma once
#include <string>
#include <vector>

#include "core/geometry/silhouette.h"
#include "core/model/model.h"

namespace sinew {

/// What one bone draws on a radiograph.
struct BoneContour {
  std::string bone;  ///< "femur_r"
  std::vector<ImageLine> lines;
};

/// Contours of every bone of a posed model in one view, in the model's order; bones that lie outside of the image
/// altogether are left out. `X_WB` as segmentPoses() gives it.
/// @throws std::logic_error if a bone's segment is not in `X_WB`.
std::vector<BoneContour> boneContours(const std::vector<BoneMesh>& bones, const std::vector<RigidTransform>& X_WB,
                                      const View& view);

}  // namespace sinew
