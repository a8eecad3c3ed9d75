#pragma once
#include <span>
#include <string>
#include <vector>

#include "clinical/pipeline/pipeline.h"

namespace sinew {

/// How a stage ended. Unless Converged its changes of the case are not kept.
struct StageRun {
  Outcome outcome = Outcome::Converged;
  Warnings warnings;
  std::string summary;  ///< key figures in one line, no patient data
};

/// One stage of a case: all that the product knows about it. A new stage is an enumerator of Stage, a file
/// stage_NAME.cpp that holds its row, and the row's line in stage_table.cpp; whatever shows or runs stages iterates
/// the table.
struct StageRow {
  Stage stage;
  const char* name;   ///< files and command line
  const char* title;  ///< screen
  /// To be raised when the stage computes something else from the same inputs: results of the old method become
  /// stale.
  int revision;
  /// Files and folders of the resources that it reads: their content belongs to its inputs.
  std::span<const char* const> resources;
  /// What it reads from the case, as canonical text: entered data, files by their hashes, results of earlier stages.
  std::string (*inputs)(const Case&);
  /// Whether a result of it is there, from whatever inputs.
  bool (*has_result)(const Case&);
  /// What is to be entered before it can run, in words for a person; empty if nothing is missing. `before` is the
  /// state of the stage before it.
  std::string (*missing)(const Case&, StageState before) = nullptr;  ///< nullptr: nothing ever is
  /// Reads its inputs from the case and leaves its result there. @throws InputError for inputs that cannot be used.
  StageRun (*run)(Case&, const PipelineContext&, const Job&);
  /// Files below the case folder that are its result, as the case pins them; nullptr: none.
  std::vector<FileReference> (*files)(const Case&) = nullptr;
  /// Takes over its result (not the record) from a case in which it ran.
  void (*copy_result)(Case& to, const Case& from);
  const char* to_enter;                     ///< one sentence: what a person does while something is missing
  std::string (*entered)(const Case&);      ///< in few words, before it ran: "No landmark placed"
  std::string (*result_line)(const Case&);  ///< in few words, once it ran: "53 points, RMS 1.30 px"
};

const StageRow& rowOf(Stage stage);

extern const StageRow kImagesRow, kCalibrationRow, kLandmarksRow, kSkeletonRow, kMusculatureRow, kExamRow, kReportRow;

}  // namespace sinew
