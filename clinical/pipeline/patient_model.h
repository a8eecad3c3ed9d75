#pragma once
#include <filesystem>
#include <optional>

#include "clinical/pipeline/pipeline.h"

namespace sinew {

inline constexpr const char* kPatientModelName = "patient";
inline constexpr const char* kModelPath = "results/model.json";

/// Stores the model of a case below its results. @throws InputError if it cannot be written.
FileReference storeModel(const Model& model, const std::filesystem::path& case_dir);

}  // namespace sinew
