#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "imaging/radiograph/radiograph.h"

namespace sinew {

constexpr std::uint64_t kMaxPixels = 200'000'000;  // four times a full-body slot scan

/// Readers by kind of file; `content` is the whole file. @throws InputError.
Radiograph readDicom(const std::filesystem::path& file, std::optional<double> declared_spacing_mm);
Radiograph readPlainImage(const std::filesystem::path& file, const std::string& content,
                          std::optional<double> declared_spacing_mm);

bool looksLikeDicom(std::string_view head);
bool looksLikePng(std::string_view head);
bool looksLikeTiff(std::string_view head);

/// Window from the darkest to the brightest 1 % of the pixels.
void setWindowFromPixels(Radiograph& radiograph);

}  // namespace sinew
