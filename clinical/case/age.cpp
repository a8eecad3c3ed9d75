#include "clinical/case/age.h"

#include <charconv>
#include <string>

namespace sinew {
namespace {

struct Date {
  int year, month, day;
  auto operator<=>(const Date&) const = default;
};

std::optional<Date> parseDate(std::string_view text) {
  std::string digits;
  for (const char c : text)
    if (c != '-') digits += c;
  if (digits.size() != 8 || (text.size() != 8 && text.size() != 10)) return std::nullopt;
  const auto part = [&](int at, int count) {
    int value = -1;
    const char* first = digits.data() + at;
    const auto end = std::from_chars(first, first + count, value);
    return end.ptr == first + count ? value : -1;
  };
  const Date date{part(0, 4), part(4, 2), part(6, 2)};
  if (date.year < 1 || date.month < 1 || date.month > 12 || date.day < 1 || date.day > 31) return std::nullopt;
  return date;
}

}  // namespace

std::optional<Age> ageAt(std::string_view birth_date, std::string_view day) {
  const auto born = parseDate(birth_date), today = parseDate(day);
  if (!born || !today || *today < *born) return std::nullopt;
  const int months = 12 * (today->year - born->year) + today->month - born->month - (today->day < born->day ? 1 : 0);
  return Age{months / 12, months % 12};
}

}  // namespace sinew
