#pragma once
#include <vector>

#include "app/cli/support/session.h"
#include "clinical/pipeline/side_check.h"

namespace sinew {

/// Looks for exchanged sides among picks and warns of them; with `swap` they are put right and a note says so.
/// @returns what is exchanged and stays so.
inline std::vector<SideExchange> examineAndSwap(Session& session, const BiplanarRig& rig,
                                                std::vector<Sighting>& sightings, bool swap) {
  const auto finding =
      examineSides(session.reference().skeleton, rig, sightings, session.resourceDir(), session.job());
  if (!swap) {
    session.warn(warningsOf(finding));
    return finding.exchanges;
  }
  session.note(finding.exchanges.empty() ? "note: no exchange of left and right was found; nothing is exchanged"
                                         : "note: left and right exchanged: " + finding.what);
  applyExchange(sightings, finding.exchanges);
  return {};
}

}  // namespace sinew
