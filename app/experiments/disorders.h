#pragma once
#include <string>
#include <vector>

#include "core/job.h"
#include "core/retarget/prepared/routing_reference.h"

namespace sinew {

class RetargetReference;

// Ryu et al., Muscle Routing Evaluation: functional disorders, the reversed steps (core/retarget/reversals.h) of
// every unit's length-angle curves over the motions that it is significant in (RoutingReference).

/// Share of reversed steps among those with a direction, by unit of the reference, over all its motions together.
/// 0 for a unit without any.
std::vector<double> reversalShares(const RetargetReference& reference, const Model& body, int steps);

struct DisorderRow {
  double elongation = 1;                  ///< of all limb bones
  std::vector<double> naive, retargeted;  ///< by unit: reversalShares()
};

struct Disorders {
  Outcome outcome = Outcome::NotRun;
  std::vector<std::string> units;
  std::vector<DisorderRow> rows;
};

struct DisorderOptions {
  int steps = kReversalSteps;
  std::vector<double> elongations = {0.6, 0.8, 0.9, 1.0, 1.1, 1.3, 1.6, 2.0, 2.5};
};
Disorders disorders(const RetargetReference& reference, const DisorderOptions& options = {}, const Job& job = {});

}  // namespace sinew
