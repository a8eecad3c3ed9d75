#include "imaging/radiograph/radiograph.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/file.h"
#include "imaging/radiograph/radiograph_internal.h"

namespace sinew {

bool looksLikePng(std::string_view head) {
  return head.starts_with("\x89PNG\r\n\x1a\n");
}

bool looksLikeTiff(std::string_view head) {
  return head.starts_with(std::string_view{"II*\0", 4}) || head.starts_with(std::string_view{"MM\0*", 4});
}

bool looksLikeDicom(std::string_view head) {
  if (head.size() >= 132 && head.substr(128, 4) == "DICM") return true;
  if (head.size() < 8) return false;
  // Old files have no preamble and begin with an element of group 0002 or 0008, in either byte order.
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(head[i]); };
  const int little = byte(0) | byte(1) << 8, big = byte(0) << 8 | byte(1);
  return little == 2 || little == 8 || big == 2 || big == 8;
}

Radiograph readRadiograph(const std::filesystem::path& file, std::optional<double> declared_spacing_mm) {
  if (declared_spacing_mm && !(*declared_spacing_mm > 0.001 && *declared_spacing_mm < 10))
    throw InputError{{file.string(), "pixel size", "0.001 to 10 mm", std::to_string(*declared_spacing_mm)}};
  std::string head(132, '\0');
  {
    std::ifstream in{file, std::ios::binary};
    if (!in || std::filesystem::is_directory(file)) throw InputError{file.string() + ": cannot be opened"};
    in.read(head.data(), std::streamsize(head.size()));
    head.resize(std::size_t(in.gcount()));
  }
  // DICOM first: its preamble may be the beginning of a TIFF, so that both kinds of program can open the file.
  if (looksLikeDicom(head)) return readDicom(file, declared_spacing_mm);
  if (looksLikePng(head) || looksLikeTiff(head)) return readPlainImage(file, readFile(file), declared_spacing_mm);
  throw InputError{{file.string(), "", "a DICOM, TIFF or PNG image", "another kind of file"}};
}

void setWindowFromPixels(Radiograph& radiograph) {
  std::vector<std::uint64_t> histogram(65536);
  for (std::uint16_t value : *radiograph.pixels) ++histogram[value];
  const auto percentile = [&](double fraction) {
    const double target = fraction * double(radiograph.pixels->size());
    std::uint64_t below = 0;
    for (std::size_t value = 0; value < histogram.size(); ++value)
      if (double(below += histogram[value]) > target) return double(value);
    return 65535.0;
  };
  const double low = percentile(0.01), high = percentile(0.99);
  radiograph.window_center = 0.5 * (low + high) + 0.5;
  radiograph.window_width = std::max(high - low, 1.0) + 1;
}

std::vector<std::uint8_t> displayPixels(const Radiograph& radiograph, double window_center, double window_width,
                                        bool invert) {
  require(radiograph.pixels != nullptr, "radiograph has pixels");
  // One table for all 65536 grey values: DICOM's linear window (PS3.3, C.11.2.1.2.1).
  const double width = std::max(window_width, 1.0 + 1e-9);
  const bool flip = radiograph.monochrome1 != invert;
  std::vector<std::uint8_t> table(65536);
  for (std::size_t value = 0; value < table.size(); ++value) {
    const double t = (double(value) - (window_center - 0.5)) / (width - 1) + 0.5;
    const double shown = 255 * std::clamp(flip ? 1 - t : t, 0.0, 1.0);
    table[value] = std::uint8_t(std::lround(shown));
  }
  std::vector<std::uint8_t> out(radiograph.pixels->size());
  std::transform(radiograph.pixels->begin(), radiograph.pixels->end(), out.begin(),
                 [&](std::uint16_t value) { return table[value]; });
  return out;
}

}  // namespace sinew
