#pragma once
#include <vector>

#include "core/model/model.h"

namespace sinew {

/// Which shape parameters a unit feels: through the fields of the segments that it hangs on or spans, or through
/// where these lie. Found by trying every parameter on the reference, so that it holds for whatever the field is. If
/// none of them changes, nothing about the unit does, to the last bit.
class ShapeDependencies {
 public:
  /// `reference` undeformed.
  explicit ShapeDependencies(const Model& reference);

  /// Whether all that unit u feels is equal in both; values in the order of shapeParameterNames().
  bool equal(std::size_t unit, const std::vector<double>& a, const std::vector<double>& b) const;
  /// Whether the body is its own mirror image as far as unit u feels it.
  bool symmetric(std::size_t unit, const std::vector<double>& shape) const;

 private:
  std::vector<std::vector<int>> felt_;  ///< by unit: parameters
};

}  // namespace sinew
