#pragma once
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/model/model.h"
#include "core/rom/tests/clinical_tests.h"

namespace sinew {

// The one simulation of a clinical test: the movement goes on until the passive moment against it - all units that it
// stretches, and the capsules and ligaments of the joints that it moves - reaches the examiner's threshold, or a unit
// is at its longest length, or every moving coordinate is at its bony stop. Of several coordinates the moment is the
// work per degree of the movement. s is the place along the movement in degrees of it, from ClinicalTest::from_deg
// on.

/// How the lengths of a unit differ from the model's.
struct LengthFactor {
  double fiber = 1, tendon = 1;
};
using LengthFactors = std::map<int, LengthFactor>;  ///< by unit index; absent = 1

/// A test simulated on one side of one body.
struct SimulatedTest {
  std::string test;
  double angle_deg = std::numeric_limits<double>::quiet_NaN();      ///< in the signs of the coordinates
  double written_deg = std::numeric_limits<double>::quiet_NaN();    ///< as the form writes it
  double moment_Nm = std::numeric_limits<double>::quiet_NaN();      ///< against the movement, where it ended
  double structures_Nm = std::numeric_limits<double>::quiet_NaN();  ///< share of capsules and ligaments
  bool stopped_by_joint = false;              ///< every moving coordinate at its bony stop before the threshold
  std::vector<std::string> limiting_muscles;  ///< units with the largest shares of the moment, largest first, up to 3
  /// What holds, in words, largest share first: units, "capsule and ligaments", "... (at its longest)", "stop of
  /// ...".
  std::vector<std::string> limited_by;
};

/// One test on one side of one body, prepared: path lengths of every unit that the movement stretches are tabulated
/// once with their slopes, so that the same test can be asked again for other lengths of the muscles.
class ClinicalSweep {
 public:
  /// @param beyond_deg how far the table goes before the start and behind the end of the movement: contractures, and
  ///   slope for a solver.
  /// @throws InputError for coordinates that the skeleton does not have.
  ClinicalSweep(const Model& model, const ClinicalTest& test, char side, double beyond_deg = 60);
  ClinicalSweep(ClinicalSweep&&) noexcept;
  ~ClinicalSweep();

  double direction() const;  ///< +1 or -1: sign of s along the movement
  double from_deg() const;
  double end_deg() const;  ///< the bony stop in the direction of the movement, or the test's own end
  double angle_deg(double s_deg) const;
  double placeOf_deg(double angle_deg) const;  ///< s of an angle, within the table
  bool stretches(int unit) const;

  /// Moment against the movement of muscles, capsules and ligaments.
  double resistance_Nm(double s_deg, const LengthFactors& factors = {}) const;
  /// Share of capsules and ligaments.
  double structures_Nm(double s_deg) const;
  /// Of every unit of `units` (the model's, perhaps with other lengths), largest first; slack ones are left out.
  std::vector<std::pair<double, int>> moments_Nm(double s_deg, const std::vector<MusculotendonUnit>& units) const;
  double length_m(int unit, double s_deg) const;  ///< @pre stretches(unit)

  /// Place where the movement is first held, the bony stop left aside: muscles and ligaments go on beyond it, which
  /// gives a solver its slope. The end of the table if nothing holds; before the start if that is beyond it already.
  double freeEnd_deg(double threshold_Nm, const LengthFactors& factors = {}) const;
  /// The same, looked for near a place where it was a moment ago.
  double freeEndNear_deg(double near_deg, double threshold_Nm, const LengthFactors& factors) const;
  /// How far beyond being held: 0 where freeEnd_deg() is, rising along the movement, 1 = twice the threshold.
  double excess(double s_deg, double threshold_Nm, const LengthFactors& factors = {}) const;

  SimulatedTest simulate(double threshold_Nm, const LengthFactors& factors = {}) const;

 private:
  struct Table;
  std::unique_ptr<const Table> table_;
};

/// One test on one side. @param threshold_Nm as scaledThreshold_Nm() gives it for this body.
SimulatedTest simulateTest(const Model& model, const ClinicalTest& test, char side, double threshold_Nm);

/// Moment against the movement from its start to its end, for plots: pairs (angle as written, moment).
std::vector<std::pair<double, double>> passiveMomentCurve(const Model& model, const ClinicalTest& test, char side,
                                                          int samples = 61);

}  // namespace sinew
