#include "app/plot/paint_figure.h"

#include <QBuffer>
#include <QFontMetricsF>
#include <QPainter>
#include <QSvgGenerator>
#include <algorithm>
#include <cmath>

#include "app/plot/gui_application.h"

namespace sinew {
namespace {

const QColor kText{0x1b, 0x27, 0x31}, kMuted{0x56, 0x66, 0x74}, kGrid{0xe0, 0xe5, 0xea}, kZero{0x9a, 0xa5, 0xb0},
    kFrame{0xc3, 0xcc, 0xd5};

QString q(const std::string& text) {
  return QString::fromStdString(text);
}

/// A number with as many decimals as steps of that size need.
QString tickText(double value, double step) {
  const int decimals = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 6);
  return QString::number(std::abs(value) < 1e-9 * step ? 0.0 : value, 'f', decimals);
}

/// One panel on its place of the drawing.
class PanelPainter {
 public:
  PanelPainter(QPainter& painter, const QRectF& area, const FigureRange& x, const FigurePanel& panel,
               const FigureStyle& style)
      : painter_{painter}, area_{area}, x_{x}, y_{rangeOfY(panel)}, panel_{panel}, style_{style} {}

  void paint(bool with_x_ticks) {
    paintBand();
    paintTicks(with_x_ticks);
    painter_.save();
    painter_.setClipRect(area_);
    for (const auto& mark : panel_.marks) paintMark(mark);
    for (const auto& curve : panel_.curves) paintCurve(curve);
    for (const auto& dot : panel_.dots) paintDot(dot);
    for (const auto& mark : panel_.marks) paintName(mark);
    painter_.restore();
    if (style_.legend) paintLegend();
  }

 private:
  double em() const { return style_.letters; }
  double toU(double x) const { return area_.left() + (x - x_.low) / (x_.high - x_.low) * area_.width(); }
  double toV(double y) const { return area_.bottom() - (y - y_.low) / (y_.high - y_.low) * area_.height(); }

  void line(QPointF from, QPointF to, const QPen& pen) {
    painter_.setPen(pen);
    painter_.drawLine(from, to);
  }
  void text(const QRectF& box, int align, const QString& what, const QColor& colour = kMuted) {
    painter_.setPen(colour);
    painter_.drawText(box, align | Qt::TextSingleLine, what);
  }

  void paintBand() {
    if (!(panel_.band.low < panel_.band.high)) return;
    const double from = std::clamp(toU(panel_.band.low), area_.left(), area_.right());
    const double to = std::clamp(toU(panel_.band.high), area_.left(), area_.right());
    painter_.fillRect(QRectF{from, area_.top(), to - from, area_.height()}, bandColour());
  }

  void paintTicks(bool with_x_ticks) {
    const double step_x = roundStep(x_.high - x_.low, std::max(2, int(area_.width() / (4.4 * em()))));
    const double step_y = roundStep(y_.high - y_.low, std::max(2, int(area_.height() / (2.2 * em()))));
    const double hair = 0.09 * em();
    for (double t = std::ceil(x_.low / step_x) * step_x; t <= x_.high + 1e-9 * step_x; t += step_x) {
      line({toU(t), area_.top()}, {toU(t), area_.bottom()}, QPen{kGrid, hair});
      if (with_x_ticks)
        text({toU(t) - 4 * em(), area_.bottom() + 0.3 * em(), 8 * em(), 1.4 * em()}, Qt::AlignHCenter | Qt::AlignTop,
             tickText(t, step_x));
    }
    for (double t = std::ceil(y_.low / step_y) * step_y; t <= y_.high + 1e-9 * step_y; t += step_y) {
      line({area_.left(), toV(t)}, {area_.right(), toV(t)}, QPen{std::abs(t) < 1e-9 * step_y ? kZero : kGrid, hair});
      text({area_.left() - 6.5 * em(), toV(t) - 0.8 * em(), 6 * em(), 1.6 * em()}, Qt::AlignRight | Qt::AlignVCenter,
           tickText(t, step_y));
    }
    painter_.setBrush(Qt::NoBrush);
    painter_.setPen(QPen{kFrame, hair});
    painter_.drawRect(area_);
    const double left = area_.left() - 3.6 * em();
    text({left, area_.top() - 1.9 * em(), area_.right() - left, 1.5 * em()}, Qt::AlignLeft | Qt::AlignBottom,
         q(panel_.y_label));
  }

