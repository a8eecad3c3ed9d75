#pragma once
#include "core/date.h"
#include "core/strict_json.h"

namespace sinew {

/// A date as ISO text, or nothing. @throws InputError with the field path if it is no day, month or year.
inline std::string dateFromJson(const JsonReader& json) {
  const std::string text = json.text();
  if (text.empty()) return {};
  const auto date = dateFromText(text);
  if (!date) json.fail("a date YYYY-MM-DD of the calendar", "'" + text + "'");
  return isoText(*date);
}

}  // namespace sinew
