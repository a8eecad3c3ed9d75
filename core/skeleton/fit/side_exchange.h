#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/skeleton/fit/fit_skeleton.h"

namespace sinew {

// Left and right exchanged: picks at the right place under the name of the other side. Recognised by trying it: the
// body is fitted to the picks as named and with the names of a view, of all views, of a bone or of a landmark
// exchanged; what fits far better is what happened. Method and limits: docs/methods/side_exchange.md.

/// Landmarks of one view whose sides are exchanged.
struct SideExchange {
  int view = 0;                        ///< index into the views
  std::vector<std::string> landmarks;  ///< without side: "femoral_head_center"
  bool whole = false;                  ///< all of a bone or of a view, not landmarks here and there
  friend bool operator==(const SideExchange&, const SideExchange&) = default;
};

/// "ankle_r" <-> "ankle_l"; names of the midline stay.
std::string withOtherSide(std::string_view name);
/// Whether the exchanges concern a landmark of either side in a view.
bool isExchanged(std::span<const SideExchange> exchanges, std::string_view name, int view);

struct ExchangeOptions {
  /// Forward of the room where the rig says it ("patient aligned"): without it a body of few landmarks can also face
  /// away. Nothing if the frame is the laboratory's.
  std::optional<Eigen::Vector3d> anterior_W;
  double least_evidence = 30;       ///< fall of the cost (chi-squared) that a whole exchange has to bring
  double least_pair_evidence = 18;  ///< the same for one pair of landmarks in one view
};

/// What was found.
struct ExchangeFinding {
  std::vector<SideExchange> exchanges;  ///< empty: none
  std::string what;                     ///< "all landmarks of view 2", "femur in view 1", ...
  double evidence = 0;                  ///< fall of the cost that the exchange brings
};

/// Looks for exchanged sides among picks, with a plain fit: views that are exact and of one instant. What that does
/// not explain (movement, definition of landmarks, a nominal geometry) shows in all residuals and widens the scale in
/// which namings are compared. Costs a fit for each view and two more; some tens if picks disagree. A pair that lies
/// together in a view (right and left closer than about five picking errors) cannot be told apart there, nor need it
/// be; films that are stored mirrored and named as they hang make the mirror image of a patient, which no geometry
/// can tell.
/// @throws InputError as fitSkeleton().
ExchangeFinding findExchangedSides(const Skeleton& reference, std::span<const View> views,
                                   std::span<const LandmarkObservation> observations,
                                   std::span<const ShapePrior> priors, const ExchangeOptions& options = {},
                                   const Job& job = {});

}  // namespace sinew
