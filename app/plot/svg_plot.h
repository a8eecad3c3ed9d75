#pragma once
#include <string>
#include <vector>

namespace sinew {

/// One line of a plot. Lines differ by dash as well as by colour: legible in grey.
struct PlotLine {
  std::string label;
  std::vector<double> y;  ///< NaN: no point
};

/// One diagram; all of a figure share x.
struct PlotPanel {
  std::string y_label;  ///< with unit
  std::vector<PlotLine> lines;
};

/// A figure of diagrams one below the other, as SVG text.
std::string plotSvg(const std::string& title, const std::string& x_label, const std::vector<double>& x,
                    const std::vector<PlotPanel>& panels);

/// "Nice" tick values (1, 2, 5 times a power of ten) that span [low, high], about `count` of them.
std::vector<double> niceTicks(double low, double high, int count);

}  // namespace sinew
