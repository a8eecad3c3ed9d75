#pragma once
#include <string>
#include <vector>

#include "core/text.h"

namespace sinew {

/// Columns for a terminal: the first is set left, the others right; widths count characters, not bytes.
std::string textTable(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);

}  // namespace sinew
