#pragma once
#include <span>

#include "core/retarget/retarget.h"
#include "core/strict_json.h"

namespace sinew {

/// "muscles" of the contract of `retarget`: energies and their parts, iterations, largest move, length and ratio.
Json musclesJson(const Retargeted& body, const RoutingWeights& weights);
/// "peak_torque": null for a motion that nothing drives.
Json peakTorqueJson(std::span<const PeakTorqueAngle> angles);
Json timesJson(const RetargetTimes& times);

}  // namespace sinew
