#pragma once
#include <QLabel>
#include <QWidget>
#include <memory>
#include <optional>
#include <string>

#include "app/scene/model_scene.h"
#include "core/model/model.h"

class QHBoxLayout;
class QStackedLayout;
class QToolButton;

namespace sinew {

class VtkView;

/// Whether QOpenGLWidget works here; "offscreen" and its like have none.
bool platformHasOpenGl();

/// The 3-D model with its tools: standard views and layers. On a platform without OpenGL a still picture of the same
/// scene, drawn without a display, takes its place.
class ModelView : public QWidget {
  Q_OBJECT
 public:
  ModelView(const QString& object_name, bool with_muscles, QWidget* parent = nullptr);
  ~ModelView() override;

  /// nullptr: shows `placeholder` instead.
  void setModel(std::shared_ptr<const Model> model, const Posture& posture, const QString& placeholder);
  void select(const std::string& name);
  /// Shows a ball joint's map about the joint; nullopt: none.
  void showRom(const std::optional<RomMap>& map, double widest_rad = 0);
  /// Posture, highlighted unit and colours (nullopt: by group) of the model that is shown, at once: quick enough to
  /// follow a slider.
  void show(const Posture& posture, const std::string& selected, const std::optional<MuscleScalars>& scalars);
  /// Everything in sight, seen from the same side.
  void fit();
  /// Hides the mechanical axes and their button, for narrow places where they say nothing.
  void withoutAxes();
  VtkView* vtkView() { return vtk_; }

 signals:
  void picked(const std::string& name);

 private:
  void buildTools(QHBoxLayout& tools, const QString& object_name);
  void lookFrom(int standard_view);
  void redraw();

  bool with_muscles_;
  VtkView* vtk_ = nullptr;
  std::unique_ptr<ModelScene> scene_;
  QLabel* still_ = nullptr;
  QLabel* placeholder_;
  QStackedLayout* stack_;
  std::shared_ptr<const Model> model_;
  Posture posture_;
  std::optional<MuscleScalars> scalars_;
  QToolButton* axes_button_ = nullptr;
  int standard_view_ = 0;
  bool framed_ = false;
  bool bones_ = true, muscles_ = true, axes_ = true, landmarks_ = false;
};

}  // namespace sinew
