#pragma once
#include <memory>
#include <vector>

#include "app/scene/model_scene.h"

namespace sinew {

/// Bodies side by side on one ground, all to the same scale: the first figure of Ryu et al.
struct LineupPicture {
  int height_px = 600;
  StandardView view = StandardView::Front;
  Backdrop backdrop = Backdrop::White;
  bool muscles = true;
  double gap_m = 0.12;       ///< between neighbours
  double least_share = 0.2;  ///< width of a body's place over the height of the picture: names need room
  OffscreenOptions quality;
};
struct Lineup {
  RgbImage image;
  std::vector<int> centre_px;  ///< of each body, from the left
  int ground_px = 0;           ///< row of the ground, from the top
  double pixel_m = 0;          ///< size of a pixel
};

/// One body in its posture; it stands on Y = 0 if the posture says so.
struct LineupBody {
  std::shared_ptr<const Model> model;
  Posture posture;
};

/// Draws it without a display. @throws InputError if the machine cannot (see renderOffscreen()).
Lineup renderLineup(const std::vector<LineupBody>& bodies, const LineupPicture& picture = {});

/// How far the lowest point of the bones lies above the world's origin in a posture [m]: taken off, the body stands.
double lowestPoint_m(const Model& model, const Posture& posture);
/// The zero posture, feet on the ground Y = 0.
Posture standingOnGround(const Model& model);

}  // namespace sinew
