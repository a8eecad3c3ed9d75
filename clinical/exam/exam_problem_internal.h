#pragma once
#include <limits>
#include <string>
#include <vector>

#include "clinical/exam/physical_exam.h"
#include "core/rom/tests/clinical_sweep.h"

namespace sinew {

// The parts of applyExam(), one side at a time. Places are degrees of a test's movement (ClinicalSweep).

inline constexpr double kLeastFactor = 0.6, kMostFactor = 1.4;
inline constexpr double kFactorPrior = 0.3;  // SD of the weak pull to 1: moves a measured angle by less than 0.5 deg
/// A factor moves by no more than this a degree where lengths begin to change. Beside a stiff capsule a degree of the
/// measurement would call for 5 % and more, which no measurement of 5 deg SD can.
inline constexpr double kSteepest_per_deg = 0.012;

/// What a factor scales.
enum class Scaled { FiberAndTendon, FiberOnly };

/// A group of units whose common length factor is an unknown.
struct FreeGroup {
  const LengthGroup* group;
  std::vector<int> units;
  double mean_length_m = 0;     ///< fibre + tendon, of the units
  double mean_fiber_share = 1;  ///< fibre / (fibre + tendon)
};

/// A test that was measured on this side and changes lengths, ready to be simulated for any.
struct MeasuredTest {
  const ClinicalTest* test;
  const ClinicalSweep* sweep;
  double threshold_Nm;
  TestNorm norm;            ///< of the patient's age and sex
  double measured_deg;      ///< as written
  double measured_place;    ///< of the measured angle
  std::vector<int> groups;  ///< that it may change, as indices of the free groups, the one that it is a test of first
};

/// What the solver is to meet in the place of the measurement.
struct ExamAim {
  double place = 0;      ///< where the movement shall be held
  double own_place = 0;  ///< where the body is held with unchanged lengths
  double asked = 1;      ///< factor of its groups with which the measurement is met by this test alone
  /// What the place may be off by: the SD of the measurement, less where a place hardly depends on lengths.
  double sd_deg = std::numeric_limits<double>::quiet_NaN();
  bool in_norm = false;  ///< left at 1: inside the norm, or no further from its mean than the SD of the measurement
  bool faded = false;    ///< the measurement calls for more change than kSteepest_per_deg allows
  double faded_to = std::numeric_limits<double>::quiet_NaN();  ///< the factor that is allowed, if faded
  bool unattainable = false;  ///< whatever the length of its muscle, the body is held before
};

LengthFactors lengthFactors(const std::vector<FreeGroup>& groups, const std::vector<double>& factors, Scaled scaled);

ExamAim aimOf(const MeasuredTest& test, const std::vector<FreeGroup>& groups, bool leave_in_norm);

struct SideProblem {
  const std::vector<MeasuredTest>* tests;
  const std::vector<FreeGroup>* groups;
  Scaled scaled = Scaled::FiberAndTendon;
  std::vector<double> places;       ///< to be met, by test
  std::vector<double> sds_deg;      ///< by test, of the places; empty: those of the measurements
  std::vector<double> faded_to;     ///< by test: factor of its first group that is aimed at instead; NaN = none
  std::vector<double> prior_means;  ///< by group
  double threshold_scale = 1;       ///< of every test's moment
};
struct SideSolution {
  Outcome outcome = Outcome::NotRun;
  std::vector<double> factors;  ///< by group; empty unless usable
  double cost = 0;              ///< half the sum of squares
  bool usable() const { return !factors.empty(); }
};
/// @param start by group; where solved factors are expected.
/// @param nearby the solution is close to the start and wanted to some thousandths: a few steps are enough.
SideSolution solveSide(const SideProblem& problem, const std::vector<double>& start, const Job& job,
                       bool nearby = false);

/// Half widths of one factor's 95 % interval about a solution.
struct FactorInterval {
  double lower = 0, upper = 0;
  bool determined = false;
};
/// The measurements as they stand, without norm and fading: intervals by group.
std::vector<FactorInterval> factorIntervals(const SideProblem& problem, const std::vector<double>& start,
                                            double length_sd_m, const Job& job);

/// Why a test's residual is what it is. `after` by test, as placed by the solution.
struct SideResult {
  const std::vector<MeasuredTest>* tests;
  const std::vector<FreeGroup>* groups;
  const std::vector<ExamAim>* aims;
  const std::vector<double>* factors;
  const std::vector<SimulatedTest>* after;
};
std::string residualReason(const SideResult& side, std::size_t test, const ClinicalTests& all);

/// Rules of the protocol that two measured angles of one side break.
std::vector<const TestContradiction*> contradictionsOf(const PhysicalExam& exam, const ClinicalTests& tests,
                                                       char side);

}  // namespace sinew
