#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace sinew {

/// Population prior of one shape parameter.
struct ShapePrior {
  std::string parameter;  ///< of shapeParameterNames()
  double mean = 0, sd = 1;
  std::string source;
  /// What a deformity clinic sees and a body without deformity has not, or hardly: the fit allows for it, a patient
  /// who is drawn without deformity stays at the reference.
  bool deformity = false;
};
/// Reads clinical/shape_priors.json (angles in degrees and lengths in millimetres there, radians and metres here).
std::vector<ShapePrior> loadShapePriors(const std::filesystem::path& resource_dir);

}  // namespace sinew
