#include "tests/app/cli/cli_support.h"

#include <sstream>

#include "core/file.h"
#include "core/text.h"

namespace sinew::test {

std::string wristSightings(const std::filesystem::path& beads_csv) {
  std::istringstream in{readFile(beads_csv)};
  std::string text = "name,view,u_px,v_px,sigma_px\n", line;
  while (std::getline(in, line)) {
    const auto cells = splitCsvLine(line);
    if (cells.size() != 8 || cells[0] == "bead") continue;
    text += cells[0] + ",1," + cells[1] + "," + cells[2] + ",0.5\n";
    text += cells[0] + ",2," + cells[3] + "," + cells[4] + ",0.5\n";
  }
  return text;
}

}  // namespace sinew::test
