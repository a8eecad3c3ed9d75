#pragma once
#include <string>
#include <vector>

#include "core/model/model.h"
#include "core/rom/maps/rom_map.h"

namespace sinew {

/// The hip's range with the knee held at an angle (Ryu et al., ROM Construction: wider with the knee flexed by more
/// than 90 deg than with the knee straight within 30 deg, because of the hamstrings).
struct PoseDependenceRow {
  double knee_flexion_deg = 0;
  RomMap muscles, with_stops;
  double flexion_deg = 0;  ///< hip flexion, straight forward, up to which all postures are possible; with stops
};
/// Valid cells whose shaft points forward of the joint: what hip flexors reach and hamstrings limit. (Backward it is
/// the rectus femoris, which a flexed knee stretches.)
int forwardCount(const RomMap& map);

std::vector<PoseDependenceRow> poseDependence(const Model& model,
                                              const std::vector<double>& knee_flexions_deg = {0, 30, 90, 120});

}  // namespace sinew
