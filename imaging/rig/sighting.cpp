#include "imaging/rig/sighting.h"

#include <charconv>
#include <cstdio>
#include <sstream>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "imaging/rig/biplanar_rig.h"

namespace sinew {
namespace {

/// 1, 2, 3, ...: which rig it belongs to, and how many views that has, is not known here.
int viewNumber(const std::string& cell, const std::string& where) {
  int number = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  if (error != std::errc{} || end != cell.data() + cell.size() || number < 1 || number > kMaxViews)
    throw InputError{{where, "view", "1, 2, ...", "'" + cell + "'"}};
  return number;
}

}  // namespace

std::vector<Sighting> loadSightings(const std::filesystem::path& file) {
  std::istringstream in{readFile(file, std::uintmax_t{64} << 20)};
  std::vector<Sighting> sightings;
  std::string line;
  bool header_seen = false;
  for (int number = 1; std::getline(in, line); ++number) {
    const auto cells = splitCsvLine(line);
    if (cells.size() == 1 && cells[0].empty()) continue;
    if (cells[0].starts_with("#")) continue;
    const std::string where = file.string() + ": line " + std::to_string(number);
    if (!header_seen) {
      header_seen = true;
      if (cells.size() < 4 || cells[0] != "name" || cells[1] != "view")
        throw InputError{{where, "header", "name,view,u_px,v_px[,sigma_px]", "'" + line + "'"}};
      continue;
    }
    if (cells.size() < 4 || cells.size() > 5)
      throw InputError{{where, "columns", "4 or 5", std::to_string(cells.size())}};
    if (cells[0].empty()) throw InputError{{where, "name", "a landmark name", "nothing"}};
    Sighting s{cells[0],
               viewNumber(cells[1], where) - 1,
               {parseNumber(cells[2], where, "u_px"), parseNumber(cells[3], where, "v_px")},
               1.0};
    if (cells.size() == 5 && !cells[4].empty()) s.sigma_px = parseNumber(cells[4], where, "sigma_px");
    if (!(s.sigma_px > 0)) throw InputError{{where, "sigma_px", "a number > 0", "'" + cells[4] + "'"}};
    for (const auto& other : sightings)
      if (other.name == s.name && other.view == s.view)
        throw InputError{{where, "name", "each landmark once a view", "'" + s.name + "' twice in view " + cells[1]}};
    sightings.push_back(s);
  }
  if (!header_seen) throw InputError{{file.string(), "", "name,view,u_px,v_px[,sigma_px]", "an empty file"}};
  return sightings;
}

void saveSightings(const std::vector<Sighting>& sightings, const std::filesystem::path& file) {
  std::string text = "name,view,u_px,v_px,sigma_px\n";
  for (const auto& s : sightings) {
    char numbers[160];
    std::snprintf(numbers, sizeof numbers, ",%d,%.6f,%.6f,%.6g\n", s.view + 1, s.uv_px.x(), s.uv_px.y(), s.sigma_px);
    text += s.name + numbers;
  }
  writeFileAtomically(file, text);
}

}  // namespace sinew
