#include "app/plot/ink.h"

#include <QFontMetricsF>
#include <algorithm>
#include <cmath>

#include "app/plot/paint_figure.h"

namespace sinew {
namespace {

constexpr double kUnits = 100;  // painter units a millimetre: fine enough for whole-number font sizes

QRectF units(const QRectF& mm) {
  return {mm.x() * kUnits, mm.y() * kUnits, mm.width() * kUnits, mm.height() * kUnits};
}
QPointF units(QPointF mm) {
  return mm * kUnits;
}

QPen pen(double width_mm, const QColor& colour, Qt::PenStyle style) {
  QPen p{colour, width_mm * kUnits, style, Qt::FlatCap, Qt::RoundJoin};
  if (style == Qt::CustomDashLine || style == Qt::DashLine) p.setDashPattern({5, 3});
  return p;
}

}  // namespace

QFont Ink::font(const TextStyle& style) {
  // Installed by the packages fonts-dejavu-core and fonts-nanum; the second has the Korean names.
  QFont f{QStringList{"DejaVu Sans", "NanumGothic", "Noto Sans CJK KR"}};
  f.setPixelSize(std::max(1, int(std::lround(style.size_mm * kUnits))));
  f.setBold(style.bold);
  f.setHintingPreference(QFont::PreferNoHinting);
  return f;
}

double Ink::textWidth_mm(const QString& text, const TextStyle& style) {
  return QFontMetricsF{font(style)}.horizontalAdvance(text) / kUnits;
}

double Ink::textHeight_mm(const QString& text, double width_mm, const TextStyle& style) {
  const QRectF room{0, 0, width_mm * kUnits, 1e7};
  return QFontMetricsF{font(style)}
             .boundingRect(room, Qt::TextWordWrap | Qt::AlignLeft | Qt::AlignTop, text)
             .height() /
         kUnits;
}

void Ink::text(const QRectF& box_mm, const QString& text, const TextStyle& style) {
  painter_.setFont(font(style));
  painter_.setPen(style.colour);
  painter_.drawText(units(box_mm), style.align | (style.wrap ? Qt::TextWordWrap : Qt::TextSingleLine), text);
}

void Ink::verticalText(const QRectF& box_mm, const QString& text, const TextStyle& style) {
  painter_.save();
  painter_.translate(units(box_mm.center()));
  painter_.rotate(-90);
  painter_.setFont(font(style));
  painter_.setPen(style.colour);
  const QRectF turned{-box_mm.height() / 2, -box_mm.width() / 2, box_mm.height(), box_mm.width()};
  painter_.drawText(units(turned), Qt::AlignCenter | Qt::TextSingleLine, text);
  painter_.restore();
}

void Ink::line(QPointF from_mm, QPointF to_mm, double width_mm, const QColor& colour, Qt::PenStyle style) {
  painter_.setPen(pen(width_mm, colour, style));
  painter_.drawLine(units(from_mm), units(to_mm));
}

void Ink::polyline(const std::vector<QPointF>& points_mm, double width_mm, const QColor& colour, Qt::PenStyle style) {
  QList<QPointF> points;
  points.reserve(qsizetype(points_mm.size()));
  for (const auto& p : points_mm) points.push_back(units(p));
  painter_.setPen(pen(width_mm, colour, style));
  painter_.setBrush(Qt::NoBrush);
  painter_.drawPolyline(points.data(), int(points.size()));
}

void Ink::fill(const QRectF& box_mm, const QColor& colour) {
  painter_.fillRect(units(box_mm), colour);
}

void Ink::frame(const QRectF& box_mm, double width_mm, const QColor& colour) {
  painter_.setPen(pen(width_mm, colour, Qt::SolidLine));
  painter_.setBrush(Qt::NoBrush);
  painter_.drawRect(units(box_mm));
}

void Ink::disc(QPointF centre_mm, double radius_mm, const QColor& colour, bool filled) {
  painter_.setPen(pen(0.2, colour, Qt::SolidLine));
  painter_.setBrush(filled ? QBrush{colour} : QBrush{Qt::white});
  painter_.drawEllipse(units(centre_mm), radius_mm * kUnits, radius_mm * kUnits);
}

void Ink::image(const QRectF& box_mm, const QImage& image) {
  painter_.setRenderHint(QPainter::SmoothPixmapTransform);
  painter_.drawImage(units(box_mm), image);
}

void Ink::figure(const QRectF& box_mm, const Figure& figure, double letters_mm) {
  painter_.save();
  painter_.setFont(font({}));
  paintFigure(painter_, units(box_mm), figure, {.letters = letters_mm * kUnits, .legend = false});
  painter_.restore();
}

void Ink::clipTo(const QRectF& box_mm) {
  painter_.save();
  painter_.setClipRect(units(box_mm));
}
void Ink::unclip() {
  painter_.restore();
}

}  // namespace sinew
