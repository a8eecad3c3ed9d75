#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/job.h"
#include "core/model/model.h"

namespace sinew {

// Step 1 of retargeting (Ryu et al., Muscle Routing Optimization): where the path points of a muscle have to lie in a
// new body so that it pulls in the same directions and lengthens in the same way over every joint motion that it
// takes part in. What is compared, and what keeps the points anatomical: docs/methods/retargeting.md.

enum class RetargetMethod {
  Naive,  ///< points move with their bones, lengths scale with the path: what is retargeted from
  Paper,  ///< gradient descent, finite differences, line search: Ryu et al.
  Sinew   ///< non-linear least squares with analytic derivatives, two starts, rounds over curved bones
};
std::string_view nameOf(RetargetMethod method);  ///< "naive", ...
/// @throws InputError with the known names.
RetargetMethod retargetMethodNamed(std::string_view name);

/// Weights of the energy. The first two are the paper's. The third compares whole curves: two curves can agree in
/// their extrema and still differ in moment arms in between, which ranges of motion and torques would show. The
/// others keep the musculature an anatomical one: prices of displacements, in metres of the reference body (a point
/// of a bone twice as large moves twice as far for the same price), and of a function that turns into its opposite.
struct RoutingWeights {
  double length = 10;             ///< w_l
  double range = 50;              ///< w_Delta
  double curve = 20;              ///< of the curve's mean squared deviation, relative to w_Delta
  double via_1_m2 = 100;          ///< a via point that moves by 1 cm costs 0.01 ...
  double attachment_1_m2 = 5000;  ///< ... an attachment that slides on its bone by 1 cm costs 0.5 ...
  double far_m = 0.02;            ///< ... twice as much where it has moved so far: nothing flies out of the body
  double inside_1_m2 = 20000;     ///< ... and 1 cm into the bone that a via point glides on costs 2
  double crowding = 200;          ///< of a piece of the path below a quarter of its length, in its lengths, squared
  double reversal = 3000;         ///< of a step against the reference, in shares of its range, squared
  friend bool operator==(const RoutingWeights&, const RoutingWeights&) = default;
};

/// The energy of one unit, by its parts.
struct RoutingEnergy {
  double direction = 0;     ///< sum of squared cross products of force directions, integrated over theta
  double length = 0;        ///< theta_max, theta_min and Delta; not weighted by w_l yet
  double curve = 0;         ///< mean squared deviation of the length-angle curves; not weighted yet
  double displacement = 0;  ///< price of moving the points
  double reversal = 0;      ///< price of lengthening where the reference shortens, or the other way
  double paper(const RoutingWeights& w) const { return direction + w.length * length; }
  double total(const RoutingWeights& w) const {
    return paper(w) + w.length * w.range * w.curve * curve + displacement + reversal;
  }
};

/// What became of one unit.
struct UnitRouting {
  std::string unit;
  RoutingEnergy start, end;   ///< of naive anchoring, and reached
  int iterations = 0;         ///< 0: nothing had to move
  double largest_move_m = 0;  ///< of a path point, at the zero posture
  Outcome outcome = Outcome::NotRun;
};

class RoutingReference;

struct RoutingOptions {
  RetargetMethod method = RetargetMethod::Sinew;
  RoutingWeights weights;
};

struct Routing {
  Outcome outcome = Outcome::NotRun;
  std::vector<UnitRouting> units;  ///< in the order of the model
};

/// An earlier result with the same reference, method and weights: units that feel nothing of what has changed since
/// take it over, to the last bit what they would come to anew.
struct PreviousRouting {
  const Model& model;
  const std::vector<UnitRouting>& units;
};
/// Units whose path in a body of `shape` is the one they have in `previous`.
std::vector<bool> unchangedUnits(const RoutingReference& prepared, const ShapeParameters& previous,
                                 const ShapeParameters& shape);

/// Moves the path points of `model`: `reference` in a new body, points anchored naively (deformedModel()); fibre and
/// tendon lengths stay. Muscles are independent of each other and solved in parallel; where both sides are equal the
/// right one is solved and mirrored. The same input gives the same result, whatever the number of processors. A
/// cancelled job leaves `model` as it was.
Routing route(const Model& reference, const RoutingReference& prepared, Model& model,
              const RoutingOptions& options = {}, const Job& job = {}, const PreviousRouting* previous = nullptr);

}  // namespace sinew
