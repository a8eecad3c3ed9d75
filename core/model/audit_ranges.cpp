#include <algorithm>
#include <sstream>

#include "core/csv_table.h"
#include "core/model/audit_model.h"
#include "core/model/audit_patterns_internal.h"
#include "core/muscle/load_musculature.h"

namespace sinew {
namespace {

std::vector<std::string> splitNames(const std::string& text) {
  std::vector<std::string> names;
  std::istringstream stream{text};
  for (std::string name; std::getline(stream, name, ';');) names.push_back(name);
  return names;
}

/// Names, quantity and limits of a row of either file.
template <class Row>
Row readRow(const CsvTable& table, std::size_t row, const Musculature& published) {
  Row r;
  r.units = splitNames(table.required(row, "units"));
  for (const auto& pattern : r.units)
    if (std::ranges::none_of(published.units, [&](const auto& u) { return fits(pattern, u.name); }))
      throw InputError{
          {table.where(row), "units", "names of muscles.csv without side, * for any ending", "'" + pattern + "'"}};
  r.quantity = table.required(row, "quantity");
  const auto& known = auditQuantities();
  if (std::ranges::find(known, r.quantity) == known.end())
    throw InputError{
        {table.where(row), "quantity", "a quantity of the audit, e.g. pcsa_cm2", "'" + r.quantity + "'"}};
  r.low = table.number(row, "low");
  r.high = table.number(row, "high");
  if (!(r.low <= r.high)) throw InputError{{table.where(row), "low", "at most high", table.text(row, "low")}};
  return r;
}

}  // namespace

const std::vector<std::string>& auditQuantities() {
  static const std::vector<std::string> names = {
      "source_tension_N_cm2", "specific_tension_N_cm2",  "pcsa_cm2",           "force_of_published",
      "pennation_deg",        "optimal_fiber_length_cm", "fiber_of_published", "tendon_to_fiber_of_published",
      "standing_fiber",       "path_of_reference"};
  return names;
}

bool fits(const std::string& pattern, std::string_view unit) {
  const std::string_view name = withoutSide(unit);
  if (!pattern.ends_with('*')) return name == pattern;
  return name.starts_with(std::string_view{pattern}.substr(0, pattern.size() - 1));
}

bool fits(const std::vector<std::string>& patterns, std::string_view unit) {
  return std::ranges::any_of(patterns, [&](const auto& pattern) { return fits(pattern, unit); });
}

AuditRanges loadAuditRanges(const std::filesystem::path& resource_dir, const Skeleton& reference) {
  AuditRanges result;
  result.published = loadPublishedMusculature(resource_dir, reference);
  const CsvTable ranges{resource_dir / "muscles" / "literature_ranges.csv",
                        "sinew.literature_ranges",
                        1,
                        {"units", "quantity", "low", "high", "verified", "source"}};
  for (std::size_t row = 0; row < ranges.rowCount(); ++row) {
    auto range = readRow<LiteratureRange>(ranges, row, result.published);
    const std::string& verified = ranges.required(row, "verified");
    if (verified != "yes" && verified != "no")
      throw InputError{{ranges.where(row), "verified", "yes or no", verified}};
    range.verified = verified == "yes";
    range.source = ranges.required(row, "source");
    result.ranges.push_back(std::move(range));
  }
  const CsvTable explanations{resource_dir / "muscles" / "audit_explanations.csv",
                              "sinew.audit_explanations",
                              1,
                              {"units", "quantity", "low", "high", "explained"}};
  for (std::size_t row = 0; row < explanations.rowCount(); ++row) {
    auto explanation = readRow<AuditExplanation>(explanations, row, result.published);
    explanation.reason = explanations.required(row, "explained");
    result.explanations.push_back(std::move(explanation));
  }
  return result;
}

}  // namespace sinew
