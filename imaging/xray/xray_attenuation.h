#pragma once

namespace sinew {

// Linear attenuation at 60 keV, the effective energy of an 80-90 kV beam behind a patient [1/m]: mass attenuation
// coefficients of Hubbell & Seltzer (NIST 126) times the densities of ICRU 44.
inline constexpr double kMuscleAttenuation_per_m = 0.2048 * 105;
inline constexpr double kFatAttenuation_per_m = 0.1974 * 95;
inline constexpr double kLungAttenuation_per_m = 0.2048 * 26;
inline constexpr double kCorticalBoneAttenuation_per_m = 0.3148 * 192;
inline constexpr double kSteelAttenuation_per_m = 1.205 * 787;
inline constexpr double kAcrylicAttenuation_per_m = 0.1924 * 119;
inline constexpr double kFoamAttenuation_per_m = 0.19 * 5;  ///< rigid polymer foam, 50 kg/m^3
/// Spongy bone: a fifth of its volume is bone, the rest marrow (half fat); the cavity of a shaft is fat.
inline constexpr double kMarrowAttenuation_per_m = 0.5 * (kMuscleAttenuation_per_m + kFatAttenuation_per_m);
inline constexpr double spongyAttenuation_per_m(double bone_share) {
  return bone_share * kCorticalBoneAttenuation_per_m + (1 - bone_share) * kMarrowAttenuation_per_m;
}

}  // namespace sinew
