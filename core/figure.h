#pragma once
#include <string>
#include <utility>
#include <vector>

namespace sinew {

// Figures of curves as values: what they show, in names and numbers. One painter draws them in the window, on paper
// and into files (app/plot/paint_figure.h).

/// What a line stands for: each has a colour and a dash of its own wherever it is drawn, and is told apart in grey.
enum class LineRole { First, Second, Third, Fourth, Fifth, Before, Alarm, Measured };

struct FigureCurve {
  std::string name;                               ///< in the legend; empty: not there
  std::vector<std::pair<double, double>> points;  ///< x, y; a y that is not finite interrupts the line
  LineRole role = LineRole::First;
};

/// A line across the panel: at a value of y if horizontal, else of x.
struct FigureMark {
  std::string name;  ///< written beside it
  double value = 0;
  LineRole role = LineRole::Measured;
  bool horizontal = false;
};

struct FigureDot {
  double x = 0, y = 0;
  LineRole role = LineRole::First;
};

/// A shaded range of x, a norm's say; none if low >= high.
struct FigureBand {
  double low = 0, high = 0;
  std::string name;
};

struct FigurePanel {
  std::string y_label;  ///< with unit
  std::vector<FigureCurve> curves;
  std::vector<FigureMark> marks;
  std::vector<FigureDot> dots;
  FigureBand band;
  bool from_zero = false;  ///< y always shows zero
  double highest = 0;      ///< y beyond this is cut off, and below minus a quarter of it; 0: no limit
};

/// Panels one below the other that share x.
struct Figure {
  std::string title;
  std::string x_label;  ///< with unit
  std::vector<FigurePanel> panels;
};

/// One curve over the xs of a figure, in the role of its place. @pre as many ys as xs.
FigureCurve curveOver(const std::vector<double>& x, const std::vector<double>& y, std::string name,
                      std::size_t place = 0);

/// A round step (1, 2 or 5 times a power of ten) that divides `span` into at most `most` parts.
double roundStep(double span, int most);

struct FigureRange {
  double low = 0, high = 1;
};
/// Of x over all panels, and of y of one, with some room so that no line lies on the edge.
FigureRange rangeOfX(const Figure& figure);
FigureRange rangeOfY(const FigurePanel& panel);

}  // namespace sinew
