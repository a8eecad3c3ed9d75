#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/job.h"
#include "core/retarget/retarget.h"
#include "core/skeleton/shape/body_description.h"

namespace sinew {

// The four characters of Ryu et al. (table Skeleton scaling parameters), or any other bodies, with their muscles.

/// A posture in which nothing may pull, and whether it is possible in the body.
struct RestingVerdict {
  std::string posture;  ///< "standing", "weightless", "arms sideways"
  bool valid = false;
  std::string first_to_fail;  ///< the constraint with the least margin
};

struct Character {
  BodyDescription body;
  Retargeted retargeted;  ///< its model is named like the body
  double height_m = 0;    ///< of the bones, standing
  double mass_kg = 0;
  std::vector<RestingVerdict> at_rest;
};

/// One body by the method `sinew`, its masses and strengths included.
Character makeCharacter(const RetargetReference& reference, const BodyDescription& body, const Job& job = {});

/// Routing energies of all units together.
struct EnergyTotals {
  double start = 0, end = 0;              ///< all parts
  double paper_start = 0, paper_end = 0;  ///< E_direction + w_l E_length alone
};
EnergyTotals energyTotals(std::span<const UnitRouting> routing, const RoutingWeights& weights = {});

/// How far the angles of peak torque are off.
struct PeakTorqueTotals {
  int motions = 0;  ///< with a peak in the reference
  int within_before = 0, within_after = 0;
  double worst_before_deg = 0, worst_after_deg = 0;
};
PeakTorqueTotals peakTorqueTotals(std::span<const PeakTorqueAngle> angles);

}  // namespace sinew
