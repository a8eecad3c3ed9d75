#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clinical/case/case.h"
#include "core/model/model.h"

namespace sinew {

class RetargetReference;

/// What the stages need beside the case: nothing global.
struct PipelineContext {
  std::filesystem::path resource_dir;
  std::filesystem::path case_dir;
  const Model* reference = nullptr;
  /// What the musculature is retargeted from, once it is needed. Empty: read from the resources.
  std::function<std::shared_ptr<const RetargetReference>()> retargeting;
  /// Writes the report PDF; supplied by the application, because it draws. Empty: the report stage says so and fails.
  std::function<void(const Case&, const std::filesystem::path& case_dir, const std::filesystem::path& pdf)>
      write_report;
};

enum class StageState { Missing, Blocked, Ready, Stale, Done, Failed };
std::string nameOf(StageState state);  ///< "missing", ...

/// How a stage stands. Missing = nothing entered for it; Blocked = an earlier stage is not done, and this one has not
/// run; Ready = can run; Stale = ran from other inputs than today's, or an earlier stage is not done any more; Done;
/// Failed = ran from today's inputs and did not converge. A cancelled stage is Ready, or Stale if an earlier result
/// is kept.
struct StageStatus {
  Stage stage;
  StageState state;
  std::string missing;  ///< what is to be entered before it can run, in words for a person; empty: nothing
};
/// Of every stage, in order. `resource_dir`: what the stages read of it belongs to their inputs.
std::vector<StageStatus> statusOf(const Case& c, const std::filesystem::path& resource_dir);
StageState stateOf(const Case& c, Stage stage, const std::filesystem::path& resource_dir);
std::string missingInput(const Case& c, Stage stage, const std::filesystem::path& resource_dir);

/// Code of the warning that the landmarks stage leaves if none of the points belongs to the skeleton.
inline constexpr std::string_view kNoKnownLandmarks = "no_known_landmarks";

/// Hash of everything the stage reads, today: entered data, files by their hashes, results of earlier stages, its
/// files of the resources, and the revision of its method.
std::string inputHash(const Case& c, Stage stage, const std::filesystem::path& resource_dir);

/// Whether the stage's result is there and came from today's inputs, however the earlier stages stand.
bool resultIsOfToday(const Case& c, Stage stage, const std::filesystem::path& resource_dir);

/// A file or folder of the resources, its content today, and who reads it.
struct ResourceUse {
  std::string path, sha256;
  std::vector<Stage> read_by;
};
/// What any stage reads of the resources, by path.
std::vector<ResourceUse> resourcesRead(const std::filesystem::path& resource_dir);

/// Runs one stage from the stored inputs; returns the case with result and record. Pure but for files below
/// case_dir/results. Cancelled or failed stages keep the previous result and say so in the record.
/// @throws InputError for unusable inputs (missing file, no sightings, stale predecessor, ...).
Case runStage(const Case& c, Stage stage, const PipelineContext& context, const Job& job = {});

/// The report's inputs are all done and fresh; otherwise why not, one line a stage.
std::vector<std::string> reasonsAgainstReport(const Case& c, const std::filesystem::path& resource_dir);

/// The patient's model as far as the case has got: fitted bones with muscles anchored to them, then the retargeted
/// muscles, then the exam's length factors. nullopt before the bones are fitted.
/// @throws InputError if the file of the retargeted muscles is missing or changed.
std::optional<Model> patientModel(const Case& c, const Model& reference, const std::filesystem::path& case_dir,
                                  const std::filesystem::path& resource_dir);
/// The same without the exam's length factors. @pre the skeleton is fitted.
Model modelBeforeExam(const Case& c, const Model& reference, const std::filesystem::path& case_dir,
                      const std::filesystem::path& resource_dir);

}  // namespace sinew
