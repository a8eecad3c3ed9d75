#pragma once
#include <string>
#include <vector>

#include "clinical/case/case.h"
#include "core/strict_json.h"

namespace sinew {

// Pieces of what stages read, for StageRow::inputs. A changed byte makes every case stale: do not tidy.

/// Canonical text of a value.
std::string inputText(const Json& inputs);
Json imageInputs(const std::vector<CaseImage>& images);
Json sightingInputs(const std::vector<Sighting>& sightings);
/// Content of a file of the case; null if there is none.
Json fileInput(const std::optional<FileReference>& file);

template <class T, class Write>
Json orNull(const std::optional<T>& value, Write write) {
  return value ? write(*value) : Json(nullptr);
}

}  // namespace sinew
