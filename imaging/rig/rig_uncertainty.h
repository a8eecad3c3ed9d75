#pragma once
#include "core/geometry/geometry_uncertainty.h"
#include "imaging/rig/biplanar_rig.h"

namespace sinew {

/// How far a nominal geometry trusts Distance Source to Patient: that is the distance to the table or the bucky, and
/// the bones stand somewhere between it and this much nearer to the source (a leg or a pelvis is 0.1-0.4 m thick, and
/// lateral films are taken with the shoulder, not the knee, at the stand).
inline constexpr double kObjectDepth_m = 0.30;

/// How well every view of the rig is known, from how its geometry was found:
/// - "bead_phantom": the accuracy that the calibration states, and radial distortion it did not look for;
/// - "dicom_nominal": depth of the object (even chances within kObjectDepth_m, the same error in all views, a patient
///   turns before one stand), distances and angles read off scales;
/// - "dicom_slot_scan": the pixel size of the isocentre plane as the maker states it;
/// - others: accuracy_mm, or 0.5 mm where it is unknown.
/// Figures and their reasons: docs/methods/imaging.md.
GeometryUncertainty uncertaintyOf(const CalibrationRecord& calibration, const View& view);

/// Whether views whose geometry was found so are taken at one instant: slot scanners and biplane fluoroscopes, not
/// two films.
bool isSimultaneous(const CalibrationRecord& calibration);

}  // namespace sinew
