#pragma once
#include <optional>
#include <string>

#include "imaging/radiograph/radiograph.h"

namespace sinew {

/// What a file and a person say about the size of a pixel, in millimetres, row (between rows) before column as in
/// DICOM.
struct PixelSpacingFacts {
  struct Pair {
    double row_mm = 0, column_mm = 0;
    friend bool operator==(const Pair&, const Pair&) = default;
  };
  std::optional<Pair> pixel_spacing;   ///< Pixel Spacing (0028,0030)
  std::string calibration_type;        ///< its Calibration Type (0028,0A02): FIDUCIAL, GEOMETRY or nothing
  std::optional<Pair> imager_spacing;  ///< Imager Pixel Spacing (0018,1164): at the detector
  std::optional<double> magnification, source_to_detector_mm, source_to_patient_mm;
  std::optional<double> declared_mm;  ///< stated by a person
};

/// The rule: fiducial > geometry > declared > imager / magnification or imager * SOD / SID > imager, at the detector
/// > none. Zero or negative spacing, which exists in the wild, counts as absent. Doubts are added to `warnings`;
/// nothing is invented.
std::optional<PixelSpacing> choosePixelSpacing(const PixelSpacingFacts& facts, Warnings& warnings);

}  // namespace sinew
