#pragma once
#include <filesystem>
#include <span>

#include "core/job.h"
#include "imaging/calibration/calibrate.h"

namespace sinew {

/// The views, two or more, in which images show a bead phantom: beads found in the images, geometry started from what
/// their DICOM attributes say. @param beads CSV name,x_mm,y_mm,z_mm[,diameter_mm]. @throws InputError.
BeadCalibration calibrateFromPhantom(std::span<const std::filesystem::path> images,
                                     const std::filesystem::path& beads, const Job& job = {});

/// The same from beads that a person picked and named (CSV of sightings, name = bead): the images need no geometry,
/// and give their sizes alone.
BeadCalibration calibrateFromPickedBeads(std::span<const std::filesystem::path> images,
                                         const std::filesystem::path& beads, const std::filesystem::path& sightings,
                                         const Job& job = {});

}  // namespace sinew
