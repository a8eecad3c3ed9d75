#include "clinical/pipeline/phantom_calibration.h"

#include <string>

#include "imaging/rig/rig_from_dicom.h"

namespace sinew {

BeadCalibration calibrateFromPhantom(std::span<const std::filesystem::path> images,
                                     const std::filesystem::path& beads, const Job& job) {
  const CalibrationObject object = loadCalibrationObject(beads);
  std::vector<Radiograph> radiographs;
  std::vector<std::vector<DetectedBead>> detected;
  for (const auto& image : images) {
    const double share = static_cast<double>(detected.size()) / static_cast<double>(images.size());
    job.report(0.1 + 0.6 * share, "finding the beads of the phantom, view " + std::to_string(detected.size() + 1));
    radiographs.push_back(readRadiograph(image));
    detected.push_back(detectBeads(radiographs.back()));
    if (job.cancelled()) return {.outcome = Outcome::Cancelled};
  }
  job.report(0.7, "geometry from the beads");
  return calibrateFromBeads(object, detected, rigFromDicom(radiographs), {}, job);
}

BeadCalibration calibrateFromPickedBeads(std::span<const std::filesystem::path> images,
                                         const std::filesystem::path& beads, const std::filesystem::path& sightings,
                                         const Job& job) {
  std::vector<Eigen::Vector2i> sizes_px;
  for (const auto& image : images) {
    const Radiograph radiograph = readRadiograph(image);
    sizes_px.emplace_back(radiograph.width_px, radiograph.height_px);
  }
  return calibrateFromSightings(loadCalibrationObject(beads), loadSightings(sightings), sizes_px, {}, job);
}

}  // namespace sinew
