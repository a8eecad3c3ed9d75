#include "core/foreign/foreign_model.h"

#include <algorithm>

#include "core/text.h"

namespace sinew {

int ForeignModel::coordinateIndex(std::string_view wanted) const {
  const auto found = std::ranges::find(coordinates, wanted, &ForeignCoordinate::name);
  if (found != coordinates.end()) return static_cast<int>(found - coordinates.begin());
  std::vector<std::string> known;
  for (const auto& c : coordinates) known.push_back(c.name);
  throw InputError{{"model " + name, "coordinate", "a coordinate of the model",
                    "'" + std::string{wanted} + "'" + didYouMean(wanted, known)}};
}

const ForeignCoupling* ForeignModel::couplingOf(int coordinate) const {
  const auto found = std::ranges::find(couplings, coordinate, &ForeignCoupling::dependent);
  return found == couplings.end() ? nullptr : &*found;
}

}  // namespace sinew
