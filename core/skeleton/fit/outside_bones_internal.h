#pragma once
#include <optional>
#include <span>
#include <vector>

#include "core/skeleton/fit/bone_figure.h"
#include "core/skeleton/fit/fit_report_internal.h"

namespace sinew {

/// What the picks of one landmark say against the fitted bone.
struct LandmarkMisfit {
  int landmark = 0;                  ///< index into skeleton.landmarks
  double chi2 = 0;                   ///< sum of squares of its whitened residuals
  double degrees = 0;                ///< what is expected of it: rows less the share that the fit has used up
  std::optional<double> distance_m;  ///< from the fitted landmark to where its picks meet
};

/// Bones whose residuals together have a chance below 1 in 30,000 if the bone were one of the model's; worst first.
/// Two landmarks at least must speak: one alone is a pick to be looked at, not a bone.
std::vector<OutsideBone> outsideBones(const Skeleton& reference, std::span<const LandmarkMisfit> misfits);
/// "outside_model", one for every bone.
void warnOfOutsideBones(std::span<const OutsideBone> bones, Warnings& warnings);

/// Which of the sightings that lie far off are slips of the hand, to be left out: those whose landmark's picks
/// contradict each other, and those that are alone of their bone while the same landmark's other picks fit. The rest
/// - several landmarks of one bone, or one whose picks agree - say something about the bone and are kept.
/// @param sigmas of every item of the list. @param limit what lies far off; beyond half of it a landmark counts as
/// disagreeing with its bone. @param contradicts by landmark of the list: its picks do not meet.
/// @return indices into list.items, the worst first.
std::vector<std::size_t> slipsAmong(const Skeleton& reference, const SightingList& list,
                                    std::span<const double> sigmas, double limit,
                                    const std::vector<bool>& contradicts);

/// "femur_r" -> "right femur".
std::string boneInWords(const std::string& segment);

}  // namespace sinew
