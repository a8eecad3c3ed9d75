#include "clinical/pipeline/image_pair.h"

#include "clinical/case/case_io.h"

namespace sinew {

std::array<Radiograph, 2> readPair(const Case& c, const PipelineContext& context) {
  const auto read = [&](const CaseImage& image) {
    return readRadiograph(checkedFile(image.file, context.case_dir), image.declared_spacing_mm);
  };
  return {read(c.images.at(0)), read(c.images.at(1))};
}

std::string viewName(std::size_t i) {
  return "view " + std::to_string(i + 1);
}

std::string sizeText(int width_px, int height_px) {
  return std::to_string(width_px) + " x " + std::to_string(height_px) + " px";
}

}  // namespace sinew
