#include "app/widgets/views/vtk_view.h"

#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkGenericRenderWindowInteractor.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>
#include <vtkRenderer.h>

#include <QHash>
#include <QMouseEvent>
#include <QOpenGLContext>
#include <QOpenGLExtraFunctions>
#include <QTimer>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

namespace sinew {
namespace {

constexpr GLenum kColorAttachment0 = 0x8CE0;
constexpr unsigned kLessOrEqual = 0x0203;
constexpr int kSmoothSamples = 4;  // of a pixel; a processor needs twice the time for them
constexpr int kStill_ms = 250;     // without a request, after which the picture is drawn smooth

/// VTK's generic interactor has no timers of its own: these are Qt's. Its Render() only asks for a repaint.
class QtInteractor : public vtkGenericRenderWindowInteractor {
 public:
  static QtInteractor* New();
  void TerminateApp() override {}  // "q" must not close anything

 protected:
  QtInteractor() { EnableRenderOff(); }
  ~QtInteractor() override { qDeleteAll(timers_); }
  int InternalCreateTimer(int, int type, unsigned long duration_ms) override {
    const int id = ++last_id_;
    auto* timer = new QTimer;
    timer->setSingleShot(type == OneShotTimer);
    QObject::connect(timer, &QTimer::timeout, [this, id] {
      int vtk_id = GetVTKTimerId(id);
      InvokeEvent(vtkCommand::TimerEvent, &vtk_id);
    });
    timers_.insert(id, timer);
    timer->start(int(duration_ms));
    return id;
  }
  int InternalDestroyTimer(int id) override {
    QTimer* timer = timers_.take(id);
    if (!timer) return 0;
    timer->stop();
    timer->deleteLater();
    return 1;
  }

