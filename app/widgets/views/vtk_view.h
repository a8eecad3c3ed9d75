#pragma once
#include <vtkSmartPointer.h>

#include <QOpenGLWidget>
#include <QSurfaceFormat>
#include <array>

class QTimer;
class vtkCamera;
class vtkGenericOpenGLRenderWindow;
class vtkRenderer;
class vtkRenderWindowInteractor;

namespace sinew {

/// VTK inside a Qt 6 window: a vtkGenericOpenGLRenderWindow that draws with this widget's OpenGL context. Left drag
/// turns, middle or Shift + left drag moves, wheel zooms. Needs a platform with OpenGL: not "offscreen". Where a
/// processor draws, pictures that follow each other closely have rough edges; the last of them is drawn smooth.
class VtkView : public QOpenGLWidget {
  Q_OBJECT
 public:
  explicit VtkView(QWidget* parent = nullptr);
  ~VtkView() override;

  /// To be installed with QSurfaceFormat::setDefaultFormat() before QApplication.
  static QSurfaceFormat defaultFormat();

  vtkRenderer& renderer();
  void requestRender();
  bool isSmooth() const { return smooth_; }  ///< the picture shown has smooth edges
  /// Both views look from the same place from now on: turning one turns the other.
  void shareCameraWith(VtkView& other);
  int renderCount() const { return render_count_; }

 signals:
  /// A press and release at one place; [device px], origin at the bottom left.
  void clicked(double x_px, double y_px);

 protected:
  void initializeGL() override;
  void resizeGL(int width, int height) override;
  void paintGL() override;
  bool event(QEvent* event) override;

 private:
  void observeWindow();
  void observeCamera();
  void cameraMoved();
  void releaseContext();
  void syncSize();
  bool forward(QEvent* event);
  void tellPosition(const QPointF& position, Qt::KeyboardModifiers modifiers);
  void copyToWidget();

  vtkSmartPointer<vtkGenericOpenGLRenderWindow> window_;
  vtkSmartPointer<vtkRenderWindowInteractor> interactor_;
  vtkSmartPointer<vtkRenderer> renderer_;
  vtkSmartPointer<vtkCamera> camera_;
  unsigned long camera_tag_ = 0;
  std::array<double, 7> seen_from_{};
  QPointF press_;
  QTimer* still_;  ///< runs while pictures follow each other
  bool dirty_ = true, painting_ = false, drawn_by_processor_ = false, smooth_ = true;
  int render_count_ = 0, wheel_rest_ = 0;
};

}  // namespace sinew
