#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "imaging/xray/pixel_field.h"

namespace sinew {

/// Anything radio-opaque that lies on the detector: a letter of lead.
struct LeadMarker {
  char letter = 'R';          ///< 'R' or 'L'
  double u_mm = 0, v_mm = 0;  ///< its centre, from the top left corner of the image
  double height_mm = 18;
};

/// How a detector sees and a workstation presents an attenuation field. Lengths on the detector.
struct Exposure {
  double pixel_mm = 0.28;
  double photons_per_px = 1.2e6;  ///< without anything in the beam
  double scatter_ratio = 0.25;    ///< scattered over primary photons behind a thick patient, after the grid
  double scatter_reach_mm = 18;   ///< standard deviation of its spread
  double blur_mm = 0.17;          ///< standard deviation of the detector's point spread
  double lead = 5;                ///< attenuation exponent of a marker
  double shutter_mm = 4;          ///< collimated margin, shown black
  int first_open_row = 0;         ///< rows above are collimated too
  double equalization = 0.55;     ///< share of the large-scale differences that the presentation takes away
  double equalization_reach_mm = 28;
  bool quantum_noise = true;
  std::uint64_t seed = 1;
  std::vector<LeadMarker> markers;
};

struct Exposed {
  std::vector<std::uint16_t> pixels;  ///< MONOCHROME2, 14 bit: dense is bright
  double window_center = 0, window_width = 0;
};

constexpr int kExposedBits = 14;

/// Photons behind the patient (Beer-Lambert), scatter, quantum noise, detector blur, logarithm, equalization, grey
/// values. `attenuation` is attenuationField()'s. See docs/methods/synthetic_patient.md.
Exposed expose(PixelField attenuation, int width, const Exposure& exposure);

/// Grey value of a wide uniform region of exponent `attenuation` with no scatter and no equalization.
double greyValueOf(double attenuation);

}  // namespace sinew
