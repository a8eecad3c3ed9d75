#pragma once
#include <string>
#include <vector>

#include "core/job.h"
#include "core/rom/maps/rom_map.h"

namespace sinew {

class RetargetReference;

// Ryu et al., ROM Construction: the range of motion of the hip in bodies with longer or shorter, twisted femora, with
// muscles scaled linearly and retargeted. An error is the number of cells of the 18 x 36 x 36 map that differ from
// the reference's, either way.

struct RomPreservationOptions {
  std::vector<double> elongations = {0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.3};
  std::vector<double> torsions_deg = {-30, -15, 0, 15, 30};
  std::string joint = "hip_r";
  /// Knee flexion while the hip is moved, each a map of its own; the first is what the paper's figure shows.
  std::vector<double> knee_flexions_deg = {0, 90};
};

/// Two ways to ask: muscles alone, as in the paper, and with the joint's stops, as in the body.
struct RomErrors {
  RomDifference muscles, with_stops;
};

struct RomPreservationRow {
  double elongation = 1, torsion_deg = 0;
  std::vector<RomErrors> naive, retargeted;  ///< by knee flexion
};

struct RomPreservation {
  Outcome outcome = Outcome::NotRun;
  std::vector<int> valid_muscles, valid_with_stops;  ///< cells of the reference's maps, by knee flexion
  std::vector<RomPreservationRow> rows;              ///< torsion within elongation
};

RomPreservation romPreservation(const RetargetReference& reference, const RomPreservationOptions& options = {},
                                const Job& job = {});

}  // namespace sinew
