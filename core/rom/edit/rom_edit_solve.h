#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/job.h"
#include "core/model/model.h"
#include "core/rom/edit/rom_transform.h"
#include "core/rom/maps/rom_map.h"

namespace sinew {

// Muscle lengths (and joint stops) with which the muscle-induced range of motion follows an edit. Only units that
// span an edited joint change, fibre and tendon alike. See docs/methods/range_of_motion.md.

enum class RomEditMethod {
  Paper,  ///< Ryu et al.: the pose set goes through T^-1, lengths are estimated again
  Sinew   ///< starts from that, then sets the longest lengths so that the fewest cells are wrong
};

/// What the other joints do while the cells of one joint are compared.
struct HeldPosture {
  std::string name;  ///< "zero", "knee_flexion_r=90"
  Posture posture;
  double weight = 1;  ///< of its cells; a multiple of 1/16
};
/// Postures that a joint is compared in unless others are asked for: the zero posture (weight 1), and one in which
/// the muscles that it shares with its neighbour are slack (1/2).
std::vector<HeldPosture> heldPostures(const Skeleton& skeleton, int joint);

/// Cells of one edited joint in one held posture that are not as wanted. Of a ball joint: of its map. Of a hinge:
/// degrees from 30 below to 30 beyond what athletes reach.
struct RomEditCells {
  std::string joint, held;
  int cells = 0;
  int wanted = 0, differing = 0, either = 0;                             ///< muscles alone, as Ryu et al. measure
  int wanted_in_stops = 0, differing_in_stops = 0, either_in_stops = 0;  ///< muscles and stops
  double ofAll() const { return double(differing) / cells; }
  double ofUnion() const { return either ? double(differing) / either : 0; }
  double ofAllInStops() const { return double(differing_in_stops) / cells; }
  double ofUnionInStops() const { return either_in_stops ? double(differing_in_stops) / either_in_stops : 0; }
};

struct RomEditChange {
  std::string unit;
  double length_factor = 1;  ///< on fibre and tendon
};
struct RomStopChange {
  std::string coordinate;
  double before_min_rad = 0, before_max_rad = 0, after_min_rad = 0, after_max_rad = 0;
};

struct RomEditResult {
  Outcome outcome = Outcome::NotRun;
  Model model;                         ///< the reference where nothing is edited, bit for bit
  std::vector<RomEditCells> cells;     ///< by edited joint and held posture
  std::vector<RomEditChange> changed;  ///< units whose length is not what it was, in their order
  std::vector<RomStopChange> stops;    ///< likewise
  Warnings warnings;
};

struct RomEditOptions {
  RomEditMethod method = RomEditMethod::Sinew;
  /// What a cell counts by which the muscles alone are wrong, be it beyond the stops where no posture of the body is;
  /// a cell by which muscles and stops together are wrong counts 1. A multiple of 1/64.
  double weight_of_muscles_alone = 4.0 / 64;
};

/// Solves edits of one reference. The pose set and, for each joint when it is first edited, the lengths of its units
/// in all cells are prepared once. Belongs to one thread.
class RomEditSolver {
 public:
  /// @param poses what `reference` was made from: kept in memory (0.2 kB a posture).
  RomEditSolver(const Model& reference, PoseSet poses);
  ~RomEditSolver();
  RomEditSolver(RomEditSolver&&) noexcept;

  const Model& reference() const;
  const RomCentres& centres() const;
  RomTransform transform(const RomEdits& edits) const;

  /// Prepares a joint before its first edit (tenths of a second).
  void prepare(const std::string& joint, const Job& job = {});
  /// @throws InputError as checkRomEdits(), or if an edit leaves a joint no cell at all.
  RomEditResult solve(const RomEdits& edits, const RomEditOptions& options = {}, const Job& job = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sinew