 private:
  QHash<int, QTimer*> timers_;
  int last_id_ = 0;
};
vtkStandardNewMacro(QtInteractor);

void observe(vtkObject* subject, unsigned long event, VtkView* view,
             void (*call)(vtkObject*, unsigned long, void* view, void* answer)) {
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(view);
  command->SetCallback(call);
  subject->AddObserver(event, command);
}

}  // namespace

QSurfaceFormat VtkView::defaultFormat() {
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setVersion(3, 2);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setSwapBehavior(QSurfaceFormat::DoubleBuffer);
  format.setRedBufferSize(8);
  format.setGreenBufferSize(8);
  format.setBlueBufferSize(8);
  format.setAlphaBufferSize(8);
  format.setDepthBufferSize(24);
  format.setSamples(0);  // smoothing happens in VTK's own frame buffer
  return format;
}

VtkView::VtkView(QWidget* parent) : QOpenGLWidget{parent} {
  setFormat(defaultFormat());
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setUpdateBehavior(QOpenGLWidget::NoPartialUpdate);
  window_ = vtkSmartPointer<vtkGenericOpenGLRenderWindow>::New();
  window_->SetFrameBlitModeToNoBlit();  // copyToWidget() does it
  window_->SetReadyForRendering(false);
  window_->SetOwnContext(0);
  window_->SetMultiSamples(kSmoothSamples);
  renderer_ = vtkSmartPointer<vtkRenderer>::New();
  window_->AddRenderer(renderer_);
  interactor_ = vtkSmartPointer<QtInteractor>::New();
  interactor_->SetRenderWindow(window_);
  vtkNew<vtkInteractorStyleTrackballCamera> style;
  interactor_->SetInteractorStyle(style);
  interactor_->Initialize();
  observeWindow();
  still_ = new QTimer{this};
  still_->setSingleShot(true);
  still_->setInterval(kStill_ms);
  connect(still_, &QTimer::timeout, this, [this] {
    if (smooth_) return;
    smooth_ = dirty_ = true;
    update();
  });
}

void VtkView::observeWindow() {
  observe(window_, vtkCommand::WindowMakeCurrentEvent, this, [](vtkObject*, unsigned long, void* self, void*) {
    auto* view = static_cast<VtkView*>(self);
    // Making an already current context current again would bind Qt's frame buffer behind VTK's cached state.
    if (view->isValid() && QOpenGLContext::currentContext() != view->context()) {
      view->makeCurrent();
      view->window_->GetState()->ResetFramebufferBindings();
    }
  });
  observe(window_, vtkCommand::WindowIsCurrentEvent, this, [](vtkObject*, unsigned long, void* self, void* answer) {
    auto* view = static_cast<VtkView*>(self);
    *static_cast<bool*>(answer) = view->context() && QOpenGLContext::currentContext() == view->context();
  });
  const auto yes = [](vtkObject*, unsigned long, void*, void* answer) { *static_cast<int*>(answer) = 1; };
  observe(window_, vtkCommand::WindowSupportsOpenGLEvent, this, yes);
  observe(window_, vtkCommand::WindowIsDirectEvent, this, yes);
  observe(window_, vtkCommand::WindowFrameEvent, this, [](vtkObject*, unsigned long, void* self, void*) {
    auto* view = static_cast<VtkView*>(self);
    if (!view->painting_ && view->window_->GetSwapBuffers()) view->update();
  });
  observe(interactor_, vtkCommand::RenderEvent, this,
          [](vtkObject*, unsigned long, void* self, void*) { static_cast<VtkView*>(self)->requestRender(); });
}

void VtkView::observeCamera() {
  if (camera_) camera_->RemoveObserver(camera_tag_);
  camera_ = renderer_->GetActiveCamera();
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(this);
  command->SetCallback(
      [](vtkObject*, unsigned long, void* self, void*) { static_cast<VtkView*>(self)->cameraMoved(); });
  camera_tag_ = camera_->AddObserver(vtkCommand::ModifiedEvent, command);
}

void VtkView::cameraMoved() {
  // Drawing sets the clipping range, which must not ask for another drawing.
  const double *p = camera_->GetPosition(), *up = camera_->GetViewUp();
  const std::array<double, 7> from{p[0], p[1], p[2], up[0], up[1], up[2], camera_->GetParallelScale()};
  if (from == seen_from_) return;
  seen_from_ = from;
  requestRender();
}

void VtkView::shareCameraWith(VtkView& other) {
  renderer_->SetActiveCamera(other.renderer_->GetActiveCamera());
  observeCamera();
  other.observeCamera();
}

VtkView::~VtkView() {
  if (camera_) camera_->RemoveObserver(camera_tag_);
  if (context()) {
    disconnect(context(), nullptr, this, nullptr);
    releaseContext();
  }
  interactor_->SetRenderWindow(nullptr);
  window_->SetInteractor(nullptr);
  window_->RemoveAllObservers();
  interactor_->RemoveAllObservers();
}

vtkRenderer& VtkView::renderer() {
  return *renderer_;
}

void VtkView::requestRender() {
  dirty_ = true;
  smooth_ = !drawn_by_processor_ || !still_->isActive();
  still_->start();
  update();
}

void VtkView::initializeGL() {
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &VtkView::releaseContext,
          Qt::ConnectionType(Qt::DirectConnection | Qt::UniqueConnection));
  window_->SetReadyForRendering(true);
  window_->SetMapped(1);
  window_->SetIsCurrent(true);
  const auto* name = reinterpret_cast<const char*>(context()->functions()->glGetString(GL_RENDERER));
  drawn_by_processor_ = name && QByteArrayView{name}.contains("llvmpipe");
  auto* state = window_->GetState();
  state->Reset();
  state->vtkglDepthFunc(kLessOrEqual);
  syncSize();
  dirty_ = true;
}

void VtkView::releaseContext() {
  makeCurrent();
  window_->Finalize();
  window_->SetReadyForRendering(false);
  window_->SetMapped(0);
  doneCurrent();
}

void VtkView::syncSize() {
  const double ratio = devicePixelRatioF();
  const int width_px = std::max(1, int(std::lround(width() * ratio)));
  const int height_px = std::max(1, int(std::lround(height() * ratio)));
  window_->SetDPI(int(72 * ratio + 0.5));  // text grows with the screen's scale
  window_->SetSize(width_px, height_px);
  interactor_->SetSize(width_px, height_px);
  interactor_->InvokeEvent(vtkCommand::ConfigureEvent);
}

void VtkView::resizeGL(int, int) {
  syncSize();
  dirty_ = true;
}

