#include "core/muscle/moment_references.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <tuple>

#include "core/csv_table.h"
#include "core/error.h"
#include "core/muscle/muscle_path.h"
#include "core/skeleton/clinical_angles.h"
#include "core/text.h"

namespace sinew {
namespace {

/// The table with either name of every column.
class Table {
 public:
  using Names = std::vector<std::string>;

  Table(const std::filesystem::path& file, const std::vector<Names>& columns) : table_{file, {}} {
    for (const Names& names : columns) {
      const auto found = std::ranges::find_if(names, [&](const auto& name) { return table_.hasColumn(name); });
      if (found == names.end())
        throw InputError{{file.filename().string(), "header", "a column '" + names.front() + "'", "none"}};
      columns_[names.front()] = *found;
    }
  }
  std::size_t rowCount() const { return table_.rowCount(); }
  std::string text(std::size_t row, const std::string& column) const { return table_.text(row, columns_.at(column)); }
  double number(std::size_t row, const std::string& column) const { return table_.number(row, columns_.at(column)); }
  std::string where(std::size_t row) const { return table_.where(row); }
  [[noreturn]] void fail(std::size_t row, const std::string& column, const std::string& expected) const {
    throw InputError{{where(row), columns_.at(column), expected, "'" + text(row, column) + "'"}};
  }

 private:
  CsvTable table_;
  std::map<std::string, std::string> columns_;
};

/// Reads names of a row; a side that is left out is the muscle's, the muscle's own is the right.
class RowReader {
 public:
  RowReader(const Table& table, std::size_t row, const Skeleton& skeleton, const Musculature& musculature)
      : table_{table}, row_{row}, skeleton_{skeleton} {
    std::string name = table.text(row, "muscle");
    if (withoutSide(name) == name) name += "_r";
    unit_ = asked([&] { return musculature.unitIndex(name); });
    side_ = name.substr(name.size() - 2);
  }
  int unit() const { return unit_; }
  int coordinate() const { return coordinateNamed(table_.text(row_, "coordinate")); }
  /// "hip_flexion=45;elbow_flexion_r=90"
  std::map<std::string, double> posture(const std::string& column) const {
    std::map<std::string, double> posture_deg;
    std::istringstream terms{table_.text(row_, column)};
    for (std::string term; std::getline(terms, term, ';');) {
      const auto equals = term.find('=');
      if (equals == std::string::npos) table_.fail(row_, column, "coordinate=degrees;...");
      const int i = coordinateNamed(term.substr(0, equals));
      posture_deg[skeleton_.coordinates[i].name] = parseNumber(term.substr(equals + 1), table_.where(row_), column);
    }
    return posture_deg;
  }

 private:
  template <class Lookup>
  int asked(const Lookup& lookup) const {
    try {
      return lookup();
    } catch (const InputError& error) {
      throw InputError{table_.where(row_) + ": " + error.what()};
    }
  }
  int coordinateNamed(const std::string& name) const {
    const auto is = [&](const Coordinate& c) { return c.name == name + side_; };
    const bool sided = std::ranges::any_of(skeleton_.coordinates, is);
    return asked([&] { return skeleton_.coordinateIndex(sided ? name + side_ : name); });
  }

