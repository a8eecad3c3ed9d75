#pragma once
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/job.h"
#include "core/model/model.h"

namespace sinew {

/// A clinical test as data: the posture it is done in, the coordinate that is moved and read, and how it is written
/// down. Coordinates are named without side; the tested side's get its suffix. Angles in degrees: this is a form.
struct ExamTest {
  std::string id;        ///< "popliteal_unilateral", "staheli", "silfverskioeld_knee_extended", ...
  std::string title;     ///< "Unilateral popliteal angle"
  std::string protocol;  ///< what the examiner does
  std::map<std::string, double> posture_deg;                ///< tested side, e.g. {"hip_flexion": 90}
  std::map<std::string, double> contralateral_posture_deg;  ///< other side
  std::string coordinate;                                   ///< swept and read: "knee_flexion"
  double sweep_from_deg = 0, sweep_to_deg = 0;              ///< start at ease, end where nobody goes
  double read_scale = 1, read_offset_deg = 0;               ///< written value = scale * coordinate + offset
  std::string convention;                                   ///< "0 = straight, positive = lack of extension"
  double threshold_Nm = 50;                     ///< passive torque at which the examiner stops, for a body of 75 kg
  double entry_min_deg = 0, entry_max_deg = 0;  ///< outside: refused
  double doubt_min_deg = 0, doubt_max_deg = 0;  ///< outside: warning
  double measurement_sd_deg = 5;
  double norm_mean_deg = std::numeric_limits<double>::quiet_NaN(),
         norm_sd_deg = std::numeric_limits<double>::quiet_NaN();
  std::string norm_source;
  bool norm_verified = false;
  std::vector<std::string> muscle_groups;  ///< length groups that this test may change, by name in the same file
};

/// Units (without side) whose lengths change together, e.g. "hamstrings".
struct LengthGroup {
  std::string name;
  std::string title;
  std::vector<std::string> units;
};

struct ExamProtocol {
  std::vector<ExamTest> tests;
  std::vector<LengthGroup> groups;
  const ExamTest& test(std::string_view id) const;        ///< @throws InputError with the nearest ids
  const LengthGroup& group(std::string_view name) const;  ///< @throws InputError with the nearest names
};
/// Reads clinical/exam_tests.json. @throws InputError.
ExamProtocol loadExamProtocol(const std::filesystem::path& resource_dir);

/// Net passive moment of all muscles about a clinical coordinate [N m], positive = towards larger values.
double passiveMoment_Nm(const Model& model, const Posture& posture, int coordinate);

/// The simulated test: moves the joint from ease until the net passive moment against the movement reaches the
/// threshold, or the joint's stop (athlete envelope).
struct SimulatedTest {
  double angle_deg = std::numeric_limits<double>::quiet_NaN();  ///< as written down, by the test's convention
  double coordinate_deg = std::numeric_limits<double>::quiet_NaN();
  bool stopped_by_joint = false;              ///< the bony or ligament stop came first
  std::vector<std::string> limiting_muscles;  ///< those with the largest share of the moment, largest first, up to 3
};
SimulatedTest simulateTest(const Model& model, const ExamTest& test, char side, double threshold_Nm);

/// Passive moment against the movement over the sweep, for plots: pairs (written angle, moment).
std::vector<std::pair<double, double>> passiveMomentCurve(const Model& model, const ExamTest& test, char side,
                                                          int samples = 61);

}  // namespace sinew
