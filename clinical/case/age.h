#pragma once
#include <optional>
#include <string_view>

namespace sinew {

/// Completed years and months.
struct Age {
  int years = 0, months = 0;
  double inYears() const { return years + months / 12.0; }
  friend bool operator==(const Age&, const Age&) = default;
};
/// Age on a day; dates as 2014-03-09 or 20140309. nullopt if one of them is empty, malformed or out of order.
std::optional<Age> ageAt(std::string_view birth_date, std::string_view day);

}  // namespace sinew