  void paintMark(const FigureMark& mark) {
    const QPen pen{colourOf(mark.role), 0.13 * em(), Qt::DotLine};
    if (mark.horizontal)
      line({area_.left(), toV(mark.value)}, {area_.right(), toV(mark.value)}, pen);
    else
      line({toU(mark.value), area_.top()}, {toU(mark.value), area_.bottom()}, pen);
  }

  void paintCurve(const FigureCurve& curve) {
    painter_.setPen(penOf(curve.role, 0.18 * em()));
    painter_.setBrush(Qt::NoBrush);
    const double beyond =
        2 * area_.height();  // clipped; keeps coordinates of a steep curve within the device's range
    QPolygonF piece;
    const auto finish = [&] {
      if (piece.size() > 1) painter_.drawPolyline(piece);
      piece.clear();
    };
    for (const auto& [x, y] : curve.points) {
      if (!std::isfinite(x) || !std::isfinite(y)) {
        finish();
        continue;
      }
      piece << QPointF{toU(x), std::clamp(toV(y), area_.top() - beyond, area_.bottom() + beyond)};
    }
    finish();
  }

  void paintDot(const FigureDot& dot) {
    if (!std::isfinite(dot.x) || !std::isfinite(dot.y)) return;
    painter_.setPen(Qt::NoPen);
    painter_.setBrush(colourOf(dot.role));
    painter_.drawEllipse(QPointF{toU(dot.x), toV(dot.y)}, 0.38 * em(), 0.38 * em());
  }

  /// A horizontal mark's name at the left, unless that of a vertical one is there; a vertical one's towards the
  /// middle.
  void paintName(const FigureMark& mark) {
    if (mark.name.empty()) return;
    const double width = QFontMetricsF{painter_.font()}.horizontalAdvance(q(mark.name)) + 0.4 * em();
    QRectF box;
    if (mark.horizontal) {
      const bool taken = std::ranges::any_of(panel_.marks, [&](const FigureMark& m) {
        return !m.horizontal && toU(m.value) < area_.left() + area_.width() / 3;
      });
      box = {taken ? area_.right() - width - 0.4 * em() : area_.left() + 0.4 * em(), toV(mark.value) - 1.5 * em(),
             width, 1.35 * em()};
    } else {
      const bool near_right = toU(mark.value) > area_.center().x();
      box = {near_right ? toU(mark.value) - width - 0.3 * em() : toU(mark.value) + 0.3 * em(),
             area_.top() + 0.15 * em(), width, 1.4 * em()};
      painter_.fillRect(box, Qt::white);  // curves run below
    }
    text(box, Qt::AlignCenter, q(mark.name), colourOf(mark.role));
  }

  /// From the right edge leftwards, the first curve leftmost.
  void paintLegend() {
    double x = area_.right();
    const double y = area_.top() - 1.05 * em();
    const auto entry = [&](const std::string& name, const auto& sample) {
      if (name.empty()) return;
      const double width = QFontMetricsF{painter_.font()}.horizontalAdvance(q(name));
      x -= width;
      text({x, y - 0.8 * em(), width + em(), 1.6 * em()}, Qt::AlignLeft | Qt::AlignVCenter, q(name), kText);
      sample(QRectF{x - 2.5 * em(), y - 0.45 * em(), 2.1 * em(), 0.9 * em()});
      x -= 3.5 * em();
    };
    if (panel_.band.low < panel_.band.high)
      entry(panel_.band.name, [&](const QRectF& box) { painter_.fillRect(box, bandColour().darker(108)); });
    for (auto curve = panel_.curves.rbegin(); curve != panel_.curves.rend(); ++curve)
      entry(curve->name, [&](const QRectF& box) {
        line({box.left(), box.center().y()}, {box.right(), box.center().y()}, penOf(curve->role, 0.18 * em()));
      });
  }

  QPainter& painter_;
  QRectF area_;
  FigureRange x_, y_;
  const FigurePanel& panel_;
  const FigureStyle& style_;
};

}  // namespace

