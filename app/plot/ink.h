#pragma once
#include <QColor>
#include <QFont>
#include <QImage>
#include <QPainter>
#include <QRectF>
#include <QString>
#include <vector>

#include "core/figure.h"

namespace sinew {

/// Draws in millimetres from the top left of the page, on any paint device. Everything is opaque (PDF/A-1).
class Ink {
 public:
  /// `painter` maps its window (0.01 mm) to the page; see paintPage().
  explicit Ink(QPainter& painter) : painter_{painter} {}

  struct TextStyle {
    double size_mm = 2.3;  ///< height of the letters' body
    bool bold = false;
    QColor colour = Qt::black;
    int align = Qt::AlignLeft | Qt::AlignTop;
    bool wrap = true;
  };
  void text(const QRectF& box_mm, const QString& text, const TextStyle& style);
  /// Upwards, centred in the box.
  void verticalText(const QRectF& box_mm, const QString& text, const TextStyle& style);
  void line(QPointF from_mm, QPointF to_mm, double width_mm, const QColor& colour,
            Qt::PenStyle style = Qt::SolidLine);
  void polyline(const std::vector<QPointF>& points_mm, double width_mm, const QColor& colour,
                Qt::PenStyle style = Qt::SolidLine);
  void fill(const QRectF& box_mm, const QColor& colour);
  void frame(const QRectF& box_mm, double width_mm, const QColor& colour);
  void disc(QPointF centre_mm, double radius_mm, const QColor& colour, bool filled);
  void image(const QRectF& box_mm, const QImage& image);
  void figure(const QRectF& box_mm, const Figure& figure, double letters_mm);
  void clipTo(const QRectF& box_mm);
  void unclip();

  static QFont font(const TextStyle& style);
  static double textWidth_mm(const QString& text, const TextStyle& style);
  /// Height of the text wrapped to a width.
  static double textHeight_mm(const QString& text, double width_mm, const TextStyle& style);

 private:
  QPainter& painter_;
};

/// Greys and colours of the report; they differ in lightness too.
namespace shade {
inline const QColor kRule{150, 150, 150}, kBand{240, 242, 244}, kHead{222, 227, 232}, kMuted{90, 90, 90},
    kAccent{0, 72, 120}, kRight{230, 126, 0}, kLeft{60, 160, 220};
}

}  // namespace sinew
