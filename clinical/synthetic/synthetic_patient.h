#pragma once
#include <vector>

#include "core/random_source.h"
#include "core/skeleton/fit/fit_skeleton.h"
#include "core/skeleton/kinematics.h"
#include "core/skeleton/shape/shape.h"
#include "core/skeleton/skeleton.h"
#include "imaging/rig/biplanar_rig.h"
#include "imaging/rig/sighting.h"

namespace sinew {

// The parts that a synthetic patient is drawn from; clinical/synthetic_case.h puts them together.

/// A body from the population priors. Every parameter has the prior's mean and standard deviation, cut at two
/// standard deviations; of the two sides nine tenths of the variance are common, so that legs differ by millimetres,
/// not by centimetres. Size is restricted to what fits a long-leg film: 0.84-1.04 of the reference (stature 1.46-1.81
/// m).
ShapeParameters drawPatientShape(const std::vector<ShapePrior>& priors, RandomSource& random);

/// Standing for a pair of radiographs: one foot a few centimetres before the other so that the legs can be told apart
/// from the side, knees flexed 2-12 deg, pelvis tilted and turned by some degrees, hands at the shoulders, both feet
/// flat on the floor at `floor_m`, the pelvis oblique by what the lengths of the legs demand.
/// `skeleton` has the patient's shape.
Posture drawPatientPosture(const Skeleton& skeleton, double floor_m, RandomSource& random);

/// What a reader with a placement error of `noise_mm` (standard deviation in the plane through the landmark, each
/// direction) picks of the protocol's landmarks: in every view in which the protocol asks for them and the film shows
/// them. Stated sigma: the same error, at least 0.02 mm.
std::vector<Sighting> drawSightings(const Skeleton& skeleton, const Posture& posture, const BiplanarRig& rig,
                                    const std::filesystem::path& resource_dir, double noise_mm, RandomSource& random);

}  // namespace sinew
