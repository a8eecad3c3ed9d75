#include "app/plot/png_file.h"

#include <QBuffer>
#include <QImage>

#include "core/error.h"
#include "core/file.h"

namespace sinew {

std::string pngBytes(const RgbImage& picture) {
  const QImage image{picture.rgb.data(), picture.width_px, picture.height_px, 3 * picture.width_px,
                     QImage::Format_RGB888};
  QByteArray bytes;
  QBuffer buffer{&bytes};
  buffer.open(QIODevice::WriteOnly);
  require(image.save(&buffer, "PNG"), "an image can be encoded");
  return bytes.toStdString();
}

void writePng(const RgbImage& picture, const std::filesystem::path& file) {
  writeFileAtomically(file, pngBytes(picture));
}

void requirePngName(const std::filesystem::path& file, const std::string& where) {
  if (file.extension() != ".png")
    throw InputError{{where, "--output", "a name that ends in .png", file.filename().string()}};
}

}  // namespace sinew
