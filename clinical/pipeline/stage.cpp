#include "clinical/case/case.h"
#include "core/text.h"

namespace sinew {
namespace {

struct StageNames {
  Stage stage;
  const char* name;
  const char* title;
};
constexpr StageNames kNames[] = {
    {Stage::Images, "images", "Images"},
    {Stage::Calibration, "calibration", "Calibration"},
    {Stage::Landmarks, "landmarks", "Landmarks"},
    {Stage::Skeleton, "skeleton", "Skeleton"},
    {Stage::Musculature, "musculature", "Musculature"},
    {Stage::Exam, "exam", "Examination"},
    {Stage::Report, "report", "Report"},
};

}  // namespace

std::string nameOf(Stage stage) {
  return kNames[static_cast<int>(stage)].name;
}
std::string titleOf(Stage stage) {
  return kNames[static_cast<int>(stage)].title;
}

Stage stageFromName(std::string_view name) {
  std::vector<std::string> known;
  for (const auto& n : kNames) {
    if (name == n.name) return n.stage;
    known.emplace_back(n.name);
  }
  throw InputError{
      {"stage", "", "one of images ... report", "'" + std::string{name} + "'" + didYouMean(name, known)}};
}

}  // namespace sinew
