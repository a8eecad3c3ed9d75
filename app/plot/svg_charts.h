#pragma once
#include <string>
#include <vector>

#include "app/scene/rgb_image.h"

namespace sinew {

// Figures of the experiments as SVG text, besides curves (paint_figure.h). Legible in grey.

/// Numbers over two parameters; the number stands in its field, which is the darker the larger it is.
struct HeatPanel {
  std::string title;
  std::vector<std::vector<double>> values;  ///< [row][column]
};
/// Panels side by side; `darkest`: the value of the darkest field.
std::string heatMapSvg(const std::string& title, const std::string& x_label, const std::vector<std::string>& columns,
                       const std::string& y_label, const std::vector<std::string>& rows,
                       const std::vector<HeatPanel>& panels, double darkest);

/// Bars, a group of them a name: the first series dark, the second light with an edge.
struct BarPanel {
  std::string title;
  std::vector<std::string> names;
  std::vector<std::vector<double>> values;  ///< [series][name]
};
/// Panels side by side.
std::string barsSvg(const std::string& title, const std::string& x_label, const std::vector<std::string>& series,
                    const std::vector<BarPanel>& panels, double longest);

struct CaptionedPicture {
  RgbImage picture;
  std::vector<std::string> caption;  ///< lines below
};
/// Pictures side by side, embedded.
std::string picturesSvg(const std::string& title, const std::vector<CaptionedPicture>& pictures);

}  // namespace sinew
