#pragma once
#include <QColor>
#include <QPen>
#include <QRectF>
#include <string>

#include "core/figure.h"

class QPainter;

namespace sinew {

/// The size of everything follows from that of the letters, in the painter's units.
struct FigureStyle {
  double letters = 11;  ///< height of their body
  bool legend = true;   ///< names of curves and band above each panel
};

/// Colours differ in lightness too (Okabe & Ito 2008; contrast 3 : 1 on white), lines in dash as well.
QColor colourOf(LineRole role);
/// `width` in the painter's units.
QPen penOf(LineRole role, double width);
/// Of a band.
QColor bandColour();

/// The one painter of figures: window, PDF, PNG and SVG. Everything is opaque (PDF/A-1).
void paintFigure(QPainter& painter, const QRectF& box, const Figure& figure, const FigureStyle& style = {});

/// As SVG text, the panels one below the other.
std::string svgOf(const Figure& figure);

}  // namespace sinew
