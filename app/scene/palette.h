#pragma once
#include <span>
#include <string_view>

namespace sinew {

/// sRGB, 0-1.
struct Rgb {
  double r = 0, g = 0, b = 0;
};

/// Colours that stay apart for colour-blind readers (Okabe & Ito 2008).
namespace palette {
inline constexpr Rgb kOrange{0.902, 0.624, 0.000}, kSkyBlue{0.337, 0.706, 0.914}, kGreen{0.000, 0.620, 0.451},
    kYellow{0.941, 0.894, 0.259}, kBlue{0.000, 0.447, 0.698}, kVermilion{0.835, 0.369, 0.000},
    kPurple{0.800, 0.475, 0.655}, kGrey{0.6, 0.6, 0.6};
inline constexpr Rgb kBone{0.925, 0.890, 0.800};    ///< ivory
inline constexpr Rgb kQuietBone{0.52, 0.53, 0.55};  ///< while the colours of muscles are read
inline constexpr Rgb kSelection{1.00, 0.25, 0.75};  ///< edge of what is chosen: in none of the colour maps
inline constexpr Rgb kMuscle{0.690, 0.255, 0.220};  ///< for who wants anatomy's colour
}  // namespace palette

/// A colour map through evenly spaced `stops`; `t` in [0, 1], cut off there.
Rgb interpolatedColour(std::span<const Rgb> stops, double t);
/// Violet over green to yellow; lightness grows all the way, so that it reads in grey; its dark end stays visible on
/// a dark ground. `t` in [0, 1].
Rgb sequentialColour(double t);
/// Blue (0) over near white (0.5) to orange-brown (1).
Rgb divergingColour(double t);
/// Fixed colour of a muscle group: the same name gives the same colour in every picture.
Rgb groupColour(std::string_view group);

}  // namespace sinew
