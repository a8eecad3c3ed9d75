#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace sinew {

/// One landmark seen in one radiograph.
struct Sighting {
  std::string name;       ///< landmark
  int view = 0;           ///< of the rig, from 0 (files count from 1)
  Eigen::Vector2d uv_px;  ///< image frame I: origin at the centre of the top-left pixel, u right, v down
  double sigma_px = 1.0;  ///< reader's placement error, one standard deviation
  friend bool operator==(const Sighting&, const Sighting&) = default;
};

/// CSV `name,view,u_px,v_px[,sigma_px]`. @throws InputError with file, line, field, expected, found.
std::vector<Sighting> loadSightings(const std::filesystem::path& file);
void saveSightings(const std::vector<Sighting>& sightings, const std::filesystem::path& file);

}  // namespace sinew
