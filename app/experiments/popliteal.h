#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/model/model.h"

namespace sinew {

/// The unilateral popliteal angle (Ryu et al., Individualized Anatomy Modeling): 30 deg in the reference where the
/// net passive torque is 50 N m; a smaller range of the knee gives a larger angle.
struct PoplitealRow {
  std::string body;
  double angle_deg = 0;                              ///< lack of extension at the threshold
  bool stopped_by_joint = false;                     ///< the threshold was not reached
  std::vector<std::pair<double, double>> moment_Nm;  ///< over the written angle [deg]
};
inline constexpr double kPoplitealThreshold_Nm = 50, kPoplitealReference_deg = 30, kPoplitealTolerance_deg = 2;

PoplitealRow poplitealRow(const std::filesystem::path& resource_dir, const Model& model, const std::string& body);

}  // namespace sinew
