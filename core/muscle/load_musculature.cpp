#include "core/muscle/load_musculature.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "core/csv_table.h"
#include "core/error.h"
#include "core/skeleton/kinematics.h"
#include "core/text.h"

namespace sinew {
namespace {

using std::filesystem::path;

double numberIn(const CsvTable& table, std::size_t row, const char* column, double above, double below) {
  const double value = table.number(row, column);
  if (!(value > above && value < below)) {
    const std::string range = "a number above " + std::to_string(above) + " and below " + std::to_string(below);
    throw InputError{{table.where(row), column, range, table.text(row, column)}};
  }
  return value;
}

/// Metres: nothing in the body is longer.
constexpr double kLongest_m = 2;

std::map<std::string, MusculotendonUnit> readPhysiology(const path& folder, std::vector<std::string>& order) {
  const CsvTable table{folder / "muscles.csv",
                       "sinew.muscles",
                       1,
                       {"name", "group", "max_isometric_force_N", "optimal_fiber_length_m", "tendon_slack_length_m",
                        "pennation_angle_at_optimal_deg", "source"}};
  std::map<std::string, MusculotendonUnit> units;
  for (std::size_t row = 0; row < table.rowCount(); ++row) {
    MusculotendonUnit unit;
    unit.name = table.required(row, "name");
    if (!unit.name.ends_with("_r")) throw InputError{{table.where(row), "name", "a name that ends in _r", unit.name}};
    unit.group = table.required(row, "group");
    unit.max_isometric_force_N = numberIn(table, row, "max_isometric_force_N", 0, 1e5);
    unit.optimal_fiber_length_m = numberIn(table, row, "optimal_fiber_length_m", 0, kLongest_m);
    unit.tendon_slack_length_m = numberIn(table, row, "tendon_slack_length_m", 0, kLongest_m);
    unit.pennation_angle_at_optimal_rad =
        numberIn(table, row, "pennation_angle_at_optimal_deg", -1e-9, 60) * std::numbers::pi / 180;
    unit.source = table.required(row, "source");
    order.push_back(unit.name);
    if (!units.emplace(unit.name, unit).second)
      throw InputError{{table.where(row), "name", "a muscle once", "'" + unit.name + "' again"}};
  }
  return units;
}

/// "humerus_r*0.5+ulna_r*0.5" or "pelvis": segments and weights.
std::vector<Anchor> parseAnchors(const std::string& text, const std::string& where, const Skeleton& skeleton) {
  std::vector<Anchor> anchors;
  double sum = 0;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find('+', start), text.size());
    const std::string term = text.substr(start, end - start);
    start = end + 1;
    const std::size_t star = term.find('*');
    Anchor anchor;
    try {
      anchor.segment = skeleton.segmentIndex(term.substr(0, star));
    } catch (const InputError& error) {
      throw InputError{where + ": anchors: " + error.what()};
    }
    if (star != std::string::npos) anchor.weight = parseNumber(term.substr(star + 1), where, "anchors: weight");
    if (!(anchor.weight >= 0)) throw InputError{{where, "anchors", "weights >= 0", "'" + text + "'"}};
    sum += anchor.weight;
    anchors.push_back(anchor);
  }
  if (std::abs(sum - 1) > 1e-9) throw InputError{{where, "anchors", "weights with sum 1", "'" + text + "'"}};
  return anchors;
}

PathPointRole parseRole(const std::string& text, const std::string& where) {
  if (text == "origin") return PathPointRole::Origin;
  if (text == "via") return PathPointRole::Via;
  if (text == "insertion") return PathPointRole::Insertion;
  throw InputError{{where, "role", "origin, via or insertion", "'" + text + "'"}};
}

