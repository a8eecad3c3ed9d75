#include "clinical/pipeline/stage_words.h"

#include <array>
#include <cstdio>

namespace sinew {

void addWarnings(Warnings& warnings, const Warnings& more, const std::string& source) {
  for (const auto& w : more) warnings.push_back({w.code, source.empty() ? w.message : source + ": " + w.message});
}

std::string rounded(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string counted(std::size_t n, const char* one, const char* many) {
  return std::to_string(n) + ' ' + (n == 1 ? one : many);
}

std::string calibrationMethodTitle(const std::string& method) {
  constexpr std::array<std::array<const char*, 2>, 6> kTitles = {{{"bead_phantom", "Bead phantom"},
                                                                  {"dicom_slot_scan", "Slot scanner tags"},
                                                                  {"dicom_nominal", "Nominal image tags"},
                                                                  {"autoscoper", "Autoscoper file"},
                                                                  {"mayacam", "MayaCam file"},
                                                                  {"json", "Geometry file"}}};
  for (const auto& [name, title] : kTitles)
    if (method == name) return title;
  return method;
}

}  // namespace sinew
