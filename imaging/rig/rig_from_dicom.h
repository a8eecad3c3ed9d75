#pragma once
#include <span>

#include "imaging/radiograph/radiograph.h"
#include "imaging/rig/biplanar_rig.h"

namespace sinew {

// Geometry of two or more radiographs from their DICOM attributes alone. The result is patient aligned: W has X
// anterior, Y up, Z right, its origin in the isocentre.
//
// Beam direction z_C, from View Position (0018,5101):
//   AP: -X    PA: +X    LL (left side at the detector): -Z    RL (right side at the detector): +Z
// or, where Positioner Primary / Secondary Angle (0018,1510 / 1511) are in all files and within 30 deg of it, or
// View Position is absent:  z_C = cos b (cos a X - sin a Z) + sin b Y, a primary (0 = detector in front of the
// patient, +90 = on his left), b secondary (+ = detector towards the head).
//
// Image axes: v runs down (y_C = -Y, tilted with the beam). u is the first word of Patient Orientation (0020,0020):
// L: -Z, R: +Z, A: +X, P: -X. Where it is absent, u is as seen from the source for AP (L), LL (A) and RL (P), and a
// PA film is taken as hung like an AP film (L). An image that is mirrored against the view from its source (PA with
// "L\F") gets a left-handed C, det R_CW = -1.
//
// Slot scan: all files have Distance Source to Isocenter (0018,9402) = D. Pixel Spacing with Calibration Type
// GEOMETRY is the pixel in the isocentre plane (row \ column); else Imager Pixel Spacing, its column part times D /
// SID. The isocentre is at the middle of the image: u0 = (columns - 1) / 2, v0 = (rows - 1) / 2; the same row of all
// images is the same height. Rows and row spacing must agree.
//
// Nominal cone beam: no such distance, but Distance Source to Detector (0018,1110) = SID, to Patient (0018,1111) =
// SOD and Imager Pixel Spacing: f = SID / imager spacing, principal point at the middle of the image. SOD is the
// distance to the table or bucky, not to the bone: a bound. The bones stand anywhere within kObjectDepth_m before it
// (rig_uncertainty.h), so the source is placed SOD - kObjectDepth_m / 2 from the isocentre, and the fit is told how
// little that is known. Warning "uncalibrated": lengths are good to 3-5 %.

/// Rig of a frontal radiograph, a lateral one and any others (an oblique exposure); method "dicom_slot_scan" (one
/// exposure) or "dicom_nominal" (an exposure each).
/// @throws InputError: a needed attribute is missing, the images do not belong together (other patient, rows or row
/// spacing of a slot scan), the first is not frontal, none is lateral, or two nominal views look the same way: where
/// they stand to each other (the parts of a stitched pair) is in no attribute.
BiplanarRig rigFromDicom(std::span<const Radiograph> images);

}  // namespace sinew
