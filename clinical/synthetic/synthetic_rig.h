#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "imaging/calibration/calibration_object.h"
#include "imaging/radiograph/radiograph.h"
#include "imaging/rig/biplanar_rig.h"

namespace sinew {

enum class SyntheticRig { ConeBeam, SlotScan };
std::string nameOf(SyntheticRig kind);  ///< "cone-beam", "slot-scan": the command line's words

/// How one film of a synthetic study is taken, in the words of its DICOM file: the nominal values that a machine
/// writes.
struct FilmGeometry {
  std::string view_position;        ///< "AP", "PA", "LL" or "LPO"
  std::string patient_orientation;  ///< "L\\F": what the rows and columns run towards
  double pixel_mm = 0;              ///< cone beam: on the detector; slot scan: in the isocentre plane
  double source_to_detector_mm = 0;
  double source_to_isocenter_mm = 0;  ///< the patient stands in the isocentre, which is the world's origin
  int width_px = 0, height_px = 0;
  std::optional<double> primary_angle_deg;  ///< of the positioner, where the machine writes it
};

/// Cone beam: two long-leg films with the source 3 m from the detector, AP and left lateral. Slot scan: head to foot,
/// PA (hung like AP) and left lateral, both fans at once. `binning` joins that many pixels along rows and columns
/// into one: smaller images of the same field, for tests. A third view is a left posterior oblique film, half way
/// between the two. @pre views is 2, or 3 with a cone beam.
std::vector<FilmGeometry> filmGeometry(SyntheticRig kind, int binning = 1, int views = 2);

/// Height of the floor on which the patient stands [m]; the origin is at the middle of the images.
double floorHeight_m(SyntheticRig kind);

/// The views as the DICOM attributes describe them.
BiplanarRig nominalRig(SyntheticRig kind, int binning = 1, int views = 2);

/// The rig that really took the images. Slot scan: the nominal one. Cone beam: source and detector are some
/// millimetres and tenths of a degree away from where they should be, as after moving a tube along its rails.
BiplanarRig drawTrueRig(SyntheticRig kind, std::uint64_t seed, int binning = 1, int views = 2);

/// Writes view position, distances and pixel spacing into the tags.
void setGeometryTags(Radiograph& film, const FilmGeometry& geometry, SyntheticRig kind);

/// Bead phantom that fits both nominal cone-beam fields: the default object, narrowed.
CalibrationObject syntheticPhantom();

}  // namespace sinew
