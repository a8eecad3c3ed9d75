#include "clinical/case/age.h"

#include "core/date.h"

namespace sinew {

std::optional<Age> ageAt(std::string_view birth_date, std::string_view day) {
  const auto born = dateFromText(birth_date), today = dateFromText(day);
  if (!born || !today || !born->isDay() || !today->isDay() || certainlyBefore(*today, *born)) return std::nullopt;
  const int months = 12 * (today->year - born->year) + today->month - born->month - (today->day < born->day ? 1 : 0);
  return Age{months / 12, months % 12};
}

}  // namespace sinew
