#include "app/model/image_store.h"

#include "clinical/case/case_io.h"

namespace sinew {

std::shared_ptr<const Radiograph> ImageStore::image(const CaseImage& image, const std::filesystem::path& case_dir) {
  const std::string key =
      image.file.sha256 + (image.declared_spacing_mm ? "@" + std::to_string(*image.declared_spacing_mm) : "");
  const std::scoped_lock lock{mutex_};
  if (const auto found = images_.find(key); found != images_.end()) return found->second;
  auto read = std::make_shared<const Radiograph>(
      readRadiograph(checkedFile(image.file, case_dir), image.declared_spacing_mm));
  images_.emplace(key, read);
  return read;
}

void ImageStore::clear() {
  const std::scoped_lock lock{mutex_};
  images_.clear();
}

Radiograph halfSize(const Radiograph& radiograph) {
  Radiograph half = radiograph;
  half.width_px = radiograph.width_px / 2;
  half.height_px = radiograph.height_px / 2;
  auto pixels =
      std::make_shared<std::vector<std::uint16_t>>(std::size_t(half.width_px) * std::size_t(half.height_px));
  for (int v = 0; v < half.height_px; ++v) {
    const std::uint16_t* upper = radiograph.pixels->data() + std::size_t(2 * v) * std::size_t(radiograph.width_px);
    const std::uint16_t* lower = upper + radiograph.width_px;
    std::uint16_t* out = pixels->data() + std::size_t(v) * std::size_t(half.width_px);
    for (int u = 0; u < half.width_px; ++u, upper += 2, lower += 2)
      out[u] = std::uint16_t((upper[0] + upper[1] + lower[0] + lower[1] + 2) / 4);
  }
  half.pixels = std::move(pixels);
  return half;
}

}  // namespace sinew
