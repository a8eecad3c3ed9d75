#pragma once
#include <string>
#include <vector>

#include "clinical/pipeline/pipeline.h"
#include "imaging/radiograph/radiograph.h"

namespace sinew {

/// The radiographs of a case. @throws InputError if one is missing, changed or unreadable.
std::vector<Radiograph> readImages(const Case& c, const PipelineContext& context);
/// "view 1"
std::string viewName(std::size_t i);
/// "2022 x 4045 px"
std::string sizeText(int width_px, int height_px);

}  // namespace sinew
