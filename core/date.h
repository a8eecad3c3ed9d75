#pragma once
#include <compare>
#include <optional>
#include <string>
#include <string_view>

namespace sinew {

/// A day of the Gregorian calendar; or a month (day 0) or a year (month 0 too), where no more is known.
/// dateFromText() gives only those that exist.
struct Date {
  int year = 0, month = 0, day = 0;
  bool isDay() const { return day > 0; }
  friend bool operator==(const Date&, const Date&) = default;
};

/// Reads "2009", "2009-05", "2009-05-31", DICOM's "20090531" and ACR-NEMA's "2009.05.31", blanks around them left
/// out.
/// @returns nullopt for everything else: 31 February, "00000000", a year before 1850 or after 2199 (nobody in a case
/// was born then), other words.
std::optional<Date> dateFromText(std::string_view text);

/// "2009-05-31", "2009-05", "2009" (ISO 8601).
std::string isoText(const Date& date);

/// Whether `a` lies before `b` whatever day the unknown parts stand for.
bool certainlyBefore(const Date& a, const Date& b);

/// The day today, by the clock and time zone of the machine.
Date dateToday();

/// A date that a person entered, as ISO text; empty stays empty. @throws InputError naming `where` and `field`.
std::string checkedDate(std::string_view text, const std::string& where, const std::string& field);

}  // namespace sinew
