#pragma once
#include <QLabel>
#include <QWidget>
#include <memory>
#include <optional>
#include <string>

#include "core/model/model.h"

class QHBoxLayout;
class QStackedLayout;

namespace sinew {

class ModelScene;
class VtkView;

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
  int standard_view_ = 0;
  bool framed_ = false;
  bool bones_ = true, muscles_ = true, axes_ = true, landmarks_ = false;
};

}  // namespace sinew
