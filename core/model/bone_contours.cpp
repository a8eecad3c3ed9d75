#include "core/model/bone_contours.h"

#include <algorithm>

#include "core/error.h"

namespace sinew {
namespace {

constexpr double kSpeck_px = 12;  // loops below are ripples of the surface, not anatomy

bool touchesImage(const BoneContour& contour, const View& view) {
  return std::ranges::any_of(contour.lines, [&](const ImageLine& line) {
    return std::ranges::any_of(line, [&](const Eigen::Vector2d& p) {
      return p.x() >= 0 && p.y() >= 0 && p.x() < view.width_px && p.y() < view.height_px;
    });
  });
}

}  // namespace

std::vector<BoneContour> boneContours(const std::vector<BoneMesh>& bones, const std::vector<RigidTransform>& X_WB,
                                      const View& view) {
  std::vector<BoneContour> contours;
  for (const auto& bone : bones) {
    require(bone.segment >= 0 && bone.segment < int(X_WB.size()), "boneContours: a bone's segment has no pose");
    BoneContour contour{bone.bone, silhouette(bone.mesh, X_WB[bone.segment], view, kSpeck_px)};
    if (touchesImage(contour, view)) contours.push_back(std::move(contour));
  }
  return contours;
}

}  // namespace sinew
