#include "imaging/calibration/calibration_object.h"

#include <Eigen/SVD>
#include <array>
#include <cstdio>
#include <sstream>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "imaging/calibration/calibration_internal.h"

namespace sinew {

constexpr double kMillimetre_m = 1e-3;

double flatness(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Matrix3Xd centred(3, Eigen::Index(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) centred.col(Eigen::Index(i)) = points[i];
  const Eigen::Vector3d mean = centred.rowwise().mean();
  centred.colwise() -= mean;
  const Eigen::Vector3d s = Eigen::JacobiSVD<Eigen::MatrixXd>{centred}.singularValues();
  return s[0] > 0 ? s[2] / s[0] : 0;
}

CalibrationObject defaultCalibrationObject() {
  CalibrationObject object{"lower_limb_frame", {}};
  const auto add = [&](const char* prefix, int number, const Eigen::Vector3d& p_mm, double diameter_mm) {
    char name[16];
    std::snprintf(name, sizeof name, "%s%02d", prefix, number);
    object.beads.push_back({name, p_mm * kMillimetre_m, diameter_mm * kMillimetre_m});
  };
  // Four posts with six small beads each. The steps differ from post to post and within a post, so that no turn or
  // mirror maps the beads onto each other and no two lie at one height.
  constexpr double kPost_mm[4][2] = {{200, 250}, {200, -250}, {-200, 250}, {-200, -250}};
  constexpr double kHeight_mm[4][6] = {{-560, -347, -121, 83, 301, 519},
                                       {-478, -318, -60, 172, 366, 560},
                                       {-449, -251, -40, 188, 402, 478},
                                       {-545, -376, -145, 20, 226, 421}};
  int number = 0;
  for (int post = 0; post < 4; ++post)
    for (double y_mm : kHeight_mm[post]) add("S", ++number, {kPost_mm[post][0], y_mm, kPost_mm[post][1]}, 4);
  // Eight large beads on the cross-bars between the posts.
  constexpr double kLarge_mm[8][3] = {{200, -420, 30}, {200, 215, -70}, {-200, -210, 80}, {-200, 370, -40},
                                      {40, -310, 250}, {-70, 115, 250}, {70, 15, -250},   {-30, 505, -250}};
  for (int i = 0; i < 8; ++i) add("L", i + 1, {kLarge_mm[i][0], kLarge_mm[i][1], kLarge_mm[i][2]}, 8);
  return object;
}

CalibrationObject loadCalibrationObject(const std::filesystem::path& file) {
  std::istringstream in{readFile(file, std::uintmax_t{16} << 20)};
  CalibrationObject object{file.stem().string(), {}};
  std::string line;
  bool header_seen = false;
  for (int number = 1; std::getline(in, line); ++number) {
    const auto cells = splitCsvLine(line);
    if ((cells.size() == 1 && cells[0].empty()) || cells[0].starts_with("#")) continue;
    const std::string where = file.string() + ": line " + std::to_string(number);
    if (!header_seen) {
      header_seen = true;
      if (cells.size() < 4 || cells[0] != "name" || cells[1] != "x_mm" || cells[2] != "y_mm" || cells[3] != "z_mm")
        throw InputError{{where, "header", "name,x_mm,y_mm,z_mm[,diameter_mm]", "'" + line.substr(0, 60) + "'"}};
      continue;
    }
    if (cells.size() < 4 || cells.size() > 5)
      throw InputError{{where, "columns", "4 or 5", std::to_string(cells.size())}};
    CalibrationBead bead{cells[0], Eigen::Vector3d::Zero(), 0};
    for (int k = 0; k < 3; ++k)
      bead.p_WQ[k] = kMillimetre_m * parseNumber(cells[std::size_t(k) + 1], where, std::string{"xyz"[k]} + "_mm");
    if (cells.size() == 5 && !cells[4].empty())
      bead.diameter_m = kMillimetre_m * parseNumber(cells[4], where, "diameter_mm");
    if (bead.name.empty()) throw InputError{{where, "name", "a bead's name", "nothing"}};
    if (bead.diameter_m < 0) throw InputError{{where, "diameter_mm", "a number >= 0", cells[4]}};
    for (const auto& other : object.beads) {
      if (other.name == bead.name) throw InputError{{where, "name", "each bead once", "'" + bead.name + "' twice"}};
      if ((other.p_WQ - bead.p_WQ).norm() < 1e-4)
        throw InputError{{where, "position", "a place of its own", "that of '" + other.name + "'"}};
    }
    object.beads.push_back(bead);
  }
  if (int(object.beads.size()) < kMinBeads)
    throw InputError{
        {file.string(), "beads", std::to_string(kMinBeads) + " or more", std::to_string(object.beads.size())}};
  std::vector<Eigen::Vector3d> places;
  for (const auto& bead : object.beads) places.push_back(bead.p_WQ);
  if (flatness(places) < kMinFlatness)
    throw InputError{{file.string(), "beads", "places that fill a volume", "all nearly in one plane"}};
  return object;
}

void saveCalibrationObject(const CalibrationObject& object, const std::filesystem::path& file) {
  std::string text = "name,x_mm,y_mm,z_mm,diameter_mm\n";
  for (const auto& bead : object.beads) {
    const Eigen::Vector3d p_mm = bead.p_WQ / kMillimetre_m;
    char numbers[160];
    std::snprintf(numbers, sizeof numbers, ",%.6f,%.6f,%.6f,%.6g\n", p_mm.x(), p_mm.y(), p_mm.z(),
                  bead.diameter_m / kMillimetre_m);
    text += bead.name + numbers;
  }
  writeFileAtomically(file, text);
}

}  // namespace sinew
