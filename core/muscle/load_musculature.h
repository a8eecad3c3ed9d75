#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "core/muscle/musculature.h"
#include "core/skeleton/skeleton.h"

namespace sinew {

/// Reads muscles/muscles.csv (physiology), muscles/muscle_paths.csv (points; a blended point is given in the frame of
/// its first segment at the zero posture) and the fibre and tendon lengths of a flexibility, fitted to the reference
/// skeleton (muscles/lengthsFile(preset), see core/rom/fit_preset.h). The files hold the right side; the left is its
/// mirror image.
/// @throws InputError naming file, line, field, expected and found.
Musculature loadMusculature(const std::filesystem::path& resource_dir, const Skeleton& skeleton,
                            std::string_view preset = "average-adult");

/// "reference_lengths.csv" for the average adult, "reference_lengths_athlete.csv".
std::string lengthsFile(std::string_view preset);

/// The same with the published start values instead of the fitted lengths: what the fit begins with.
Musculature loadPublishedMusculature(const std::filesystem::path& resource_dir, const Skeleton& skeleton);

}  // namespace sinew
