#include "app/plot/svg_to_png.h"

#include <QBuffer>
#include <QImage>
#include <QPainter>
#include <QSvgRenderer>

#include "app/plot/gui_application.h"
#include "core/error.h"

namespace sinew {

std::string pngFromSvg(const std::string& svg, double scale) {
  haveGuiApplication();
  QSvgRenderer renderer{QByteArray::fromStdString(svg)};
  require(renderer.isValid(), "the drawing is valid SVG");
  QImage image{renderer.defaultSize() * scale, QImage::Format_RGB32};
  image.fill(Qt::white);
  QPainter painter{&image};
  painter.setRenderHint(QPainter::Antialiasing);
  renderer.render(&painter);
  painter.end();
  QByteArray bytes;
  QBuffer buffer{&bytes};
  buffer.open(QIODevice::WriteOnly);
  require(image.save(&buffer, "PNG"), "an image can be encoded");
  return bytes.toStdString();
}

}  // namespace sinew
