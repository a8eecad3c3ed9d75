#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "app/model/stage_text.h"
#include "app/widgets/controls/theme.h"
#include "app/widgets/views/radiograph_view.h"

namespace sinew {
namespace {

constexpr double kLoupeRadius = 62, kLoupeZoom = 4;

}  // namespace

const QImage& RadiographView::levelImage(int level) {
  QImage& picture = pictures_[std::size_t(level)];
  if (picture.isNull()) {
    const Radiograph& source = level == 0 ? *radiograph_ : halves_[std::size_t(level - 1)];
    const auto grey = displayPixels(source, windowCenter(), windowWidth(), display_.invert);
    picture = QImage{source.width_px, source.height_px, QImage::Format_Grayscale8};
    for (int v = 0; v < source.height_px; ++v)
      std::copy_n(grey.data() + std::size_t(v) * std::size_t(source.width_px), source.width_px, picture.scanLine(v));
  }
  return picture;
}

void RadiographView::paintEvent(QPaintEvent*) {
  QPainter painter{this};
  painter.fillRect(rect(), colour::kView);
  if (!radiograph_) {
    painter.setPen(QColor{0x8d, 0x9d, 0xab});
    painter.drawText(rect().adjusted(24, 24, -24, -24), Qt::AlignCenter | Qt::TextWordWrap, placeholder_);
    return;
  }
  const double device_zoom = zoom_ * devicePixelRatioF();
  const int level = std::clamp(int(std::floor(-std::log2(std::max(device_zoom, 1e-6)))), 0, int(halves_.size()));
  const QImage& picture = levelImage(level);
  const double scale = double(1 << level);
  // Pixel (0, 0) is a centre: the picture's corner lies half a pixel up and left of it.
  const QRectF target{toWidget({-0.5, -0.5}),
                      QSizeF{picture.width() * scale * zoom_, picture.height() * scale * zoom_}};
  painter.setRenderHint(QPainter::SmoothPixmapTransform, device_zoom < 4);
  painter.drawImage(target, picture);

  painter.setRenderHint(QPainter::Antialiasing);
  paintLines(painter, target);
  paintMarks(painter);
  paintScaleBar(painter);
  paintEdges(painter);
  if (loupe_ && cursor_ && (tool_ == Tool::Place || drag_ == Drag::Mark)) paintLoupe(painter);
}

void RadiographView::paintLines(QPainter& painter, const QRectF& film) const {
  painter.save();
  painter.setClipRect(film);  // nothing was seen beyond the film
  for (const auto& line : lines_) {
    QPolygonF polygon;
    for (const auto& p : line.points_px) polygon << toWidget(p);
    QPen pen{line.color, line.width};
    if (line.dashed) pen.setDashPattern({5, 4});
    painter.setPen(pen);
    painter.drawPolyline(polygon);
  }
  painter.restore();
}

void RadiographView::paintEdges(QPainter& painter) const {
  QFont large = font();
  large.setPixelSize(18);
  large.setBold(true);
  painter.setFont(large);
  painter.setPen(colour::kViewText);
  painter.drawText(rect().adjusted(12, 0, -12, 0), Qt::AlignLeft | Qt::AlignVCenter, left_edge_);
  painter.drawText(rect().adjusted(12, 0, -12, 0), Qt::AlignRight | Qt::AlignVCenter, right_edge_);
}

void RadiographView::paintMarks(QPainter& painter) const {
  for (const auto& mark : marks_) {
    const bool selected = mark.name == selected_;
    const QPointF p = toWidget(mark.uv_px);
    if (!QRectF(rect()).adjusted(-20, -20, 20, 20).contains(p)) continue;
    const QColor color = selected ? colour::kSelected : mark.color;
    if (mark.projected_px) {
      painter.setPen(QPen{QColor{0xff, 0x6b, 0x5e}, 1.6});
      painter.drawLine(p, toWidget(*mark.projected_px));
    }
    for (const double width : {3.6, 1.6}) {  // a dark rim keeps the mark visible on bright bone
      painter.setPen(QPen{width > 2 ? QColor{0, 0, 0, 150} : color, width});
      painter.setBrush(Qt::NoBrush);
      if (mark.hollow) {
        painter.drawEllipse(p, 5, 5);
      } else {
        const double arm = selected ? 8 : 5;
        painter.drawLine(p - QPointF{arm, 0}, p + QPointF{arm, 0});
        painter.drawLine(p - QPointF{0, arm}, p + QPointF{0, arm});
        if (selected) painter.drawEllipse(p, 11, 11);
      }
    }
    if (selected && drag_ != Drag::Mark) {
      const QString text = readableName(mark.name);
      QFont small = font();
      small.setPixelSize(12);
      painter.setFont(small);
      const QRectF box = painter.fontMetrics().boundingRect(text).adjusted(-6, -3, 6, 3);
      QRectF place{p + QPointF{16, -box.height() / 2}, box.size()};
      if (place.right() > width() - 4) place.moveRight(p.x() - 16);
      painter.setPen(Qt::NoPen);
      painter.setBrush(QColor{10, 15, 20, 205});
      painter.drawRoundedRect(place, 4, 4);
      painter.setPen(colour::kSelected);
      painter.drawText(place, Qt::AlignCenter, text);
    }
  }
}

void RadiographView::paintLoupe(QPainter& painter) {
  const QPointF at = *cursor_;
  QPointF middle = at + QPointF{kLoupeRadius + 26, -kLoupeRadius - 26};
  if (middle.x() + kLoupeRadius > width()) middle.setX(at.x() - kLoupeRadius - 26);
  if (middle.y() - kLoupeRadius < 0) middle.setY(at.y() + kLoupeRadius + 26);
  const double zoom = std::max(zoom_ * kLoupeZoom, 1.0);
  const QPointF center = toImage(at);
  painter.save();
  QPainterPath lens;
  lens.addEllipse(middle, kLoupeRadius, kLoupeRadius);
  painter.setClipPath(lens);
  painter.fillPath(lens, colour::kView);
  const QImage& picture = levelImage(0);
  painter.drawImage(QRectF{middle - QPointF{(center.x() + 0.5) * zoom, (center.y() + 0.5) * zoom},
                           QSizeF{picture.width() * zoom, picture.height() * zoom}},
                    picture);
  painter.setPen(QPen{colour::kSelected, 1});
  painter.drawLine(middle - QPointF{kLoupeRadius, 0}, middle - QPointF{6, 0});
  painter.drawLine(middle + QPointF{6, 0}, middle + QPointF{kLoupeRadius, 0});
  painter.drawLine(middle - QPointF{0, kLoupeRadius}, middle - QPointF{0, 6});
  painter.drawLine(middle + QPointF{0, 6}, middle + QPointF{0, kLoupeRadius});
  painter.restore();
  painter.setPen(QPen{colour::kViewText, 1.5});
  painter.setBrush(Qt::NoBrush);
  painter.drawEllipse(middle, kLoupeRadius, kLoupeRadius);
}

void RadiographView::paintScaleBar(QPainter& painter) const {
  const bool known = radiograph_->spacing && radiograph_->spacing->source != PixelScaleSource::None;
  const double unit = known ? zoom_ / radiograph_->spacing->column_mm : zoom_;  // logical pixels per mm (or px)
  double length = known ? 10 : 100;
  for (const double candidate : {20., 50., 100., 200., 500., 1000., 2000.})
    if (candidate * unit < width() * 0.4 && candidate > length) length = candidate;
  const QPointF from{14, height() - 16.0}, to{14 + length * unit, height() - 16.0};
  painter.setPen(QPen{colour::kViewText, 2});
  painter.drawLine(from, to);
  painter.drawLine(from - QPointF{0, 4}, from + QPointF{0, 4});
  painter.drawLine(to - QPointF{0, 4}, to + QPointF{0, 4});
  QFont small = font();
  small.setPixelSize(11);
  painter.setFont(small);
  QString text = known ? QStringLiteral("%1 mm").arg(length) : QStringLiteral("%1 px").arg(length);
  if (known && radiograph_->spacing->source == PixelScaleSource::ImagerAtDetector) text += tr(" at the detector");
  painter.drawText(from + QPointF{0, -8}, text);
}

}  // namespace sinew
