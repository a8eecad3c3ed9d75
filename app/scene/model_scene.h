#pragma once
#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/scene/offscreen.h"
#include "core/model/model.h"
#include "core/rom/maps/rom_map.h"

class vtkRenderer;

namespace sinew {

enum class SceneLayer { Bones, Muscles, MechanicalAxes, Landmarks, RomSphere };
enum class StandardView { Front, Back, Right, Left, Oblique };
enum class Backdrop { White, Dark };

/// Axes of the picture in the world: right, up, and towards the viewer.
Eigen::Matrix3d viewAxes(StandardView view);

/// One number per muscle, shown as colour: activation, length change, passive force, ...
struct MuscleScalars {
  std::map<std::string, double> by_unit;  ///< units without a value are grey
  double low = 0, high = 1;               ///< ends of the colour map
  bool diverging = false;                 ///< the middle of low and high is the neutral value
};

/// What lies under the mouse.
struct ScenePick {
  SceneLayer layer = SceneLayer::Bones;
  std::string name;     ///< bone, musculotendon unit or landmark
  Eigen::Vector3d p_W;  ///< the point of its surface [m]
};

/// A musculoskeletal model drawn into a renderer: bones, muscles as spindles along their paths, mechanical axes of
/// the legs, landmarks. World W: X anterior, Y up, Z right [m]. The renderer belongs to the caller and outlives the
/// scene; nothing is drawn here: the caller renders its window after a change.
class ModelScene {
 public:
  explicit ModelScene(vtkRenderer& renderer);
  ~ModelScene();
  ModelScene(const ModelScene&) = delete;
  ModelScene& operator=(const ModelScene&) = delete;

  /// Shows `model` in the zero posture; its bones are taken as they are (already deformed to its shape).
  void setModel(std::shared_ptr<const Model> model);
  /// Moves everything. @throws std::logic_error without a model or with a posture of another size.
  void setPosture(const Posture& q);

  /// Posture, highlighted unit and colours (nullopt: by group) at once: for what follows a hand. Bones are grey while
  /// colours stand for numbers, since ivory is near the middle of one colour map.
  void show(const Posture& q, const std::string& selected, const std::optional<MuscleScalars>& scalars);

  void setVisible(SceneLayer layer, bool visible);
  void setBackdrop(Backdrop backdrop);
  void setBoneOpacity(double opacity);
  /// Shows only these units; nullopt: all.
  void setShownMuscles(std::optional<std::vector<std::string>> units);

  void colourMusclesByGroup();
  void colourMusclesBy(const MuscleScalars& scalars);

  /// Shows where a ball joint lets its bone point, about the joint; nullopt shows nothing. `widest_rad`: the twist
  /// range that gets the darkest colour.
  void setRom(const std::optional<RomMap>& map, double widest_rad = 0);

  /// Highlights one bone or unit; an empty or unknown name highlights nothing.
  void select(const std::string& name);
  /// The nearest visible thing under a point of the render window [px], origin at the bottom left.
  std::optional<ScenePick> pick(double x_px, double y_px) const;

  /// Parallel projection (lengths compare across the picture) that shows all visible layers, with a small margin.
  void lookFrom(StandardView view);
  /// Keeps the direction that is looked from, and moves and zooms until all visible layers are in sight.
  void fitAll();
  /// The same from near by: `half_height_m` above and below of `p_W`.
  void lookAt(StandardView view, const Eigen::Vector3d& p_W, double half_height_m);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// What a close-up shows.
struct PictureFocus {
  Eigen::Vector3d p_W;
  double half_height_m = 0.2;
};

/// A still picture of a model.
struct ModelPicture {
  int width_px = 600, height_px = 900;
  StandardView view = StandardView::Front;
  Backdrop backdrop = Backdrop::White;
  bool muscles = true, mechanical_axes = true, landmarks = false;
  std::optional<MuscleScalars> scalars;  ///< colours by group if absent
  OffscreenOptions quality;
  std::optional<PictureFocus> focus;  ///< the whole body if absent
  std::optional<RomMap> rom;          ///< shown about its joint
  double rom_widest_rad = 0;          ///< the twist range that gets the darkest colour
};

/// Draws it without a display. @throws InputError if the machine cannot (see renderOffscreen()).
RgbImage renderModel(const Model& model, const Posture& posture, const ModelPicture& picture);

}  // namespace sinew