void VtkView::paintGL() {
  painting_ = true;
  auto* state = window_->GetState();
  state->Reset();
  state->Push();
  state->vtkglDepthFunc(kLessOrEqual);
  if (dirty_) {
    dirty_ = false;
    window_->SetMultiSamples(smooth_ ? kSmoothSamples : 0);
    window_->Render();
    ++render_count_;
    if (!smooth_) still_->start();
  }
  copyToWidget();
  state->Pop();
  painting_ = false;
}

void VtkView::copyToWidget() {
  makeCurrent();  // an observer may have switched the context
  auto* gl = context()->extraFunctions();
  gl->glBindFramebuffer(GL_DRAW_FRAMEBUFFER, defaultFramebufferObject());
  const GLenum target[1] = {kColorAttachment0};
  gl->glDrawBuffers(1, target);
  window_->GetState()->Reset();
  const int* drawn = window_->GetDisplayFramebuffer()->GetLastSize();
  const double ratio = devicePixelRatioF();
  gl->glDisable(GL_SCISSOR_TEST);
  window_->BlitDisplayFramebuffer(0, 0, 0, drawn[0], drawn[1], 0, 0, int(std::lround(width() * ratio)),
                                  int(std::lround(height() * ratio)), GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl->glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);  // VTK leaves alpha 0: Qt would show what is behind
  gl->glClearColor(0, 0, 0, 1);
  gl->glClear(GL_COLOR_BUFFER_BIT);
  gl->glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void VtkView::tellPosition(const QPointF& position, Qt::KeyboardModifiers modifiers) {
  const double ratio = devicePixelRatioF();
  interactor_->SetEventInformationFlipY(int(position.x() * ratio), int(position.y() * ratio),
                                        modifiers.testFlag(Qt::ControlModifier),
                                        modifiers.testFlag(Qt::ShiftModifier));
}

bool VtkView::forward(QEvent* event) {
  switch (event->type()) {
    case QEvent::MouseMove: {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      tellPosition(mouse->position(), mouse->modifiers());
      interactor_->InvokeEvent(vtkCommand::MouseMoveEvent);
      return true;
    }
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonDblClick:
    case QEvent::MouseButtonRelease: {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      const bool press = event->type() != QEvent::MouseButtonRelease;
      tellPosition(mouse->position(), mouse->modifiers());
      if (press) {
        setFocus(Qt::MouseFocusReason);
        press_ = mouse->position();
      }
      if (mouse->button() == Qt::LeftButton)
        interactor_->InvokeEvent(press ? vtkCommand::LeftButtonPressEvent : vtkCommand::LeftButtonReleaseEvent);
      if (mouse->button() == Qt::MiddleButton)
        interactor_->InvokeEvent(press ? vtkCommand::MiddleButtonPressEvent : vtkCommand::MiddleButtonReleaseEvent);
      if (mouse->button() == Qt::RightButton)
        interactor_->InvokeEvent(press ? vtkCommand::RightButtonPressEvent : vtkCommand::RightButtonReleaseEvent);
      const QPointF moved = mouse->position() - press_;
      if (!press && mouse->button() == Qt::LeftButton && std::hypot(moved.x(), moved.y()) < 4) {
        const double ratio = devicePixelRatioF();
        emit clicked(press_.x() * ratio, (height() - press_.y()) * ratio - 1);
      }
      return true;
    }
    case QEvent::Wheel: {
      auto* wheel = static_cast<QWheelEvent*>(event);
      tellPosition(wheel->position(), wheel->modifiers());
      for (wheel_rest_ += wheel->angleDelta().y(); wheel_rest_ >= 120; wheel_rest_ -= 120)
        interactor_->InvokeEvent(vtkCommand::MouseWheelForwardEvent);
      for (; wheel_rest_ <= -120; wheel_rest_ += 120) interactor_->InvokeEvent(vtkCommand::MouseWheelBackwardEvent);
      wheel->accept();
      return true;
    }
    default:
      return false;
  }
}

bool VtkView::event(QEvent* event) {
  // Qt sends events before the constructor has made the members, and before there is a context. Keys are not passed
  // on: VTK's styles bind single letters to odd things.
  if (window_ && interactor_ && window_->GetReadyForRendering() && forward(event)) return true;
  return QOpenGLWidget::event(event);
}

}  // namespace sinew