QColor colourOf(LineRole role) {
  switch (role) {
    case LineRole::First:
      return {0x0b, 0x6b, 0x8c};
    case LineRole::Second:
      return {0xb4, 0x53, 0x09};
    case LineRole::Third:
      return {0x3f, 0x62, 0x12};
    case LineRole::Fourth:
      return {0x7c, 0x3a, 0xed};
    case LineRole::Fifth:
      return {0xbe, 0x12, 0x3c};
    case LineRole::Before:
      return kMuted;
    case LineRole::Alarm:
      return {0xa8, 0x26, 0x1c};
    case LineRole::Measured:
      return kText;
  }
  return kText;
}

QPen penOf(LineRole role, double width) {
  QPen pen{colourOf(role), width, Qt::SolidLine, Qt::FlatCap, Qt::RoundJoin};
  switch (role) {
    case LineRole::Second:
      pen.setDashPattern({3.5, 2});
      break;
    case LineRole::Third:
      pen.setDashPattern({1, 1.5});
      break;
    case LineRole::Fourth:
      pen.setDashPattern({5, 1.5, 1, 1.5});
      break;
    case LineRole::Fifth:
      pen.setDashPattern({2, 1});
      break;
    case LineRole::Before:
    case LineRole::Alarm:
      pen.setDashPattern({5, 3});
      break;
    default:
      break;
  }
  return pen;
}

QColor bandColour() {
  return {0xdf, 0xf3, 0xe7};
}

void paintFigure(QPainter& painter, const QRectF& box, const Figure& figure, const FigureStyle& style) {
  if (figure.panels.empty()) return;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  QFont font = painter.font();
  font.setPixelSize(std::max(1, int(std::lround(style.letters))));
  painter.setFont(font);
  const double em = style.letters;
  QRectF room = box;
  if (!figure.title.empty()) {
    font.setBold(true);
    painter.setFont(font);
    painter.setPen(kText);
    painter.drawText(QRectF{box.left(), box.top(), box.width(), 1.6 * em}, Qt::AlignLeft | Qt::AlignVCenter,
                     q(figure.title));
    font.setBold(false);
    painter.setFont(font);
    room.setTop(box.top() + 1.7 * em);
  }
  room.adjust(4 * em, 0, -1.3 * em, -3.4 * em);
  const FigureRange x = rangeOfX(figure);
  const double above = 2.4 * em, height = room.height() / static_cast<double>(figure.panels.size());
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const QRectF area{room.left(), room.top() + static_cast<double>(i) * height + above, room.width(),
                      height - above};
    PanelPainter{painter, area, x, figure.panels[i], style}.paint(i + 1 == figure.panels.size());
  }
  const QRectF below{box.left(), room.bottom() + 1.7 * em, box.width() - 1.3 * em, 1.5 * em};
  const double wide = QFontMetricsF{font}.horizontalAdvance(q(figure.x_label));
  if (wide > below.width()) {  // a long convention stays whole
    font.setPixelSize(std::max(1, int(em * below.width() / wide)));
    painter.setFont(font);
  }
  painter.setPen(kMuted);
  painter.drawText(below, Qt::AlignRight | Qt::AlignVCenter | Qt::TextSingleLine, q(figure.x_label));
  painter.restore();
}

std::string svgOf(const Figure& figure) {
  haveGuiApplication();
  constexpr int kWidth = 720, kPanelHeight = 260, kAround = 70;
  const QRect box{0, 0, kWidth, kAround + kPanelHeight * int(figure.panels.size())};
  QByteArray bytes;
  QBuffer buffer{&bytes};
  QSvgGenerator svg;
  svg.setOutputDevice(&buffer);
  svg.setSize(box.size());
  svg.setViewBox(box);
  svg.setResolution(96);
  svg.setTitle(q(figure.title));
  QPainter painter{&svg};
  painter.setFont(QFont{QStringList{"DejaVu Sans", "NanumGothic", "sans-serif"}});
  painter.fillRect(box, Qt::white);
  paintFigure(painter, QRectF{box}.adjusted(10, 10, -10, -10), figure, {.letters = 12});
  painter.end();
  return bytes.sliced(std::max<qsizetype>(0, bytes.indexOf("<svg"))).toStdString();
}

}  // namespace sinew
