#pragma once
#include <filesystem>

#include "core/rom/edit/rom_edit.h"
#include "core/strict_json.h"

namespace sinew {

// "sinew.rom_edits", version 1: {"edits": [{"joint": "hip_r", "cone": 0.63, "tilt": {"towards": "forward", "deg":
// 30}, "twist_scale": 1, "twist_shift_deg": 0}, {"joint": "knee_r", "scale": 0.8, "shift_deg": -10}]}. Factors are of
// the range, angles in degrees; what is left out stays. A tilt that has no name: {"about": [x, y, z], "deg": 30}.

Json romEditsToJson(const RomEdits& edits);
/// The document's "edits". @throws InputError: where, field, expected, found; checkRomEdits() included.
RomEdits romEditsFromJson(const JsonReader& document, const Skeleton& skeleton);

/// @throws InputError as romEditsFromJson().
RomEdits loadRomEdits(const std::filesystem::path& file, const Skeleton& skeleton);
void saveRomEdits(const RomEdits& edits, const std::filesystem::path& file);

}  // namespace sinew
