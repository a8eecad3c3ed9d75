#include "core/rom/tests/exam_test.h"

#include <algorithm>
#include <numbers>

#include "core/file.h"
#include "core/muscle/hill.h"
#include "core/muscle/muscle_path.h"
#include "core/rom/tests/exam_sweep.h"
#include "core/skeleton/clinical_angles.h"
#include "core/strict_json.h"
#include "core/text.h"

namespace sinew {
namespace {

std::map<std::string, double> degreesFrom(const JsonReader& json) {
  std::map<std::string, double> values;
  for (const auto& [name, value] : json.members()) values[name] = value.number();
  return values;
}

ExamTest testFrom(const JsonReader& json) {
  ExamTest t;
  t.id = json["id"].text();
  t.title = json["title"].text();
  t.protocol = json["protocol"].text();
  t.posture_deg = degreesFrom(json["posture_deg"]);
  t.contralateral_posture_deg = degreesFrom(json["contralateral_posture_deg"]);
  t.coordinate = json["coordinate"].text();
  t.sweep_from_deg = json["sweep_from_deg"].number();
  t.sweep_to_deg = json["sweep_to_deg"].number();
  t.read_scale = json["read_scale"].number();
  t.read_offset_deg = json["read_offset_deg"].number();
  t.convention = json["convention"].text();
  t.threshold_Nm = json["threshold_Nm"].positive();
  t.entry_min_deg = json["entry_min_deg"].number();
  t.entry_max_deg = json["entry_max_deg"].number();
  t.doubt_min_deg = json["doubt_min_deg"].number();
  t.doubt_max_deg = json["doubt_max_deg"].number();
  t.measurement_sd_deg = json["measurement_sd_deg"].positive();
  t.norm_mean_deg = json["norm_mean_deg"].numberOrNaN();
  t.norm_sd_deg = json["norm_sd_deg"].numberOrNaN();
  t.norm_source = json["norm_source"].text();
  t.norm_verified = json["norm_verified"].boolean();
  for (const auto& group : json["muscle_groups"].items()) t.muscle_groups.push_back(group.text());
  return t;
}

}  // namespace

const ExamTest& ExamProtocol::test(std::string_view id) const {
  std::vector<std::string> known;
  for (const auto& t : tests) {
    if (t.id == id) return t;
    known.push_back(t.id);
  }
  throw InputError{{"exam", "test", "a known test", "'" + std::string{id} + "'" + didYouMean(id, known)}};
}

const LengthGroup& ExamProtocol::group(std::string_view name) const {
  std::vector<std::string> known;
  for (const auto& g : groups) {
    if (g.name == name) return g;
    known.push_back(g.name);
  }
  throw InputError{
      {"exam", "group", "a known muscle group", "'" + std::string{name} + "'" + didYouMean(name, known)}};
}

ExamProtocol loadExamProtocol(const std::filesystem::path& resource_dir) {
  const auto file = resource_dir / "clinical" / "exam_tests.json";
  const Json document = parseJson(readFile(file), file.string());
  const JsonReader root{document, file.string()};
  root.expectFormat("sinew.exam_protocol", 1);
  ExamProtocol protocol;
  for (const auto& g : root["groups"].items()) {
    LengthGroup group{g["name"].text(), g["title"].text(), {}};
    for (const auto& unit : g["units"].items()) group.units.push_back(unit.text());
    protocol.groups.push_back(group);
  }
  for (const auto& t : root["tests"].items()) {
    protocol.tests.push_back(testFrom(t));
    for (const auto& group : protocol.tests.back().muscle_groups) protocol.group(group);  // must exist
  }
  return protocol;
}

double passiveMoment_Nm(const Model& model, const Posture& posture, int coordinate) {
  const Kinematics k = clinicalKinematics(model.skeleton, posture);
  double moment_Nm = 0;
  for (const auto& unit : model.musculature.units) {
    const double arm_m = momentArms(unit, k)[coordinate];
    if (arm_m != 0) moment_Nm += arm_m * equilibrium(unit, pathLength(unit, k.X_WB), 0).force_N;
  }
  return moment_Nm;
}

SimulatedTest simulateTest(const Model& model, const ExamTest& test, char side, double threshold_Nm) {
  return ExamSweep{model, test, side}.simulate(threshold_Nm);
}

std::vector<std::pair<double, double>> passiveMomentCurve(const Model& model, const ExamTest& test, char side,
                                                          int samples) {
  const ExamSweep sweep{model, test, side};
  std::vector<std::pair<double, double>> curve;
  for (int i = 0; i < samples; ++i) {
    const double x = std::lerp(sweep.start_rad(), sweep.stop_rad(), double(i) / (samples - 1));
    curve.emplace_back(sweep.written_deg(x), sweep.resistance_Nm(x, {}));
  }
  return curve;
}

}  // namespace sinew
