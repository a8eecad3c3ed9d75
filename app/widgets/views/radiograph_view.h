#pragma once
#include <QImage>
#include <QPixmap>
#include <QPointF>
#include <QString>
#include <QWidget>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/model/view_state.h"
#include "imaging/radiograph/radiograph.h"

namespace sinew {

/// A landmark drawn on a radiograph.
struct MarkOverlay {
  std::string name;
  QPointF uv_px;
  QColor color;
  bool hollow = false;                  ///< computed (a projection), not placed by hand
  std::optional<QPointF> projected_px;  ///< where the geometry puts it: a line shows the residual
};

/// A line drawn on a radiograph: bone contour, epipolar line.
struct LineOverlay {
  std::vector<QPointF> points_px;
  QColor color;
  double width = 1.4;  ///< logical pixels
  bool dashed = false;
};

/// One radiograph: pan (drag with the middle button, or the left on free ground), zoom at the cursor (wheel),
/// window/level (drag with the right button), inversion, marks and lines in image coordinates. Pixel (0, 0) is the
/// centre of the top-left pixel. Drawn with QPainter, so it works on every platform.
class RadiographView : public QWidget {
  Q_OBJECT
 public:
  enum class Tool { Look, Place };

  explicit RadiographView(QWidget* parent = nullptr);

  void setRadiograph(std::shared_ptr<const Radiograph> radiograph);
  const Radiograph* radiograph() const { return radiograph_.get(); }
  /// Shown in the middle instead of an image.
  void setPlaceholder(const QString& text);
  void setDisplay(const DisplayWindow& display);
  void setMarks(std::vector<MarkOverlay> marks, const std::string& selected);
  void setLines(std::vector<LineOverlay> lines);
  void setOrientation(const QString& left_edge, const QString& right_edge);
  void setTool(Tool tool);
  void setLoupe(bool on);
  /// With the Place tool: a click places even on top of a mark (left and right overlap in a lateral view).
  void setPlacing(bool on) { placing_ = on; }

  void fit();
  void oneToOne();
  double zoom() const { return zoom_; }
  /// Brings a point into sight without changing the zoom, if it is not.
  void reveal(const QPointF& uv_px);
  void zoomTo(const QPointF& uv_px, double zoom);

  QPointF toImage(const QPointF& widget) const;
  QPointF toWidget(const QPointF& uv_px) const;
  /// Window in effect: what was set, else the file's own.
  double windowCenter() const;
  double windowWidth() const;

  QSize sizeHint() const override { return {420, 520}; }
  QSize minimumSizeHint() const override { return {160, 160}; }

 signals:
  void displayChanged(const DisplayWindow& display);  ///< by a drag of the right button
  void hovered(const QPointF& uv_px);                 ///< inside of the image
  void left();
  void placed(const QPointF& uv_px);  ///< a click on free ground with the Place tool
  void markPressed(const std::string& name);
  void markDragged(const std::string& name, const QPointF& uv_px);
  void markDropped(const std::string& name, const QPointF& uv_px);
  void markDragCancelled();
  void zoomChanged();

 protected:
  void paintEvent(QPaintEvent*) override;
  void resizeEvent(QResizeEvent*) override;
  void mousePressEvent(QMouseEvent*) override;
  void mouseMoveEvent(QMouseEvent*) override;
  void mouseReleaseEvent(QMouseEvent*) override;
  void wheelEvent(QWheelEvent*) override;
  void keyPressEvent(QKeyEvent*) override;
  void leaveEvent(QEvent*) override;

 private:
  enum class Drag { None, Pan, Window, Mark, Click };

  void setZoomAt(double zoom, const QPointF& widget_point);
  const MarkOverlay* markAt(const QPointF& widget_point) const;
  const QImage& levelImage(int level);
  void paintLines(QPainter& painter, const QRectF& film) const;
  void paintEdges(QPainter& painter) const;
  void paintMarks(QPainter& painter) const;
  void paintLoupe(QPainter& painter);
  void paintScaleBar(QPainter& painter) const;
  void forgetPictures();

  std::shared_ptr<const Radiograph> radiograph_;
  std::vector<Radiograph> halves_;  ///< 1/2, 1/4, ... of the radiograph
  std::vector<QImage> pictures_;    ///< by level, after the window; null until needed
  QString placeholder_, left_edge_, right_edge_;
  DisplayWindow display_;
  std::vector<MarkOverlay> marks_;
  std::vector<LineOverlay> lines_;
  std::string selected_;
  Tool tool_ = Tool::Look;
  bool loupe_ = false, placing_ = false;

  double zoom_ = 1;     ///< logical pixels per image pixel
  QPointF center_px_;   ///< image point in the middle of the widget
  bool fitted_ = true;  ///< follow the size of the widget
  Drag drag_ = Drag::None;
  QPointF press_, last_;
  std::optional<QPointF> cursor_;
  std::string dragged_mark_;
  QPointF grab_offset_px_;
  DisplayWindow display_at_press_;
};

}  // namespace sinew
