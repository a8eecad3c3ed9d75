#include "core/muscle/musculature.h"

#include "core/error.h"
#include "core/text.h"

namespace sinew {

int Musculature::unitIndex(std::string_view name) const {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (units[i].name == name) return static_cast<int>(i);
    known.push_back(units[i].name);
  }
  throw InputError{"muscle '" + std::string{name} + "' does not exist" + didYouMean(name, known)};
}

}  // namespace sinew
