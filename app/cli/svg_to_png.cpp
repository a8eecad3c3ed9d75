#include "app/cli/svg_to_png.h"

#include <QBuffer>
#include <QGuiApplication>
#include <QImage>
#include <QPainter>
#include <QSvgRenderer>
#include <memory>

#include "core/error.h"

namespace sinew {

std::string pngFromSvg(const std::string& svg, double scale) {
  // Text needs an application for its fonts; the offscreen platform needs no display.
  std::unique_ptr<QGuiApplication> application;
  static int argc = 1;
  static char name[] = "sinew";
  static char* argv[] = {name, nullptr};
  if (!QCoreApplication::instance()) {
    qputenv("QT_QPA_PLATFORM", "offscreen");
    application = std::make_unique<QGuiApplication>(argc, argv);
  }
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
