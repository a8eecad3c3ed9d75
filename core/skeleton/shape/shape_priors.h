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
};
/// Reads clinical/shape_priors.json (angles in degrees there, radians here).
std::vector<ShapePrior> loadShapePriors(const std::filesystem::path& resource_dir);

}  // namespace sinew
