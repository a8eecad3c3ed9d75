#include "app/plot/svg_parts.h"
#include "core/text.h"

#include <cmath>

namespace sinew {

std::string svgNumber(double value) {
  return fixed(value, 2);
}

std::string tickText(double value) {
  return brief(std::abs(value) < 1e-12 ? 0.0 : value);
}

std::string svgEscaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return out;
}

std::string svgText(double x, double y, const std::string& text, const std::string& more) {
  return "<text x=\"" + svgNumber(x) + "\" y=\"" + svgNumber(y) + "\" " + more + ">" + svgEscaped(text) + "</text>\n";
}

std::string svgLine(double x1, double y1, double x2, double y2, const std::string& stroke) {
  return "<line x1=\"" + svgNumber(x1) + "\" y1=\"" + svgNumber(y1) + "\" x2=\"" + svgNumber(x2) + "\" y2=\"" +
         svgNumber(y2) + "\" stroke=\"" + stroke + "\"/>\n";
}

std::string svgStart(double width, double height) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"" +
         svgNumber(width) + "\" height=\"" + svgNumber(height) + "\" viewBox=\"0 0 " + svgNumber(width) + " " +
         svgNumber(height) + "\" font-family=\"DejaVu Sans, sans-serif\" font-size=\"12\" fill=\"#222222\">\n" +
         "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
}

std::string svgRectangle(double x, double y, double width, double height, const std::string& fill) {
  return "<rect x=\"" + svgNumber(x) + "\" y=\"" + svgNumber(y) + "\" width=\"" + svgNumber(width) + "\" height=\"" +
         svgNumber(height) + "\" fill=\"" + fill + "\"/>\n";
}

}  // namespace sinew
