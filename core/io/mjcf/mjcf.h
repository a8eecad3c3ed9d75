#pragma once
#include <string>

#include "core/foreign/length_deviation.h"
#include "core/model/model.h"

namespace sinew {

/// The model as MuJoCo XML (MJCF, read by MuJoCo 2.2 and later). Y is up; metres, radians. Bodies, masses, inertias,
/// joints and their limits, path points as sites, units as spatial tendons with muscle actuators, passive structures
/// as actuators that need no control.
///
/// Exact: bodies and joints, units anchored to one segment a point. MuJoCo cannot express the rest, so the nearest
/// that it has stands in:
/// - a blended path point is pinned to its heaviest anchor;
/// - the patella is a body on a hinge about the knee's axis, whose angle follows the knee by a quartic (an equality
///   constraint): patellaQuartic() has the quartic and its largest error; with its angle set to
///   PatellaDriver::glide() the patella is exact;
/// - the wrist ball is pronation (ulna to radius) and two hinges (radius to hand). The hand is exact; the radius
///   turns by the clinical pronation instead of the wrist's twist, the same while flexion or deviation is zero;
/// - ball joints are three hinges about the clinical axes in their order, with the limits of the athlete envelope,
///   except the shoulders, whose middle angle goes beyond 90 deg where hinges lock: balls, limited by one cone, the
///   largest turn in the envelope;
/// - passive structures are exponentials of four straight pieces, within 2.7 % of the end's moment; about the
/// shoulders
///   of the components of the rotation vector instead of the clinical angles (mjcf_structures_internal.h);
/// - MuJoCo's muscle has no pennation and a rigid tendon: force F_max cos(pennation). Its curves are others than
///   Thelen's; they take the unit's passive strain, fastest shortening and lengthening force, and lose half of the
///   active force where ours does on the short side.
std::string mjcfText(const Model& model);

/// How far that is from ours: lengths of pinned points with the patella at its quartic, moments of the structures.
LengthDeviation mjcfDeviation(const Model& model);

}  // namespace sinew
