#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/text.h"
#include "imaging/radiograph/dicom_internal.h"
#include "imaging/radiograph/pixel_spacing.h"
#include "imaging/radiograph/radiograph_internal.h"

namespace sinew {
namespace {

/// OpenCV's decoders throw, print and may return nothing: all of that becomes an empty matrix.
cv::Mat decodeQuietly(const void* bytes, std::size_t count) {
  using namespace cv::utils::logging;
  setLogLevel(LOG_LEVEL_SILENT);
  try {
    const cv::Mat buffer{1, int(count), CV_8U, const_cast<void*>(bytes)};
    return cv::imdecode(buffer, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    return {};
  }
}

/// Header fields of a TIFF or PNG, read before a decoder allocates anything.
struct Header {
  std::uint64_t width = 0, height = 0;
  bool several = false;        ///< more than one image in the file
  bool low_is_bright = false;  ///< TIFF: WhiteIsZero
};

std::uint64_t bigEndian(std::string_view bytes, std::size_t at, int count, bool reversed = false) {
  std::uint64_t value = 0;
  for (int i = 0; i < count; ++i) {
    const std::size_t k = at + std::size_t(reversed ? count - 1 - i : i);
    value = value << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u);
  }
  return value;
}

Header pngHeader(std::string_view content) {
  return {bigEndian(content, 16, 4), bigEndian(content, 20, 4)};
}

Header tiffHeader(std::string_view content) {
  const bool little = content[0] == 'I';
  const auto read = [&](std::uint64_t at, int count) { return bigEndian(content, std::size_t(at), count, little); };
  Header h;
  const std::uint64_t directory = read(4, 4), entries = read(directory, 2);
  if (directory + 2 + 12 * entries + 4 > content.size()) return h;
  for (std::uint64_t i = 0; i < entries; ++i) {
    const std::uint64_t at = directory + 2 + 12 * i, tag = read(at, 2),
                        value = read(at + 8, read(at + 2, 2) == 3 ? 2 : 4);
    if (tag == 256) h.width = value;
    if (tag == 257) h.height = value;
    if (tag == 262) h.low_is_bright = value == 0;
  }
  h.several = read(directory + 2 + 12 * entries, 4) != 0;
  return h;
}

/// The one grey plane of an image: itself, or any channel of a colour image that has no colour.
cv::Mat greyPlane(const cv::Mat& image, const std::string& where) {
  if (image.channels() == 1) return image;
  std::vector<cv::Mat> planes;
  cv::split(image, planes);
  for (std::size_t i = 1; i < std::min<std::size_t>(planes.size(), 3); ++i)
    if (cv::norm(planes[0], planes[i], cv::NORM_INF) != 0)
      throw InputError{{where, "pixels", "grey values", "a colour image"}};
  return planes[0];
}

}  // namespace

Radiograph readPlainImage(const std::filesystem::path& file, const std::string& content,
                          std::optional<double> declared_spacing_mm) {
  const std::string where = file.string();
  const Header header = looksLikePng(content) ? pngHeader(content) : tiffHeader(content);
  const std::string size = std::to_string(header.width) + " x " + std::to_string(header.height);
  if (header.width < 1 || header.height < 1 || header.width > std::uint64_t(kMaxImageSide_px) ||
      header.height > std::uint64_t(kMaxImageSide_px) || header.width * header.height > kMaxPixels)
    throw InputError{{where, "size", "1 to " + std::to_string(kMaxImageSide_px) + " pixels a side", size}};
  if (header.several) throw InputError{{where, "images", "one", "several pages"}};
  const cv::Mat decoded = decodeQuietly(content.data(), content.size());
  if (decoded.empty() || decoded.cols != int(header.width) || decoded.rows != int(header.height))
    throw InputError{{where, "", "a whole image of " + size + " pixels", "a damaged or unsupported one"}};
  if (decoded.depth() != CV_8U && decoded.depth() != CV_16U)
    throw InputError{{where, "pixels", "8 or 16 bit", "another depth"}};
  cv::Mat grey;
  greyPlane(decoded, where).convertTo(grey, CV_16U);

  Radiograph out;
  out.width_px = grey.cols;
  out.height_px = grey.rows;
  out.bits_stored = decoded.depth() == CV_8U ? 8 : 16;
  // For 8 bit the decoder has already turned WhiteIsZero round; 16-bit values come as stored.
  out.monochrome1 = header.low_is_bright && out.bits_stored == 16;
  out.pixels =
      std::make_shared<const std::vector<std::uint16_t>>(grey.begin<std::uint16_t>(), grey.end<std::uint16_t>());
  PixelSpacingFacts facts;
  facts.declared_mm = declared_spacing_mm;
  out.spacing = choosePixelSpacing(facts, out.warnings);
  setWindowFromPixels(out);
  return out;
}

namespace dicom {

std::optional<std::vector<std::uint16_t>> decodeJpeg2000(const std::vector<std::uint8_t>& stream,
                                                         const PixelFormat& format) {
  // SIZ marker segment (ISO 15444-1, A.5.1), first after SOC: size, origin, components, depth.
  const std::string_view s{reinterpret_cast<const char*>(stream.data()), stream.size()};
  if (s.size() < 64 || bigEndian(s, 0, 4) != 0xFF4FFF51u) return std::nullopt;
  const std::uint64_t width = bigEndian(s, 8, 4) - bigEndian(s, 16, 4),
                      height = bigEndian(s, 12, 4) - bigEndian(s, 20, 4);
  const std::uint64_t components = bigEndian(s, 40, 2), depth = (bigEndian(s, 42, 1) & 0x7f) + 1;
  const bool is_signed = bigEndian(s, 42, 1) & 0x80;
  if (width != std::uint64_t(format.columns) || height != std::uint64_t(format.rows) || components != 1 ||
      depth != std::uint64_t(format.bits_stored) || is_signed)
    return std::nullopt;  // signed code streams: OpenCV would shift them
  cv::Mat decoded = decodeQuietly(stream.data(), stream.size());
  if (decoded.cols != format.columns || decoded.rows != format.rows || decoded.channels() != 1) return std::nullopt;
  decoded.convertTo(decoded, CV_16U);
  return std::vector<std::uint16_t>(decoded.begin<std::uint16_t>(), decoded.end<std::uint16_t>());
}

}  // namespace dicom
}  // namespace sinew
