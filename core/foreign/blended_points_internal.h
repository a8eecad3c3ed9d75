#pragma once
#include "core/foreign/foreign_model.h"
#include "core/model/model.h"

namespace sinew {

/// A unit's path with every point on the segment of its largest weight, where it is at the zero posture.
ForeignPath anchoredPath(const MusculotendonUnit& unit);

/// Replaces the blended points in `foreign` (made from `model`, its paths anchored) by fixed or moving ones, so that
/// lengths deviate least; see ForeignOptions::Blended::MovingPoint.
void fitBlendedPoints(const Model& model, ForeignModel& foreign);

}  // namespace sinew
