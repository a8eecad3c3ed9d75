#include "app/plot/svg_charts.h"

#include <fmt/format.h>

#include <QByteArray>
#include <algorithm>
#include <cmath>

#include "app/plot/png_file.h"
#include "app/plot/svg_parts.h"
#include "core/text.h"

namespace sinew {
namespace {

constexpr double kTop = 56, kMargin = 24;
constexpr const char* kTitle = "font-size=\"15\" font-weight=\"bold\"";
constexpr const char* kMiddle = "text-anchor=\"middle\"";
constexpr const char* kRight = "text-anchor=\"end\"";
constexpr const char* kDark = "#0b5394";
constexpr const char* kLight = "#f2b28a";

/// White over orange to dark red; darkens evenly.
std::string heatColour(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return fmt::format("#{:02x}{:02x}{:02x}", int(255 - 105 * t * t), int(255 - 215 * t),
                     int(255 - 235 * std::sqrt(t)));
}

std::string heatPanel(const HeatPanel& panel, const std::vector<std::string>& columns,
                      const std::vector<std::string>& rows, double left, double cell_w, double cell_h,
                      double darkest) {
  std::string svg = svgText(left, kTop - 6, panel.title, "font-weight=\"bold\"");
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const double value = panel.values[r][c], x = left + cell_w * double(c), y = kTop + cell_h * double(r);
      const std::string text = fixed(value, 1);
      const bool dark = value > 0.6 * darkest;
      svg +=
          svgRectangle(x, y, cell_w - 1, cell_h - 1, heatColour(value / darkest)) +
          svgText(x + cell_w / 2, y + cell_h / 2 + 4, text, std::string{kMiddle} + (dark ? " fill=\"white\"" : ""));
    }
  for (std::size_t c = 0; c < columns.size(); ++c)
    svg += svgText(left + cell_w * (double(c) + 0.5), kTop + cell_h * double(rows.size()) + 16, columns[c], kMiddle);
  return svg;
}

}  // namespace

std::string heatMapSvg(const std::string& title, const std::string& x_label, const std::vector<std::string>& columns,
                       const std::string& y_label, const std::vector<std::string>& rows,
                       const std::vector<HeatPanel>& panels, double darkest) {
  constexpr double kCellW = 52, kCellH = 34, kLabels = 96, kGap = 30;
  const double panel_w = kCellW * double(columns.size()), bottom = kTop + kCellH * double(rows.size());
  std::string svg = svgStart(kLabels + double(panels.size()) * (panel_w + kGap) + kMargin, bottom + 56) +
                    svgText(kMargin, 24, title, kTitle) + "<text transform=\"translate(20 " +
                    svgNumber((kTop + bottom) / 2) + ") rotate(-90)\" text-anchor=\"middle\">" + svgEscaped(y_label) +
                    "</text>\n";
  for (std::size_t r = 0; r < rows.size(); ++r)
    svg += svgText(kLabels - 8, kTop + kCellH * (double(r) + 0.5) + 4, rows[r], kRight);
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const double left = kLabels + double(p) * (panel_w + kGap);
    svg += heatPanel(panels[p], columns, rows, left, kCellW, kCellH, darkest) +
           svgText(left + panel_w / 2, bottom + 40, x_label, kMiddle);
  }
  return svg + "</svg>\n";
}

std::string barsSvg(const std::string& title, const std::string& x_label, const std::vector<std::string>& series,
                    const std::vector<BarPanel>& panels, double longest) {
  constexpr double kNames = 230, kBars = 260, kRow = 22, kBar = 8;
  std::size_t most = 0;
  for (const BarPanel& panel : panels) most = std::max(most, panel.names.size());
  const double bottom = kTop + 20 + kRow * double(most);
  std::string svg = svgStart(kMargin + double(panels.size()) * (kNames + kBars + kMargin), bottom + 52) +
                    svgText(kMargin, 24, title, kTitle);
  const auto bar = [&](double x, double y, double width, std::size_t s) {
    return svgRectangle(x, y, width, kBar, kDark) +
           (s == 0 ? "" : svgRectangle(x + 0.7, y + 0.7, std::max(0.0, width - 1.4), kBar - 1.4, kLight));
  };
  for (std::size_t s = 0; s < series.size(); ++s)
    svg += bar(kMargin + 180 * double(s), kTop - 18, 28, s) +
           svgText(kMargin + 180 * double(s) + 34, kTop - 10, series[s]);
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const BarPanel& panel = panels[p];
    const double left = kMargin + double(p) * (kNames + kBars + kMargin) + kNames;
    svg += svgText(left, kTop + 12, panel.title, "font-weight=\"bold\"");
    for (int tick = 0; tick <= 4; ++tick) {
      const double x = left + kBars * tick / 4;
      svg += svgLine(x, kTop + 18, x, bottom, "#dddddd") +
             svgText(x, bottom + 16, tickText(longest * tick / 4), kMiddle);
    }
    svg += svgText(left + kBars / 2, bottom + 36, x_label, kMiddle);
    for (std::size_t n = 0; n < panel.names.size(); ++n) {
      const double y = kTop + 20 + kRow * double(n);
      svg += svgText(left - 8, y + kRow / 2 + 3, panel.names[n], kRight);
      for (std::size_t s = 0; s < series.size(); ++s)
        svg += bar(left, y + 2 + (kBar + 1) * double(s), kBars * std::min(1.0, panel.values[s][n] / longest), s);
    }
  }
  return svg + "</svg>\n";
}

std::string picturesSvg(const std::string& title, const std::vector<CaptionedPicture>& pictures) {
  double width = kMargin, height = 0;
  std::size_t lines = 0;
  std::string content;
  for (const CaptionedPicture& p : pictures) {
    const QByteArray png = QByteArray::fromStdString(pngBytes(p.picture));
    content += "<image x=\"" + svgNumber(width) + "\" y=\"40\" width=\"" + std::to_string(p.picture.width_px) +
               "\" height=\"" + std::to_string(p.picture.height_px) + "\" xlink:href=\"data:image/png;base64," +
               png.toBase64().toStdString() + "\"/>\n";
    for (std::size_t l = 0; l < p.caption.size(); ++l)
      content += svgText(width + p.picture.width_px / 2.0, 60 + p.picture.height_px + 18 * double(l), p.caption[l],
                         l == 0 ? std::string{kMiddle} + " font-weight=\"bold\"" : std::string{kMiddle});
    width += p.picture.width_px + kMargin;
    height = std::max(height, double(p.picture.height_px));
    lines = std::max(lines, p.caption.size());
  }
  return svgStart(width, 60 + height + 18 * double(lines)) + svgText(kMargin, 24, title, kTitle) + content +
         "</svg>\n";
}

}  // namespace sinew
