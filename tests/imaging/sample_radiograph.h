#pragma once
#include <cmath>
#include <memory>
#include <vector>

#include "imaging/radiograph/radiograph.h"

namespace sinew::test {

/// A small 12-bit image of smooth shades and fine texture, with every tag filled.
inline Radiograph sampleRadiograph(int width = 61, int height = 47) {
  Radiograph r;
  r.width_px = width;
  r.height_px = height;
  r.bits_stored = 12;
  std::vector<std::uint16_t> pixels;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      pixels.push_back(std::uint16_t((u * 31 + v * 17 + (u * v) % 97 + int(900 * std::sin(0.1 * u))) & 0xfff));
  r.pixels = std::make_shared<const std::vector<std::uint16_t>>(std::move(pixels));
  r.window_center = 2040.5;
  r.window_width = 3000.25;
  r.spacing = PixelSpacing{0.1875, 0.1825, PixelScaleSource::Geometry};
  RadiographTags& t = r.tags;
  t.modality = "DX";
  t.sop_class_uid = "1.2.840.10008.5.1.4.1.1.1.1";
  t.sop_instance_uid = "2.25.1001";
  t.study_instance_uid = "2.25.1002";
  t.frame_of_reference_uid = "2.25.1003";
  t.transfer_syntax = "Little Endian Explicit";
  t.patient_name = "M\xc3\xbcller^J\xc3\xb6rg";
  t.patient_id = "SYNTHETIC-7";
  t.patient_birth_date = "20120229";
  t.patient_sex = "F";
  t.study_date = "20240105";
  t.view_position = "AP";
  t.image_laterality = "B";
  t.manufacturer = "Sinew";
  t.patient_orientation = "L\\F";
  t.imager_column_mm = 0.254;
  t.imager_row_mm = 0.2525;
  t.distance_source_to_detector_mm = 1300.123456789;
  t.distance_source_to_patient_mm = 986.5;
  t.distance_source_to_isocenter_mm = 987.25;  // stored in single precision: a value that it holds
  t.estimated_magnification = 1.3178;
  t.positioner_primary_angle_deg = -12.5;
  t.positioner_secondary_angle_deg = 0;
  return r;
}

}  // namespace sinew::test
