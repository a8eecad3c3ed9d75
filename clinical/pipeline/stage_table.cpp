#include "clinical/pipeline/stage_table.h"

#include <algorithm>
#include <vector>

#include "core/text.h"

namespace sinew {
namespace {

constexpr const StageRow* kRows[] = {&kImagesRow,      &kCalibrationRow, &kLandmarksRow, &kSkeletonRow,
                                     &kMusculatureRow, &kExamRow,        &kReportRow};
static_assert(std::size(kRows) == kStages.size(), "a row for every stage");

}  // namespace

const StageRow& rowOf(Stage stage) {
  return **std::ranges::find(kRows, stage, [](const StageRow* row) { return row->stage; });
}

std::string nameOf(Stage stage) {
  return rowOf(stage).name;
}
std::string titleOf(Stage stage) {
  return rowOf(stage).title;
}

Stage stageFromName(std::string_view name) {
  std::vector<std::string> known;
  std::string all;
  for (const StageRow* row : kRows) {
    if (name == row->name) return row->stage;
    known.emplace_back(row->name);
    all += (all.empty() ? "" : " ") + known.back();
  }
  throw InputError{{"stage", "", "one of " + all, "'" + std::string{name} + "'" + didYouMean(name, known)}};
}

}  // namespace sinew
