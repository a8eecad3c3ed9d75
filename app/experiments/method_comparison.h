#pragma once
#include <string>
#include <vector>

#include "app/experiments/characters.h"
#include "app/experiments/kept_functions.h"
#include "core/job.h"

namespace sinew {

class RetargetReference;

// The methods `sinew` and `paper` (gradient descent by finite differences with line search) on the same bodies, in
// one run: energies of every unit and times.

struct NamedShape {
  std::string name;
  ShapeParameters shape;
};

struct MethodTime {
  double cpu_s = 0;  ///< of all threads of the program
  double wall_s = 0;
};

struct BodyComparison {
  std::string name;
  std::vector<double> start, paper, sinew;             ///< total energy by unit
  std::vector<double> paper_reversed, sinew_reversed;  ///< reversalShares()
  double paper_energy_paper = 0,                       ///< E_direction + w_l E_length, all units: reached by `paper`,
      paper_energy_sinew = 0;                          ///< by `sinew`
  MethodTime routing_paper, routing_sinew;
  MethodTime whole_paper, whole_sinew;        ///< all steps
  PeakTorqueTotals peaks_paper, peaks_sinew;  ///< of each method's own routing
};

/// Units whose energies are compared: there is something to improve in the new body (more than 1e-9). Equal: within a
/// millionth of the start.
struct EnergyVerdict {
  int compared = 0, lower = 0, equal = 0, higher = 0, higher_by_one_percent = 0;
  int equal_at_start = 0;  ///< of the equal: neither found anything lower than the start
  /// Of those higher by one per cent: the other method's muscle reverses more steps of its length-angle curves.
  int higher_for_order = 0;
  double worst_ratio = 0;  ///< largest sinew / paper
  std::string worst_unit;
  double sum_start = 0, sum_paper = 0, sum_sinew = 0;
};

struct MethodComparison {
  Outcome outcome = Outcome::NotRun;
  std::vector<std::string> units;
  std::vector<BodyComparison> bodies;
};
MethodComparison compareMethods(const RetargetReference& reference, const std::vector<NamedShape>& shapes,
                                const Job& job = {});
EnergyVerdict energyVerdict(const MethodComparison& comparison);
EnergyVerdict energyVerdict(const std::vector<std::string>& units, const BodyComparison& body);

/// What becomes of the functions in several bodies.
struct FunctionKeeping {
  Outcome outcome = Outcome::NotRun;
  std::vector<KeptFunctions> naive, retargeted;  ///< by shape
};
FunctionKeeping functionKeeping(const RetargetReference& reference, const std::vector<ShapeParameters>& shapes,
                                const Job& job = {});

}  // namespace sinew
