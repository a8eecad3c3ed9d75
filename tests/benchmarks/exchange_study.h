#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/skeleton/fit/side_exchange.h"

namespace sinew {

/// How often one kind of exchange is recognised.
struct ExchangeRow {
  std::string body, kind;
  int bodies = 0;      ///< drawn
  int apart = 0;       ///< of these, those whose exchanged picks lie apart: right and left nearer than 12 mm in every
                       ///< exchanged view are one place for a reader with an error of 2.2 mm
  int recognised = 0;  ///< of those that are apart: exactly what was exchanged is named
  int partly = 0;      ///< of those: something else is named
  int together = 0;    ///< named although not apart
  double seconds = 0;  ///< processor time of one search
};

/// Bodies drawn from the population, posed and picked with 1 mm noise and a definition error of 2 mm SD in every axis
/// that both views share; every kind of exchange: none (then "recognised" counts what was rightly not named), one
/// landmark, one bone, a view, both views. Unless `simultaneous`, the patient turned by 2 deg and swayed by 5 mm (SD)
/// between the exposures. `deformed`: one leg 40
/// mm shorter and its hip subluxated by 15 mm.
std::vector<ExchangeRow> studyExchange(const std::filesystem::path& resource_dir, const std::vector<View>& views,
                                       bool simultaneous, bool deformed, int bodies,
                                       const std::vector<std::string>& kinds = {});

}  // namespace sinew
