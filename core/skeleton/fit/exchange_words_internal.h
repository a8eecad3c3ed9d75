#pragma once
#include <string>
#include <vector>

#include "core/skeleton/fit/side_exchange.h"

namespace sinew {

/// The picks of a landmark of both sides in one view.
struct NamedPair {
  int view = 0;
  std::string landmark, bone;  ///< without side
  int right = -1, left = -1;   ///< indices of the picks; -1 = not picked
};

/// What the fit says of a pair. Either: right and left lie together, or only one was picked.
enum class PairVerdict { AsNamed, Exchanged, Either };

struct ExchangeWords {
  std::vector<SideExchange> exchanges;
  std::string what;
};

/// The largest wholes that are exchanged: all views, a view, a bone, landmarks; in words and as a list. A whole needs
/// two sure pairs and none that is surely as named; its undecided pairs go with it.
/// `swapped`: the naming that fits best, by pair.
ExchangeWords wordsFor(const std::vector<NamedPair>& pairs, const std::vector<PairVerdict>& verdicts,
                       const std::vector<bool>& swapped, int view_count);

}  // namespace sinew
