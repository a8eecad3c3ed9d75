#pragma once
#include <string>

#include "clinical/pipeline/pipeline.h"

namespace sinew {

// What each stage does, one function a stage: reads its inputs from the case, leaves its result there. Records, times
// and what happens when a stage fails are runStage's. @throws InputError for inputs that cannot be used.

/// How a stage ended. Unless Converged its changes of the case are not kept.
struct StageRun {
  Outcome outcome = Outcome::Converged;
  Warnings warnings;
  std::string summary;  ///< key figures in one line, no patient data
};

/// Reads the radiographs and asks whether they belong together.
StageRun runImages(Case& c, const PipelineContext& context);
/// Geometry of the views, from bead phantom, imported rig or DICOM attributes.
StageRun runCalibration(Case& c, const PipelineContext& context, const Job& job);
/// Position of every landmark seen in two views or more, and which ones of the protocol are missing.
StageRun runLandmarks(Case& c, const PipelineContext& context);
/// Shape and posture from the sightings.
StageRun runSkeleton(Case& c, const PipelineContext& context, const Job& job);
/// The model of that shape, in results/model.json.
StageRun runMusculature(Case& c, const PipelineContext& context, const Job& job);
/// Muscle lengths that make the simulated tests meet the measured ones; the model with them.
StageRun runExam(Case& c, const PipelineContext& context, const Job& job);
/// results/report.pdf.
StageRun runReport(Case& c, const PipelineContext& context);

/// Adds `more` to `warnings`, each message after "`source`: ".
void addWarnings(Warnings& warnings, const Warnings& more, const std::string& source = {});
/// "12.34"
std::string rounded(double value, int decimals);

}  // namespace sinew
