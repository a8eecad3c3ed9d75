#include <cmath>
#include <cstdio>

#include "clinical/report/report_tables.h"
#include "core/date.h"

namespace sinew {

std::string numberText(double value, int decimals) {
  if (!std::isfinite(value)) return kNotMeasured;
  const double unit = std::pow(10.0, -decimals);
  const double rounded = std::round(value / unit) * unit;
  char text[40];
  std::snprintf(text, sizeof text, "%.*f", decimals, rounded == 0 ? 0.0 : rounded);  // no "-0"
  return text;
}

std::string signedText(double value, int decimals) {
  const std::string text = numberText(value, decimals);
  const bool positive = std::isfinite(value) && text[0] != '-' && text.find_first_not_of("0.") != std::string::npos;
  return positive ? "+" + text : text;
}

std::string sideText(char side) {
  return side == 'l' ? "Left" : "Right";
}

std::string dateText(const std::string& date) {
  const auto known = dateFromText(date);
  return known ? isoText(*known) : date.empty() ? "" : "no day of the calendar";
}

std::string personText(const std::string& dicom_name) {
  std::string text;
  std::size_t from = 0;
  for (int group = 0; group < 3 && from <= dicom_name.size(); ++group) {  // alphabetic = ideographic = phonetic
    const std::size_t end = std::min(dicom_name.find('=', from), dicom_name.size());
    std::string part;
    for (const char c : dicom_name.substr(from, end - from))
      if (c != '^')
        part += c;
      else if (!part.empty() && part.back() != ' ')
        part += ' ';
    while (!part.empty() && part.back() == ' ') part.pop_back();
    if (!part.empty()) text += (text.empty() ? "" : " / ") + part;
    from = end + 1;
  }
  return text;
}

}  // namespace sinew
