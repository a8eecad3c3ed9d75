#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "app/cli/support/session.h"

namespace sinew {

/// The parser, what the commands work with, and what the chosen one does. A command adds itself to the parser with
/// addCommand() and keeps its options in a shared structure that its action owns.
struct Commands {
  CLI::App& app;
  Session& session;
  std::function<ExitStatus()> chosen;
};

/// A command with its description, and an example at the end of its help.
CLI::App& addCommand(CLI::App& parent, const std::string& name, const std::string& description,
                     const std::string& example);

// One function a file of this folder, in the order of the help.
void addRunCommands(Commands& commands);  // demo, run, report
void addNewCommand(Commands& commands);
void addPatientCommand(Commands& commands);
void addStatusCommand(Commands& commands);
void addRigCommands(Commands& commands);
void addTriangulateCommand(Commands& commands);
void addFitCommand(Commands& commands);
void addExamCommand(Commands& commands);
void addModelCommands(Commands& commands);  // and its own: clearance, audit, ...
void addClearanceCommand(CLI::App& model, Commands& commands);
void addAuditCommand(CLI::App& model, Commands& commands);
void addMomentArmsCommand(CLI::App& model, Commands& commands);
void addPictureCommand(CLI::App& model, Commands& commands);
void addReplaceBonesCommand(CLI::App& model, Commands& commands);
void addShapeCommand(CLI::App& model, Commands& commands);
void addPhysicsCommand(CLI::App& model, Commands& commands);
void addEvaluateCommand(Commands& commands);
void addCurveCommand(Commands& commands);
void addRomCommand(Commands& commands);
void addRetargetCommand(Commands& commands);
void addExperimentCommand(Commands& commands);
void addRomEditCommand(Commands& commands);
void addExportCommand(Commands& commands);
void addImportCommand(Commands& commands);
void addBenchCommand(Commands& commands);
void addRomTestsCommand(Commands& commands);
void addPosesCommands(Commands& commands);

}  // namespace sinew
