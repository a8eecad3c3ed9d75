#pragma once
#include <QString>
#include <filesystem>

#include "core/model/model.h"
#include "core/rom/rom_edit.h"

namespace sinew {

// Files that the retargeting workspace reads and writes. All throw InputError: where, field, expected, found.

RomEdits loadRanges(const std::filesystem::path& file, const Skeleton& skeleton);
void saveRanges(const RomEdits& edits, const std::filesystem::path& file);

/// Formats of other programs, by the name's ending: ".xml" MuJoCo.
void exportModel(const Model& model, const std::filesystem::path& file);

/// The formats for a file dialog.
QString exportFilter();

}  // namespace sinew
