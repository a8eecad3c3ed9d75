#include "clinical/pipeline/image_pair.h"
#include "clinical/pipeline/stage_inputs_json.h"
#include "clinical/pipeline/stage_table.h"
#include "clinical/pipeline/stage_words.h"

namespace sinew {
namespace {

std::string inputs(const Case& c) {
  return inputText({{"images", imageInputs(c.images)}});
}

/// Its record is its result: the images themselves were entered.
bool hasResult(const Case& c) {
  const auto record = c.stages.find(Stage::Images);
  return record != c.stages.end() && record->second.outcome == Outcome::Converged;
}

std::string missing(const Case& c, StageState) {
  if (c.images.size() == 2) return {};
  return "two radiographs are needed, there " +
         std::string(c.images.size() == 1 ? "is 1" : "are " + std::to_string(c.images.size()));
}

/// Doubts whether two radiographs were taken of one person on one occasion. Says nothing about who it is.
Warnings pairDoubts(const std::array<Radiograph, 2>& images) {
  const RadiographTags &a = images[0].tags, &b = images[1].tags;
  Warnings warnings;
  const auto differ = [](const std::string& x, const std::string& y) { return !x.empty() && !y.empty() && x != y; };
  if (differ(a.patient_id, b.patient_id) || differ(a.patient_birth_date, b.patient_birth_date))
    warnings.push_back({"different_patients", "the two radiographs name different patients"});
  if (differ(a.study_date, b.study_date))
    warnings.push_back({"different_dates", "the two radiographs were taken on different days"});
  if (differ(a.view_position, b.view_position) == false && !a.view_position.empty() && !b.view_position.empty())
    warnings.push_back({"same_view", "both radiographs say view position " + a.view_position});
  return warnings;
}

/// Reads both radiographs and asks whether they are a pair.
StageRun run(Case& c, const PipelineContext& context, const Job&) {
  if (c.images[0].file.sha256 == c.images[1].file.sha256)
    throw InputError{{"images", "view 2", "another radiograph than view 1", "the same file twice"}};
  const auto images = readPair(c, context);
  StageRun run;
  for (std::size_t i = 0; i < 2; ++i) {
    addWarnings(run.warnings, images[i].warnings, viewName(i));
    const auto& spacing = images[i].spacing;
    run.summary += (i ? "; " : "") + viewName(i) + " " + sizeText(images[i].width_px, images[i].height_px) + ", " +
                   (spacing ? rounded(spacing->column_mm, 3) + " mm a pixel" : "pixel size not stated");
  }
  addWarnings(run.warnings, pairDoubts(images));
  return run;
}

void copyResult(Case& to, const Case& from) {
  to.images = from.images;
}

std::string entered(const Case& c) {
  return c.images.empty() ? "No image" : counted(c.images.size(), "image", "images");
}

std::string resultLine(const Case& c) {
  return counted(c.images.size(), "radiograph", "radiographs") + " checked";
}

}  // namespace

constinit const StageRow kImagesRow{.stage = Stage::Images,
                                    .name = "images",
                                    .title = "Images",
                                    .revision = 1,
                                    .resources = {},
                                    .inputs = inputs,
                                    .has_result = hasResult,
                                    .missing = missing,
                                    .run = run,
                                    .copy_result = copyResult,
                                    .to_enter = "Add a frontal and a lateral radiograph.",
                                    .entered = entered,
                                    .result_line = resultLine};

}  // namespace sinew
