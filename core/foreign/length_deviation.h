#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/foreign/foreign_model.h"
#include "core/foreign/structure_deviation.h"
#include "core/model/model.h"

namespace sinew {

/// How far the length of one unit is from ours in an exported model [m].
struct UnitDeviation {
  std::string unit;
  bool blended = false;                          ///< has a path point between two segments
  bool on_driven = false;                        ///< has a path point on a patella or radius
  double median_norm_m = 0, max_norm_m = 0;      ///< every coordinate alone over the adult norm, steps of 10 deg
  double median_random_m = 0, max_random_m = 0;  ///< 100 random postures inside the adult norm
  bool isExact() const;                          ///< within 0.1 mm everywhere
};

struct LengthDeviation {
  int norm_postures = 0, random_postures = 0;
  std::vector<UnitDeviation> units;
  /// Joints whose edited range the other program has as the box about it; empty if none, or if it has the range.
  std::vector<std::string> boxed_ranges;
  std::optional<StructureDeviation>
      structures;  ///< of the moments of capsules and ligaments, where they were compared

  int exactUnits() const;
  double medianOfMaxima_m() const;  ///< over the units that are not exact; 0 if all are
  const UnitDeviation& worst() const;
};

/// Compares lengths by unit at postures of ours with what `theirs` answers.
LengthDeviation lengthDeviation(const Model& model, const std::function<Eigen::VectorXd(const Posture&)>& theirs);

/// The same for a model that foreignFromModel() made, or one read back from its file: coordinates and units by name.
/// Compares the structures too.
LengthDeviation lengthDeviation(const Model& model, const ForeignModel& foreign);

/// One line: how many are exact, how far the others are off.
std::string summaryText(const LengthDeviation& deviation);

}  // namespace sinew
