#pragma once
#include <memory>
#include <vector>

#include "core/model/model.h"

namespace sinew {

/// deformedModel() for a shape that follows a hand: only the bones and path points are deformed again whose
/// parameters changed since the last call. Belongs to one thread at a time.
class LiveBody {
 public:
  /// `reference` undeformed; it outlives this (aliasing pointers keep it).
  explicit LiveBody(std::shared_ptr<const Model> reference);

  /// The same as deformedModel(reference, shape), bit for bit. @throws InputError as it does; the next call is not
  /// affected.
  std::shared_ptr<const Model> deformed(const ShapeParameters& shape);

  /// Segments that a parameter (by its place in shapeParameterNames()) deforms.
  const std::vector<bool>& segmentsOf(int parameter) const { return affects_[std::size_t(parameter)]; }

 private:
  std::vector<bool> affectedBy(const ShapeParameters& shape) const;

  std::shared_ptr<const Model> reference_;
  std::vector<std::vector<bool>> affects_;  ///< [parameter][segment]
  std::vector<double> reference_length_m_;  ///< by unit, at the zero posture
  std::shared_ptr<const Model> last_;
};

}  // namespace sinew
