#pragma once
#include <array>
#include <string>
#include <string_view>

namespace sinew {

/// The stages of a case, in their order. All that is known of one stands in its row
/// (clinical/pipeline/stage_table.h).
enum class Stage { Images, Calibration, Landmarks, Skeleton, Musculature, Exam, Report };
inline constexpr Stage kLastStage = Stage::Report;

/// Every stage, in order.
inline constexpr auto kStages = [] {
  std::array<Stage, static_cast<std::size_t>(kLastStage) + 1> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Stage>(i);
  return all;
}();

std::string nameOf(Stage stage);   ///< "images", ...: files and command line
std::string titleOf(Stage stage);  ///< "Images", ...: screen
/// @throws InputError with the nearest names.
Stage stageFromName(std::string_view name);

}  // namespace sinew
