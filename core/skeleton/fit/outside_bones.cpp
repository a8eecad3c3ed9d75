#include "core/skeleton/fit/outside_bones_internal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

namespace sinew {
namespace {

/// Upper quantile of chi-squared for a standard normal deviate (Wilson & Hilferty 1931).
double chi2Quantile(double degrees, double deviate) {
  const double v = 2 / (9 * degrees);
  return degrees * std::pow(1 - v + deviate * std::sqrt(v), 3);
}

std::string rounded(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f", value);
  return text.data();
}

}  // namespace

std::string boneInWords(const std::string& segment) {
  const std::string bone{withoutSide(segment)};
  return bone == segment ? bone : (sideSign(segment) < 0 ? "left " : "right ") + bone;
}

std::vector<OutsideBone> outsideBones(const Skeleton& reference, std::span<const LandmarkMisfit> misfits) {
  constexpr double kDeviate = 4;  // one-sided: 3e-5
  constexpr double kFewestDegrees = 2;
  struct Sum {
    double chi2 = 0, degrees = 0, farthest_m = 0;
    int landmarks = 0, worst = -1;
  };
  std::map<int, Sum> bones;
  for (const LandmarkMisfit& m : misfits) {
    Sum& sum = bones[reference.landmarks[std::size_t(m.landmark)].segment];
    sum.chi2 += m.chi2;
    sum.degrees += m.degrees;
    ++sum.landmarks;
    if (m.distance_m && *m.distance_m > sum.farthest_m) sum.farthest_m = *m.distance_m, sum.worst = m.landmark;
  }
  std::vector<OutsideBone> outside;
  for (const auto& [segment, sum] : bones) {
    const double degrees = std::max(sum.degrees, kFewestDegrees);
    if (sum.landmarks < 2 || sum.worst < 0 || sum.chi2 < chi2Quantile(degrees, kDeviate)) continue;
    outside.push_back({reference.segments[std::size_t(segment)].name, std::sqrt(sum.chi2 / degrees),
                       reference.landmarks[std::size_t(sum.worst)].name, 1000 * sum.farthest_m});
  }
  std::ranges::sort(outside, std::greater{}, &OutsideBone::misfit);
  return outside;
}

void warnOfOutsideBones(std::span<const OutsideBone> bones, Warnings& warnings) {
  for (const OutsideBone& bone : bones)
    warnings.push_back({"outside_model",
                        boneInWords(bone.segment) + " is outside the model: its picks lie up to " +
                            rounded(bone.distance_mm) + " mm (" + bone.landmark + ") from the fitted bone, " +
                            rounded(bone.misfit) +
                            " times what picking errors explain. None was left out for it; where its figures differ, "
                            "those of the picks themselves are taken and marked. Check the picks, then the bone"});
}

std::vector<std::size_t> slipsAmong(const Skeleton& reference, const SightingList& list,
                                    std::span<const double> sigmas, double limit,
                                    const std::vector<bool>& contradicts) {
  std::map<int, int> sightings_of, gross_of;    // by landmark of the list
  std::map<int, std::set<int>> disagreeing_of;  // by segment: landmarks off their bone whose picks agree
  const auto segmentOf = [&](int point) {
    return reference.landmarks[std::size_t(list.landmarks[std::size_t(point)])].segment;
  };
  for (std::size_t i = 0; i < sigmas.size(); ++i) {
    const int point = list.items[i].point;
    ++sightings_of[point];
    if (sigmas[i] > limit) ++gross_of[point];
    if (sigmas[i] > limit / 2 && !contradicts[std::size_t(point)]) disagreeing_of[segmentOf(point)].insert(point);
  }
  std::vector<std::size_t> slips;
  for (std::size_t i = 0; i < sigmas.size(); ++i) {
    if (!(sigmas[i] > limit)) continue;
    const int point = list.items[i].point;
    const bool alone_of_bone = disagreeing_of[segmentOf(point)].size() <= 1;
    const bool others_fit = gross_of[point] < sightings_of[point] || sightings_of[point] == 1;
    if (contradicts[std::size_t(point)] || (alone_of_bone && others_fit)) slips.push_back(i);
  }
  std::ranges::sort(slips, [&](std::size_t a, std::size_t b) { return sigmas[a] > sigmas[b]; });
  return slips;
}

}  // namespace sinew
