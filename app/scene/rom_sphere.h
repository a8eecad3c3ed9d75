#pragma once
#include <memory>
#include <optional>

#include "app/scene/model_scene.h"
#include "app/scene/offscreen.h"
#include "core/rom/maps/rom_map.h"

class vtkRenderer;

namespace sinew {

/// The cone of directions that an edit asks for.
struct RomHandles {
  Eigen::Vector3d centre_J = -Eigen::Vector3d::UnitY();  ///< unit
  double cone_rad = 0;
};

/// A ball joint's map on a sphere of its own: the directions that the shaft can take, coloured by the width of the
/// twist range there, with the directions of the body as words. The renderer belongs to the caller and outlives the
/// scene.
class RomSphereScene {
 public:
  explicit RomSphereScene(vtkRenderer& renderer);
  ~RomSphereScene();
  RomSphereScene(const RomSphereScene&) = delete;
  RomSphereScene& operator=(const RomSphereScene&) = delete;

  /// `widest_rad`: the twist range that gets the darkest colour; the same for maps that are compared.
  void setMap(const RomMap& map, double widest_rad);
  /// Present direction of the shaft in the joint frame; the resting one until it is set.
  void setShaft(const Eigen::Vector3d& shaft_J);
  void setBackdrop(Backdrop backdrop);
  void setFontSize(int size_px);
  /// The border of another map beside the coloured one: what it is compared with. nullopt: none.
  void setOutline(const std::optional<RomMap>& map);
  /// A cone to take hold of: its middle, its border, and a ball on each (the border's where a hand finds it, seen
  /// from here). nullopt: none.
  void setHandles(const std::optional<RomHandles>& handles);
  /// Where the handle on the border is [joint frame], for the present camera; the middle without handles.
  Eigen::Vector3d borderHandle_J() const;
  /// The direction that a point of the render window stands for [px, origin at the bottom left]: on the side of the
  /// sphere that is seen; beside the sphere its nearest edge.
  Eigen::Vector3d directionAt(double x_px, double y_px) const;
  /// The other way, for a direction on the side that is seen.
  Eigen::Vector2d pixelOf(const Eigen::Vector3d& direction_J) const;

  /// From the front and a little from above, from the side of the joint.
  void lookFromTheFront();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Direction of the shaft of a ball joint in its joint frame, in a posture.
Eigen::Vector3d shaftDirection(const Model& model, const RomMap& map, const Posture& posture);

/// A still picture of a map, with its colour bar in degrees.
struct RomPicture {
  int width_px = 600, height_px = 600;
  Backdrop backdrop = Backdrop::White;
  double widest_rad = 0;  ///< 0: the map's own widest range
  bool colour_bar = true;
  std::optional<Eigen::Vector3d> shaft_J;
  std::optional<RomMap> outline;  ///< its border is drawn too
  std::optional<RomHandles> handles;
  OffscreenOptions quality{2, false};
};

/// Draws it without a display. @throws InputError if the machine cannot (see renderOffscreen()).
RgbImage renderRomSphere(const RomMap& map, const RomPicture& picture = {});

}  // namespace sinew