  const Table& table_;
  std::size_t row_;
  const Skeleton& skeleton_;
  int unit_ = -1;
  std::string side_;
};

double armAt_cm(const Skeleton& skeleton, const Musculature& musculature, int unit, int coordinate,
                const std::map<std::string, double>& posture_deg) {
  const Kinematics clinical = clinicalKinematics(skeleton, postureFromDegrees(skeleton, posture_deg));
  return 100 * momentArms(musculature.units[static_cast<std::size_t>(unit)], clinical)[coordinate];
}

}  // namespace

std::vector<MomentArmReference> loadMomentArmReferences(const std::filesystem::path& file, const Skeleton& skeleton,
                                                        const Musculature& musculature) {
  const Table table{file,
                    {{"muscle"},
                     {"coordinate", "dof"},
                     {"other_posture_deg", "pose_other_dofs"},
                     {"angle_deg"},
                     {"reference_cm"},
                     {"min_cm", "accept_min_cm"},
                     {"max_cm", "accept_max_cm"}}};
  std::vector<MomentArmReference> references;
  for (std::size_t row = 0; row < table.rowCount(); ++row) {
    const RowReader reader{table, row, skeleton, musculature};
    MomentArmReference r;
    r.where = table.where(row);
    r.unit = reader.unit();
    r.coordinate = reader.coordinate();
    r.posture_deg = reader.posture("other_posture_deg");
    r.posture_deg[skeleton.coordinates[r.coordinate].name] = table.number(row, "angle_deg");
    r.reference_cm = table.number(row, "reference_cm");
    r.min_cm = table.number(row, "min_cm");
    r.max_cm = table.number(row, "max_cm");
    if (!(r.min_cm <= r.max_cm)) table.fail(row, "min_cm", "at most " + table.text(row, "max_cm"));
    references.push_back(std::move(r));
  }
  return references;
}

std::vector<MomentArmVerdict> judgeMomentArms(const Skeleton& skeleton, const Musculature& musculature,
                                              const std::vector<MomentArmReference>& references) {
  std::vector<MomentArmVerdict> verdicts;
  for (const auto& r : references) {
    const double arm_cm = armAt_cm(skeleton, musculature, r.unit, r.coordinate, r.posture_deg);
    verdicts.push_back({.arm_cm = arm_cm,
                        .inside = arm_cm >= r.min_cm && arm_cm <= r.max_cm,
                        .wrong_sign = std::abs(r.reference_cm) >= kSignMatters_cm && !(arm_cm * r.reference_cm > 0)});
  }
  return verdicts;
}

std::vector<FunctionReference> loadFunctionReferences(const std::filesystem::path& file, const Skeleton& skeleton,
                                                      const Musculature& musculature) {
  const Table table{file,
                    {{"muscle"},
                     {"coordinate", "dof"},
                     {"sign"},
                     {"strength"},
                     {"min_deg", "test_min_deg"},
                     {"max_deg", "test_max_deg"},
                     {"other_posture_deg", "test_pose"}}};
  std::vector<FunctionReference> references;
  std::set<std::tuple<int, int, double, std::map<std::string, double>>> seen;
  for (std::size_t row = 0; row < table.rowCount(); ++row) {
    const RowReader reader{table, row, skeleton, musculature};
    FunctionReference r;
    r.where = table.where(row);
    r.unit = reader.unit();
    r.coordinate = reader.coordinate();
    const std::string sign = table.text(row, "sign"), strength = table.text(row, "strength");
    if (sign != "+" && sign != "-") table.fail(row, "sign", "+ or -");
    r.sign = sign == "+" ? 1 : -1;
    if (strength != "principal" && strength != "secondary" && strength != "posture_dependent")
      table.fail(row, "strength", "principal, secondary or posture_dependent");
    r.strength = strength == "principal"   ? FunctionStrength::Principal
                 : strength == "secondary" ? FunctionStrength::Secondary
                                           : FunctionStrength::PostureDependent;
    r.min_deg = table.number(row, "min_deg");
    r.max_deg = table.number(row, "max_deg");
    r.posture_deg = reader.posture("other_posture_deg");
    if (seen.emplace(r.unit, r.coordinate, r.sign, r.posture_deg).second) references.push_back(std::move(r));
  }
  return references;
}

std::vector<FunctionVerdict> judgeFunctions(const Skeleton& skeleton, const Musculature& musculature,
                                            const std::vector<FunctionReference>& references) {
  constexpr int kAngles = 41;
  std::vector<FunctionVerdict> verdicts;
  for (const auto& r : references) {
    FunctionVerdict v;
    v.arm_cm = armAt_cm(skeleton, musculature, r.unit, r.coordinate, r.posture_deg);
    v.right = r.sign * v.arm_cm > 0;
    auto posture_deg = r.posture_deg;
    int right = 0;
    for (int i = 0; i < kAngles; ++i) {
      posture_deg[skeleton.coordinates[r.coordinate].name] = r.min_deg + i * (r.max_deg - r.min_deg) / (kAngles - 1);
      right += r.sign * armAt_cm(skeleton, musculature, r.unit, r.coordinate, posture_deg) > 0;
    }
    v.share_of_range = static_cast<double>(right) / kAngles;
    verdicts.push_back(v);
  }
  return verdicts;
}

}  // namespace sinew
