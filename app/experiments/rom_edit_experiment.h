#pragma once
#include <filesystem>

#include "core/rom/edit/rom_edit_solve.h"

namespace sinew {

/// One edit of one reference, solved by both methods.
struct RomEditExperimentRow {
  std::string reference;                   ///< "reference", "reference:athlete"
  RomEdits edits;                          ///< inWords() says them
  std::vector<RomEditCells> paper, sinew;  ///< by held posture, the zero posture first
  std::vector<RomEditChange> paper_changed, sinew_changed;
};

/// Ryu et al., figure *Interactive ROM editing*: the hip's range tilted forward by 30 deg, its cone x 0.63; then a
/// few others, of the shoulder, the ankle and of hinges. Both references.
struct RomEditExperiment {
  static constexpr double kPublishedError = 0.073;  ///< of the first edit, by the paper's own body
  Outcome outcome = Outcome::NotRun;
  std::vector<RomEditExperimentRow> rows;
};
RomEditExperiment romEditExperiment(const std::filesystem::path& resource_dir, const Job& job = {});

/// The pose set that a preset's lengths are fitted to, and a solver on top of it. About a second.
RomEditSolver romEditSolver(const Model& reference, const std::filesystem::path& resource_dir,
                            std::string_view preset);

}  // namespace sinew
