#pragma once
#include <filesystem>

#include "core/muscle/musculature.h"
#include "core/skeleton/skeleton.h"

namespace sinew {

/// Reads muscles/muscles.csv (physiology), muscles/muscle_paths.csv (points; a blended point is given in the frame of
/// its first segment at the zero posture) and muscles/reference_lengths.csv (fibre and tendon lengths fitted to the
/// reference skeleton, see core/rom/length_estimation.h). The files hold the right side; the left is its mirror
/// image.
/// @throws InputError naming file, line, field, expected and found.
Musculature loadMusculature(const std::filesystem::path& resource_dir, const Skeleton& skeleton);

/// The same with the published start values instead of the fitted lengths: what the fit begins with.
Musculature loadPublishedMusculature(const std::filesystem::path& resource_dir, const Skeleton& skeleton);

}  // namespace sinew
