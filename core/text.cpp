#include "core/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/error.h"

namespace sinew {
namespace {

std::string trimmed(std::string_view s) {
  const auto first = s.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return std::string{s.substr(first, s.find_last_not_of(" \t\r\n") - first + 1)};
}

/// What it takes to make b of a. Writing more is cheap: a name that was cut short ("soleus_r" for "soleus_medial_r")
/// is nearer than one of the same length with other letters.
std::size_t editDistance(std::string_view a, std::string_view b) {
  constexpr std::size_t kChange = 5;
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], kChange * i);
    for (std::size_t j = 1; j <= b.size(); ++j)
      diagonal = std::exchange(
          row[j], std::min({row[j] + kChange, row[j - 1] + 1, diagonal + kChange * (a[i - 1] != b[j - 1])}));
  }
  return row.back();
}

}  // namespace

std::vector<std::string> splitCsvLine(std::string_view line) {
  if (constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF"; line.starts_with(kByteOrderMark))
    line.remove_prefix(kByteOrderMark.size());
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  for (auto& cell : cells) cell = trimmed(cell);
  return cells;
}

std::vector<std::string> nearestNames(std::string_view name, std::span<const std::string> known, std::size_t count) {
  std::vector<std::string> sorted(known.begin(), known.end());
  count = std::min(count, sorted.size());
  std::ranges::stable_sort(sorted, {}, [&](const std::string& k) { return editDistance(name, k); });
  sorted.resize(count);
  return sorted;
}

std::string didYouMean(std::string_view name, std::span<const std::string> known) {
  std::string text;
  for (const auto& candidate : nearestNames(name, known)) text += (text.empty() ? "; nearest: " : ", ") + candidate;
  return text;
}

double parseNumber(std::string_view text, const std::string& where, const std::string& field) {
  const std::string t = trimmed(text);
  double value = 0;
  const auto [end, error] = std::from_chars(t.data(), t.data() + t.size(), value);
  if (error != std::errc{} || end != t.data() + t.size() || !std::isfinite(value))
    throw InputError{{where, field, "a number", "'" + t + "'"}};
  return value;
}

std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool zero = text.find_first_of("123456789") == std::string::npos;
  return zero && text.front() == '-' ? text.substr(1) : text;
}

std::string brief(double value, int digits) {
  return fmt::format("{:.{}g}", value == 0 ? 0.0 : value, digits);
}

}  // namespace sinew
