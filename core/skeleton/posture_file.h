#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/skeleton/kinematics.h"

namespace sinew {

struct NamedPosture {
  std::string name;
  Posture posture;
};

/// Reads postures by coordinate names and degrees (translations in metres); what is not named is 0. Either a list
///   [{"name": "..", "coordinates_deg": {"hip_flexion_r": 30, ..}}]
/// or {"format": "sinew.postures", "version": 1, "source": "..", "postures": [the same list]}.
/// @throws InputError naming file, entry, expected and found.
std::vector<NamedPosture> loadPostures(const std::filesystem::path& file, const Skeleton& skeleton);

/// The same file for any model: calls `take` with the name and the values of every posture, in order. An InputError
/// of `take` is completed with file and entry.
void readPostures(
    const std::filesystem::path& file,
    const std::function<void(const std::string& name, const std::map<std::string, double>& coordinates_deg)>& take);

/// Postures that people name, to begin with: skeleton/preset_postures.json.
std::vector<NamedPosture> loadPresetPostures(const std::filesystem::path& resource_dir, const Skeleton& skeleton);

}  // namespace sinew