void readPaths(const path& folder, const Skeleton& skeleton, const std::vector<RigidTransform>& X_WB,
               std::map<std::string, MusculotendonUnit>& units) {
  const CsvTable table{folder / "muscle_paths.csv",
                       "sinew.muscle_paths",
                       1,
                       {"muscle", "point", "role", "anchors", "bone", "x_m", "y_m", "z_m", "site"}};
  std::vector<std::string> known;
  for (const auto& [name, unit] : units) known.push_back(name);
  for (std::size_t row = 0; row < table.rowCount(); ++row) {
    const std::string& name = table.required(row, "muscle");
    const auto unit = units.find(name);
    if (unit == units.end())
      throw InputError{
          {table.where(row), "muscle", "a muscle of muscles.csv", "'" + name + "'" + didYouMean(name, known)}};
    auto& points = unit->second.path;
    if (table.number(row, "point") != static_cast<double>(points.size()))
      throw InputError{{table.where(row), "point", std::to_string(points.size()), table.text(row, "point")}};
    PathPoint point{parseRole(table.text(row, "role"), table.where(row)),
                    parseAnchors(table.required(row, "anchors"), table.where(row), skeleton),
                    table.required(row, "bone"), table.required(row, "site")};
    const auto metres = [&](const char* column) { return numberIn(table, row, column, -kLongest_m, kLongest_m); };
    const Eigen::Vector3d p_W =
        X_WB[point.anchors.front().segment] * Eigen::Vector3d{metres("x_m"), metres("y_m"), metres("z_m")};
    for (Anchor& anchor : point.anchors) anchor.p_B = X_WB[anchor.segment].inverse() * p_W;
    points.push_back(std::move(point));
  }
  for (const auto& [name, unit] : units) {
    const auto& points = unit.path;
    bool ordered = points.size() >= 2 && points.front().role == PathPointRole::Origin &&
                   points.back().role == PathPointRole::Insertion;
    for (std::size_t i = 1; ordered && i + 1 < points.size(); ++i) ordered = points[i].role == PathPointRole::Via;
    if (!ordered)
      throw InputError{{"muscle_paths.csv", "'" + name + "'", "origin, via points, insertion",
                        std::to_string(points.size()) + " points in another order"}};
  }
}

void readFittedLengths(const path& folder, std::string_view preset, std::map<std::string, MusculotendonUnit>& units) {
  const CsvTable table{folder / lengthsFile(preset),
                       "sinew.reference_lengths",
                       1,
                       {"muscle", "optimal_fiber_length_m", "tendon_slack_length_m"}};
  std::set<std::string> seen;
  for (std::size_t row = 0; row < table.rowCount(); ++row) {
    const std::string& name = table.required(row, "muscle");
    const auto unit = units.find(name);
    if (unit == units.end() || !seen.insert(name).second)
      throw InputError{{table.where(row), "muscle", "every muscle of muscles.csv once", "'" + name + "'"}};
    unit->second.optimal_fiber_length_m = numberIn(table, row, "optimal_fiber_length_m", 0, kLongest_m);
    unit->second.tendon_slack_length_m = numberIn(table, row, "tendon_slack_length_m", 0, kLongest_m);
  }
  if (seen.size() != units.size())
    throw InputError{{lengthsFile(preset), "rows", std::to_string(units.size()), std::to_string(seen.size())}};
}

MusculotendonUnit mirroredUnit(MusculotendonUnit unit, const Skeleton& skeleton,
                               const std::vector<RigidTransform>& X_WB) {
  unit.name.back() = 'l';
  for (PathPoint& point : unit.path) {
    for (Anchor& anchor : point.anchors) {
      const Eigen::Vector3d p_W = X_WB[anchor.segment] * anchor.p_B;
      std::string name = skeleton.segments[anchor.segment].name;
      if (name.ends_with("_r")) anchor.segment = skeleton.segmentIndex(name.replace(name.size() - 1, 1, "l"));
      anchor.p_B = X_WB[anchor.segment].inverse() * mirrored(p_W);
    }
  }
  return unit;
}

/// Without `preset` the lengths are the published ones.
Musculature load(const path& resource_dir, const Skeleton& skeleton, std::optional<std::string_view> preset) {
  const path folder = resource_dir / "muscles";
  const auto X_WB = segmentPoses(skeleton, zeroPosture(skeleton));
  std::vector<std::string> order;
  auto units = readPhysiology(folder, order);
  readPaths(folder, skeleton, X_WB, units);
  if (preset) readFittedLengths(folder, *preset, units);
  Musculature musculature;
  for (const auto& name : order) musculature.units.push_back(units.at(name));
  for (const auto& name : order) musculature.units.push_back(mirroredUnit(units.at(name), skeleton, X_WB));
  return musculature;
}

}  // namespace

std::string lengthsFile(std::string_view preset) {
  return preset == "average-adult" ? "reference_lengths.csv" : "reference_lengths_" + std::string{preset} + ".csv";
}

Musculature loadMusculature(const path& resource_dir, const Skeleton& skeleton, std::string_view preset) {
  return load(resource_dir, skeleton, preset);
}

Musculature loadPublishedMusculature(const path& resource_dir, const Skeleton& skeleton) {
  return load(resource_dir, skeleton, std::nullopt);
}

}  // namespace sinew
