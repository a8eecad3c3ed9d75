#include <Eigen/SVD>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <sstream>

#include "core/file.h"
#include "core/text.h"
#include "imaging/radiograph/radiograph.h"
#include "imaging/rig/biplanar_rig.h"

namespace sinew {
namespace {

constexpr double kMillimetre_m = 1e-3;

/// Heading in lower case -> the numbers of the lines below it.
using Sections = std::map<std::string, std::vector<std::vector<double>>>;

Sections readSections(const std::filesystem::path& file) {
  std::istringstream in{readFile(file, std::uintmax_t{1} << 20)};
  Sections sections;
  std::string line, heading;
  for (int number = 1; std::getline(in, line); ++number) {
    const auto cells = splitCsvLine(line);
    if (cells.size() == 1 && cells[0].empty()) continue;
    const std::string where = file.string() + ": line " + std::to_string(number);
    if (cells.size() == 1 && std::isalpha(static_cast<unsigned char>(cells[0][0]))) {
      heading = cells[0];
      std::transform(heading.begin(), heading.end(), heading.begin(),
                     [](unsigned char c) { return std::tolower(c); });
      if (!sections.try_emplace(heading).second) throw InputError{{where, heading, "one section", "a second one"}};
      continue;
    }
    if (heading.empty())
      throw InputError{{where, "heading", "'image size' (MayaCam 2 layout; MayaCam 1 has no headings)",
                        "'" + line.substr(0, 40) + "'"}};
    std::vector<double> row;
    for (const auto& cell : cells) row.push_back(parseNumber(cell, where, heading));
    sections[heading].push_back(row);
  }
  return sections;
}

/// The section as a matrix of this shape.
Eigen::MatrixXd matrixOf(const Sections& sections, const std::string& heading, int rows, int columns,
                         const std::string& file) {
  const std::string shape = std::to_string(rows) + " x " + std::to_string(columns) + " numbers";
  const auto found = sections.find(heading);
  if (found == sections.end()) throw InputError{{file, heading, shape, "no such section"}};
  std::vector<double> values;
  for (const auto& row : found->second) {
    if (int(row.size()) != columns)
      throw InputError{{file, heading, shape, "a row of " + std::to_string(row.size())}};
    values.insert(values.end(), row.begin(), row.end());
  }
  if (int(values.size()) != rows * columns)
    throw InputError{{file, heading, shape, std::to_string(found->second.size()) + " rows"}};
  return Eigen::Map<Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(values.data(), rows, columns);
}

ConeBeam coneBeamFrom(const Eigen::Matrix3d& K, const std::string& file) {
  const bool upper_triangular = K(1, 0) == 0 && K(2, 0) == 0 && K(2, 1) == 0 && std::abs(K(2, 2) - 1) < 1e-9;
  if (!upper_triangular || !(K(0, 0) > 0 && K(1, 1) > 0))
    throw InputError{{file, "camera matrix", "[fx 0 cx; 0 fy cy; 0 0 1] with fx, fy > 0",
                      "diagonal " + std::to_string(K(0, 0)) + ", " + std::to_string(K(1, 1)) + ", " +
                          std::to_string(K(2, 2)) + (upper_triangular ? "" : " and numbers below it")}};
  if (std::abs(K(0, 1)) > 1e-6 * K(0, 0))
    throw InputError{{file, "camera matrix", "no skew (second number 0)", std::to_string(K(0, 1))}};
  return {.fx_px = K(0, 0), .fy_px = K(1, 1), .cx_px = K(0, 2), .cy_px = K(1, 2)};
}

/// The nearest rotation: text files round to a dozen digits.
Eigen::Matrix3d rotationFrom(const Eigen::Matrix3d& R, const std::string& file) {
  if (!((R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-3))
    throw InputError{{file, "rotation", "three orthogonal unit rows",
                      "an error of " + std::to_string((R * R.transpose() - Eigen::Matrix3d::Identity()).norm())}};
  if (R.determinant() < 0) throw InputError{{file, "rotation", "determinant +1", "-1 (a mirrored frame)"}};
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd{R, Eigen::ComputeFullU | Eigen::ComputeFullV};
  return svd.matrixU() * svd.matrixV().transpose();
}

View readView(const std::filesystem::path& path) {
  const std::string file = path.string();
  const Sections sections = readSections(path);
  const Eigen::MatrixXd size = matrixOf(sections, "image size", 1, 2, file);
  View view;
  for (int i = 0; i < 2; ++i)
    if (!(size(0, i) >= 1 && size(0, i) <= kMaxImageSide_px && size(0, i) == std::floor(size(0, i))))
      throw InputError{{file, "image size", "whole numbers up to " + std::to_string(kMaxImageSide_px),
                        std::to_string(size(0, i))}};
  view.width_px = int(size(0, 0));
  view.height_px = int(size(0, 1));
  view.projection = coneBeamFrom(matrixOf(sections, "camera matrix", 3, 3, file), file);
  view.R_CW = rotationFrom(matrixOf(sections, "rotation", 3, 3, file), file);
  view.p_CW = matrixOf(sections, "translation", 3, 1, file) * kMillimetre_m;
  return view;
}

}  // namespace

BiplanarRig importTextCalibration(std::span<const std::filesystem::path> files, const std::string& method) {
  if (files.size() < 2)
    throw InputError{{method + " calibration", "files", "2 or more, one a view", std::to_string(files.size())}};
  BiplanarRig rig;
  rig.views.clear();
  for (const auto& file : files) rig.views.push_back({readView(file), ViewRole::Other, 0});
  rig.patient_aligned = false;  // the laboratory's frame, whichever that is
  rig.calibration.method = method;
  rig.calibration.id = geometryId(rig.views);
  constexpr double kDegree_rad = 0.017453292519943295;
  if (std::sin(angleBetweenViews_rad(rig)) < std::sin(20 * kDegree_rad))
    rig.calibration.warnings.push_back(
        {"views_nearly_parallel", "The two views are " +
                                      std::to_string(int(std::lround(angleBetweenViews_rad(rig) / kDegree_rad))) +
                                      " deg apart: depth is poorly determined; expected 30 to 150 deg."});
  return rig;
}

}  // namespace sinew
