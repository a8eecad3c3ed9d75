#pragma once
#include <QString>
#include <filesystem>
#include <string>

#include "core/model/model.h"
#include "core/rom/edit/rom_edit.h"

namespace sinew {

// Files that the retargeting workspace reads and writes. All throw InputError: where, field, expected, found.

RomEdits loadRanges(const std::filesystem::path& file, const Skeleton& skeleton);
void saveRanges(const RomEdits& edits, const std::filesystem::path& file);

/// Formats of other programs, by the name's ending: ".osim" OpenSim 4, ".xml" MuJoCo. Returns how far muscle lengths
/// are off there, in one line.
std::string exportModel(const Model& model, const std::filesystem::path& file);

/// The formats for a file dialog.
QString exportFilter();

}  // namespace sinew
