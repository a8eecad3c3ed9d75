#include "clinical/pipeline/image_pair.h"

#include "clinical/case/case_io.h"

namespace sinew {

std::vector<Radiograph> readImages(const Case& c, const PipelineContext& context) {
  std::vector<Radiograph> images;
  for (const auto& image : c.images)
    images.push_back(readRadiograph(checkedFile(image.file, context.case_dir), image.declared_spacing_mm));
  return images;
}

std::string viewName(std::size_t i) {
  return "view " + std::to_string(i + 1);
}

std::string sizeText(int width_px, int height_px) {
  return std::to_string(width_px) + " x " + std::to_string(height_px) + " px";
}

}  // namespace sinew
