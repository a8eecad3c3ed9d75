#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "core/job.h"
#include "core/model/model.h"
#include "core/retarget/lengths/maximal_lengths.h"
#include "core/retarget/peaks/peak_torque.h"
#include "core/retarget/prepared/torque_geometry.h"
#include "core/retarget/routing/routing.h"

namespace sinew {

// Function-preserving retargeting (Ryu et al., Musculature Retargeting): the muscles of a reference in a new body, in
// three steps, each of which keeps what the one before it reached: routing (directions and length curves), maximal
// lengths (ranges of motion), fibre : tendon ratios (angles of peak torque). What is asked of the reference again and
// again is prepared once: prepared/reference.h. docs/methods/retargeting.md.

class RetargetReference;

struct RetargetOptions {
  RetargetMethod method = RetargetMethod::Sinew;
  RoutingWeights weights;
  bool peak_torque = true;  ///< step 3
  /// Masses and strengths (core/model/physical_scaling.h), which peak torques depend on; nullopt: those of
  /// deformedModel().
  std::optional<PhysicsFactors> physics;
};

struct RetargetTimes {
  double deformation_s = 0, routing_s = 0, lengths_s = 0, peak_torque_s = 0;
  double total_s() const { return deformation_s + routing_s + lengths_s + peak_torque_s; }
};

struct Retargeted {
  Outcome outcome = Outcome::NotRun;
  Model model;                               ///< if converged
  std::vector<UnitRouting> routing;          ///< by unit; naive: start and end are the same
  MaximalLengths lengths;                    ///< naive: not run
  std::vector<PeakTorqueAngle> peak_torque;  ///< by motion; naive: before and after are the same
  std::vector<double> fiber_tendon_ratio;    ///< by unit, relative to the reference's
  RetargetTimes times;
  RetargetOptions options;                                ///< asked for
  std::shared_ptr<const TorqueGeometry> torque_geometry;  ///< of step 3
};

/// The reference in a body of `shape`. With RetargetMethod::Naive the points move with their bones and lengths scale
/// with the path at the zero posture: what the others are compared with. A stop request is answered within 0.2 s.
/// @throws InputError for a shape that the deformation cannot represent.
Retargeted retarget(const RetargetReference& reference, const ShapeParameters& shape,
                    const RetargetOptions& options = {}, const Job& job = {});

/// The same result, to the last bit, sooner: units that feel nothing of what has changed in the shape since
/// `previous` (of the same reference) are taken over from it. For a slider that is being dragged.
Retargeted retarget(const RetargetReference& reference, const ShapeParameters& shape, const RetargetOptions& options,
                    const Job& job, const Retargeted& previous);

}  // namespace sinew
