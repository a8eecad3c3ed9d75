#include "app/scene/lineup.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/muscle/muscle_path.h"

namespace sinew {
namespace {

struct Extent {
  double left = std::numeric_limits<double>::infinity(), right = -left, low = left, high = -left;
};

/// Of bones and paths, with room for the flesh.
Extent extentOf(const LineupBody& body, const Eigen::Matrix3d& R_WC) {
  constexpr double kFlesh_m = 0.02;
  const auto X_WB = segmentPoses(body.model->skeleton, body.posture);
  Extent e;
  for (const auto& bone : *body.model->bones) {
    const RigidTransform& X = X_WB[std::size_t(bone.segment)];
    const Eigen::RowVector3d right = R_WC.col(0).transpose() * X.linear(), up = R_WC.col(1).transpose() * X.linear();
    const double right0 = R_WC.col(0).dot(X.translation()), up0 = R_WC.col(1).dot(X.translation());
    for (const auto& p : bone.mesh.vertices) {
      const double x = right.dot(p) + right0, y = up.dot(p) + up0;
      e = {std::min(e.left, x), std::max(e.right, x), std::min(e.low, y), std::max(e.high, y)};
    }
  }
  for (const auto& unit : body.model->musculature.units)
    for (const Eigen::Vector3d& p : pathPoints(unit, X_WB)) {
      const double x = R_WC.col(0).dot(p), y = R_WC.col(1).dot(p);
      e = {std::min(e.left, x), std::max(e.right, x), std::min(e.low, y), std::max(e.high, y)};
    }
  return {e.left - kFlesh_m, e.right + kFlesh_m, e.low, e.high};
}

void copyInto(RgbImage& all, const RgbImage& part, int left_px) {
  for (int v = 0; v < part.height_px; ++v)
    std::copy_n(part.at(0, v), 3 * part.width_px,
                &all.rgb[3 * (std::size_t(v) * std::size_t(all.width_px) + std::size_t(left_px))]);
}

}  // namespace

Lineup renderLineup(const std::vector<LineupBody>& bodies, const LineupPicture& picture) {
  require(!bodies.empty(), "renderLineup: no body");
  const Eigen::Matrix3d R_WC = viewAxes(picture.view);
  std::vector<Extent> extents;
  double low = 0, high = 0;
  for (const auto& body : bodies) {
    extents.push_back(extentOf(body, R_WC));
    low = std::min(low, extents.back().low);
    high = std::max(high, extents.back().high);
  }
  constexpr double kMargin = 1.04;
  const double half_height_m = kMargin * (high - low) / 2, middle_m = (low + high) / 2;
  Lineup lineup;
  lineup.pixel_m = 2 * half_height_m / picture.height_px;
  lineup.ground_px = int(std::lround((middle_m + half_height_m) / lineup.pixel_m));
  std::vector<int> widths_px;
  int width_px = 0;
  for (const Extent& e : extents) {
    widths_px.push_back(std::max(int(picture.least_share * picture.height_px),
                                 int(std::lround((e.right - e.left + picture.gap_m) / lineup.pixel_m))));
    lineup.centre_px.push_back(width_px + widths_px.back() / 2);
    width_px += widths_px.back();
  }
  lineup.image = {width_px, picture.height_px,
                  std::vector<std::uint8_t>(std::size_t(3 * width_px * picture.height_px), 255)};
  int left_px = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    ModelPicture one;
    one.width_px = widths_px[i];
    one.height_px = picture.height_px;
    one.view = picture.view;
    one.backdrop = picture.backdrop;
    one.muscles = picture.muscles;
    one.mechanical_axes = false;
    one.quality = picture.quality;
    const double middle_right_m = (extents[i].left + extents[i].right) / 2;
    one.focus = {R_WC.col(0) * middle_right_m + R_WC.col(1) * middle_m, half_height_m};
    copyInto(lineup.image, renderModel(*bodies[i].model, bodies[i].posture, one), left_px);
    left_px += widths_px[i];
  }
  return lineup;
}

double lowestPoint_m(const Model& model, const Posture& posture) {
  const auto X_WB = segmentPoses(model.skeleton, posture);
  double lowest_m = std::numeric_limits<double>::infinity();
  for (const auto& bone : *model.bones) {
    const RigidTransform& X = X_WB[std::size_t(bone.segment)];
    const Eigen::RowVector3d up = X.linear().row(1);
    for (const auto& p : bone.mesh.vertices) lowest_m = std::min(lowest_m, up.dot(p) + X.translation().y());
  }
  return lowest_m;
}

Posture standingOnGround(const Model& model) {
  Posture posture = zeroPosture(model.skeleton);
  if (const double lowest_m = lowestPoint_m(model, posture); std::isfinite(lowest_m)) posture[1] -= lowest_m;
  return posture;
}

}  // namespace sinew
