#include "core/date.h"

#include <chrono>
#include <cstdio>
#include <ctime>
#include <tuple>

#include "core/error.h"

namespace sinew {
namespace {

constexpr int kFirstYear = 1850, kLastYear = 2199;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks{" \t\r\n\0", 5};  // DICOM pads with blanks or zeros
  const auto from = text.find_first_not_of(kBlanks);
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(kBlanks) - from + 1);
}

/// Number that the digits `text` form; -1 if there is anything else.
int number(std::string_view text) {
  int value = 0;
  for (const char c : text) {
    if (c < '0' || c > '9') return -1;
    value = 10 * value + (c - '0');
  }
  return value;
}

bool exists(const Date& date) {
  using namespace std::chrono;
  if (date.year < kFirstYear || date.year > kLastYear) return false;
  if (date.month == 0) return date.day == 0;
  if (date.day == 0) return month{static_cast<unsigned>(date.month)}.ok();
  return year_month_day{year{date.year}, month{static_cast<unsigned>(date.month)},
                        day{static_cast<unsigned>(date.day)}}
      .ok();
}

}  // namespace

std::optional<Date> dateFromText(std::string_view text) {
  text = trimmed(text);
  const auto separated = [&](std::size_t at) { return text[at] == '-' || text[at] == '.'; };
  Date date;
  if (text.size() == 8 && number(text) >= 0) {
    date = {number(text.substr(0, 4)), number(text.substr(4, 2)), number(text.substr(6, 2))};
    if (date.month == 0 || date.day == 0) return std::nullopt;
  } else if (text.size() == 10 && separated(4) && text[7] == text[4]) {
    date = {number(text.substr(0, 4)), number(text.substr(5, 2)), number(text.substr(8, 2))};
    if (date.month <= 0 || date.day <= 0) return std::nullopt;
  } else if (text.size() == 7 && text[4] == '-') {
    date = {number(text.substr(0, 4)), number(text.substr(5, 2)), 0};
    if (date.month <= 0) return std::nullopt;
  } else if (text.size() == 4) {
    date = {number(text), 0, 0};
  } else {
    return std::nullopt;
  }
  return exists(date) ? std::optional{date} : std::nullopt;
}

std::string isoText(const Date& date) {
  char text[48];
  if (date.day > 0)
    std::snprintf(text, sizeof text, "%04d-%02d-%02d", date.year, date.month, date.day);
  else if (date.month > 0)
    std::snprintf(text, sizeof text, "%04d-%02d", date.year, date.month);
  else
    std::snprintf(text, sizeof text, "%04d", date.year);
  return text;
}

bool certainlyBefore(const Date& a, const Date& b) {
  const auto last = std::tuple{a.year, a.month > 0 ? a.month : 12, a.day > 0 ? a.day : 31};
  const auto first = std::tuple{b.year, b.month > 0 ? b.month : 1, b.day > 0 ? b.day : 1};
  return last < first;
}

Date dateToday() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  ::localtime_r(&now, &local);
  return {local.tm_year + 1900, local.tm_mon + 1, local.tm_mday};
}

std::string checkedDate(std::string_view text, const std::string& where, const std::string& field) {
  text = trimmed(text);
  if (text.empty()) return {};
  const auto date = dateFromText(text);
  if (!date) throw InputError{{where, field, "a day of the calendar, YYYY-MM-DD", "'" + std::string{text} + "'"}};
  return isoText(*date);
}

}  // namespace sinew
