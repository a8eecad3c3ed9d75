#include "imaging/radiograph/pixel_spacing.h"

#include <cmath>

namespace sinew {
namespace {

using Pair = PixelSpacingFacts::Pair;

constexpr double kMaxMagnification = 3;  // of any clinical set-up; beyond it the tags are wrong

std::optional<Pair> usable(const std::optional<Pair>& pair, const char* name, Warnings& warnings) {
  if (!pair) return std::nullopt;
  if (pair->row_mm > 0 && pair->column_mm > 0 && std::isfinite(pair->row_mm) && std::isfinite(pair->column_mm))
    return pair;
  warnings.push_back({"pixel_spacing_zero", std::string{name} + " is not a size > 0: taken as absent."});
  return std::nullopt;
}

/// Magnification detector : patient plane, from the tags.
std::optional<double> magnification(const PixelSpacingFacts& f, Warnings& warnings) {
  std::optional<double> m = f.magnification;
  if (!m && f.source_to_detector_mm && f.source_to_patient_mm && *f.source_to_patient_mm > 0)
    m = *f.source_to_detector_mm / *f.source_to_patient_mm;
  if (m && !(*m >= 1 && *m <= kMaxMagnification)) {
    warnings.push_back(
        {"magnification_odd", "The magnification in the file's tags is not between 1 and 3: not used."});
    return std::nullopt;
  }
  return m;
}

PixelSpacing scaled(const Pair& pair, double factor, PixelScaleSource source) {
  return {pair.column_mm * factor, pair.row_mm * factor, source};
}

}  // namespace

std::optional<PixelSpacing> choosePixelSpacing(const PixelSpacingFacts& f, Warnings& warnings) {
  const auto pixel = usable(f.pixel_spacing, "Pixel Spacing", warnings);
  const auto imager = usable(f.imager_spacing, "Imager Pixel Spacing", warnings);
  if (pixel && f.calibration_type == "FIDUCIAL") return scaled(*pixel, 1, PixelScaleSource::Fiducial);
  if (pixel && f.calibration_type == "GEOMETRY") return scaled(*pixel, 1, PixelScaleSource::Geometry);
  if (f.declared_mm) return scaled({*f.declared_mm, *f.declared_mm}, 1, PixelScaleSource::Declared);

  // Pixel Spacing that differs from the detector's was corrected for some magnification; the standard only fails to
  // make the file say which (PS3.3, 10.7.1.3).
  if (pixel && imager && *pixel != *imager) {
    warnings.push_back({"pixel_spacing_unexplained",
                        "Pixel Spacing differs from Imager Pixel Spacing, but the file does not say how it was "
                        "calibrated; it is taken as corrected for geometry."});
    return scaled(*pixel, 1, PixelScaleSource::Geometry);
  }
  if (imager)
    if (const auto m = magnification(f, warnings)) return scaled(*imager, 1 / *m, PixelScaleSource::ImagerMagnified);
  if (imager || pixel) {
    warnings.push_back({"pixel_spacing_at_detector",
                        "The size of a pixel is known at the detector only: lengths in the patient are too long by "
                        "the magnification."});
    return scaled(imager ? *imager : *pixel, 1, PixelScaleSource::ImagerAtDetector);
  }
  warnings.push_back({"pixel_spacing_missing", "The file states no pixel size: lengths in this image are in px."});
  return std::nullopt;
}

}  // namespace sinew
