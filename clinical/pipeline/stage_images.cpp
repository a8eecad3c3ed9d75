#include <algorithm>
#include <functional>

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
  if (c.images.size() >= 2) return {};
  return "two radiographs are needed, there " +
         std::string(c.images.size() == 1 ? "is 1" : "are " + std::to_string(c.images.size()));
}

/// Doubts whether the radiographs were taken of one person on one occasion. Says nothing about who it is.
Warnings doubtsAbout(const std::vector<Radiograph>& images) {
  const std::string which = images.size() == 2 ? "the two radiographs" : "the radiographs";
  const auto values = [&](std::string RadiographTags::*field) {
    std::vector<std::string> stated;
    for (const auto& image : images)
      if (!(image.tags.*field).empty()) stated.push_back(image.tags.*field);
    return stated;
  };
  const auto differ = [&](std::string RadiographTags::*field) {
    const auto stated = values(field);
    return std::ranges::adjacent_find(stated, std::ranges::not_equal_to{}) != stated.end();
  };
  Warnings warnings;
  if (differ(&RadiographTags::patient_id) || differ(&RadiographTags::patient_birth_date))
    warnings.push_back({"different_patients", which + " name different patients"});
  if (differ(&RadiographTags::study_date))
    warnings.push_back({"different_dates", which + " were taken on different days"});
  const auto positions = values(&RadiographTags::view_position);
  if (positions.size() == images.size() && !differ(&RadiographTags::view_position))
    warnings.push_back({"same_view", (images.size() == 2 ? "both" : "all") +
                                         std::string{" radiographs say view position "} + positions.front()});
  return warnings;
}

/// @throws InputError if two images are the same file.
void requireDifferentFiles(const std::vector<CaseImage>& images) {
  for (std::size_t i = 0; i < images.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (images[i].file.sha256 == images[k].file.sha256)
        throw InputError{{"images", viewName(i), "another radiograph than " + viewName(k), "the same file twice"}};
}

/// Reads the radiographs and asks whether they belong together.
StageRun run(Case& c, const PipelineContext& context, const Job&) {
  requireDifferentFiles(c.images);
  const auto images = readImages(c, context);
  StageRun run;
  for (std::size_t i = 0; i < images.size(); ++i) {
    addWarnings(run.warnings, images[i].warnings, viewName(i));
    const auto& spacing = images[i].spacing;
    run.summary += (i ? "; " : "") + viewName(i) + " " + sizeText(images[i].width_px, images[i].height_px) + ", " +
                   (spacing ? rounded(spacing->column_mm, 3) + " mm a pixel" : "pixel size not stated");
  }
  addWarnings(run.warnings, doubtsAbout(images));
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
