#include "clinical/pipeline/phantom_calibration.h"

#include <string>

#include "imaging/rig/rig_from_dicom.h"

namespace sinew {

BeadCalibration calibrateFromPhantom(const std::array<std::filesystem::path, 2>& images,
                                     const std::filesystem::path& beads, const Job& job) {
  const CalibrationObject object = loadCalibrationObject(beads);
  std::array<Radiograph, 2> radiographs;
  std::array<std::vector<DetectedBead>, 2> detected;
  for (std::size_t i = 0; i < 2; ++i) {
    job.report(0.1 + 0.3 * static_cast<double>(i), "finding the beads of the phantom, view " + std::to_string(i + 1));
    radiographs[i] = readRadiograph(images[i]);
    detected[i] = detectBeads(radiographs[i]);
    if (job.cancelled()) return {.outcome = Outcome::Cancelled};
  }
  job.report(0.7, "geometry from the beads");
  return calibrateFromBeads(object, detected, rigFromDicom(radiographs[0], radiographs[1]), {}, job);
}

BeadCalibration calibrateFromPickedBeads(const std::array<std::filesystem::path, 2>& images,
                                         const std::filesystem::path& beads, const std::filesystem::path& sightings,
                                         const Job& job) {
  std::array<Eigen::Vector2i, 2> sizes_px;
  for (std::size_t i = 0; i < 2; ++i) {
    const Radiograph radiograph = readRadiograph(images[i]);
    sizes_px[i] = {radiograph.width_px, radiograph.height_px};
  }
  return calibrateFromSightings(loadCalibrationObject(beads), loadSightings(sightings), sizes_px, {}, job);
}

}  // namespace sinew
