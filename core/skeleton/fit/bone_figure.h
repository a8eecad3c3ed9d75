#pragma once
#include <limits>
#include <string>
#include <vector>

namespace sinew {

inline constexpr double kNoFigure = std::numeric_limits<double>::quiet_NaN();

/// A clinical figure of the bones with its 95 % interval.
struct BoneFigure {
  std::string quantity;  ///< "femur_length", "tibial_torsion", ...
  std::string side;      ///< "r", "l" or ""
  std::string unit;      ///< "mm" or "deg"
  double value = kNoFigure;
  double lower95 = kNoFigure, upper95 = kNoFigure;
  bool determined = false;  ///< false: the images do not say, or not well enough for any clinical use

  /// The value is taken from the picks themselves (triangulated), because a bone is outside the model's family of
  /// shapes; otherwise from the fitted skeleton.
  bool triangulated = false;
  /// The same figure the other way, for comparison: triangulated if the value is fitted, fitted if it is
  /// triangulated. NaN where the picks do not give it.
  double other = kNoFigure, other_lower95 = kNoFigure, other_upper95 = kNoFigure;
};

/// A bone whose picks agree with each other in both views, but not with any bone of the model.
struct OutsideBone {
  std::string segment;        ///< "femur_r"
  double misfit = kNoFigure;  ///< root of (sum of squares of its residuals / their degrees of freedom); 1 is expected
  std::string landmark;       ///< the one that lies farthest off ...
  double distance_mm = kNoFigure;  ///< ... and how far
};

/// What would determine a figure that is not: the landmarks whose picks narrow its interval most, one after the
/// other.
struct FigureAdvice {
  std::string quantity, side;
  std::vector<std::string> landmarks;  ///< in order of gain
  bool enough = false;                 ///< they suffice; otherwise they only help
};

/// The widest 95 % interval, as +- half its width, with which a figure counts as determined [mm or deg].
struct FigureLimit {
  const char* quantity;
  double half_width;
  const char* reason;
};
/// The limits of all figures (estimated from what decisions are taken with them; docs/methods/clinical_figures.md).
const std::vector<FigureLimit>& figureLimits();

}  // namespace sinew
