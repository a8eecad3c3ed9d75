#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"

namespace sinew {

/// Largest side of an image that any part accepts.
inline constexpr int kMaxImageSide_px = 20000;

/// Where the millimetres of a pixel come from; rule: fiducial > geometry > user's ball > imager/ERMF or
/// imager * SOD / SID > none.
enum class PixelScaleSource { None, Fiducial, Geometry, Declared, ImagerMagnified, ImagerAtDetector };

/// Size of one pixel. At the detector it is not the size at the patient: see `source`.
struct PixelSpacing {
  double column_mm = 0;  ///< distance of neighbouring columns (along u)
  double row_mm = 0;     ///< distance of neighbouring rows (along v)
  PixelScaleSource source = PixelScaleSource::None;
  friend bool operator==(const PixelSpacing&, const PixelSpacing&) = default;
};

/// DICOM attributes that the product uses, in DICOM's words and units. Empty or nullopt = not in the file.
struct RadiographTags {
  std::string modality, sop_class_uid, sop_instance_uid, study_instance_uid, frame_of_reference_uid;
  std::string transfer_syntax;  ///< in words, e.g. "JPEG Lossless"
  std::string patient_name;     ///< UTF-8, DICOM order Family^Given=...
  std::string patient_id, patient_birth_date, patient_sex, study_date, view_position, image_laterality;
  std::string manufacturer, patient_orientation;
  std::optional<double> imager_column_mm, imager_row_mm;  ///< Imager Pixel Spacing
  std::optional<double> distance_source_to_detector_mm, distance_source_to_patient_mm,
      distance_source_to_isocenter_mm, estimated_magnification;
  std::optional<double> positioner_primary_angle_deg, positioner_secondary_angle_deg;
};

/// One projection image, grey values as stored, 8-16 bit. Pixels are shared: copies are cheap.
struct Radiograph {
  int width_px = 0, height_px = 0;
  int bits_stored = 16;
  bool monochrome1 = false;  ///< low values are bright (MONOCHROME1, or Presentation LUT Shape INVERSE)
  std::shared_ptr<const std::vector<std::uint16_t>>
      pixels;                                  ///< row by row from the top left; signed data offset to >= 0
  double window_center = 0, window_width = 0;  ///< in stored grey values; from the file, or the 1-99 % range
  std::optional<PixelSpacing> spacing;
  RadiographTags tags;
  Warnings warnings;

  std::uint16_t at(int u, int v) const { return (*pixels)[std::size_t(v) * std::size_t(width_px) + std::size_t(u)]; }
};

/// Reads DICOM (CR, DX, XA, RF, secondary capture; uncompressed, RLE, JPEG lossless, JPEG-LS), TIFF or PNG by
/// content. `declared_spacing_mm`: pixel size stated by a person, for files that carry none.
/// @throws InputError: corrupt, truncated, wrong modality, several frames, colour, absurd size, JPEG 2000, ...
Radiograph readRadiograph(const std::filesystem::path& file, std::optional<double> declared_spacing_mm = {});

/// Writes an uncompressed Digital X-Ray (DX for presentation) DICOM file, UTF-8. Geometry tags as given.
void writeDicom(const Radiograph& radiograph, const std::filesystem::path& file);

/// 8-bit display values after window and inversion (bright = dense bone), row by row.
std::vector<std::uint8_t> displayPixels(const Radiograph& radiograph, double window_center, double window_width,
                                        bool invert);

}  // namespace sinew
