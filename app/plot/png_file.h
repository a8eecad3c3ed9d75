#pragma once
#include <filesystem>
#include <string>

#include "app/scene/rgb_image.h"

namespace sinew {

std::string pngBytes(const RgbImage& picture);

/// Writes a drawn picture, beside and then into place. @throws InputError for a name that does not end in .png or a
/// place that cannot be written.
void writePng(const RgbImage& picture, const std::filesystem::path& file);

/// Before anything is computed: the name ends in .png. `where` is the command.
void requirePngName(const std::filesystem::path& file, const std::string& where);

}  // namespace sinew
