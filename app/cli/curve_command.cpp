#include <cstdio>
#include <memory>

#include "app/cli/commands.h"
#include "app/cli/svg_plot.h"
#include "app/cli/svg_to_png.h"
#include "core/file.h"
#include "core/muscle/evaluate.h"
#include "core/text.h"

namespace sinew {
namespace {

constexpr double kMm = 1000, kPngScale = 2;

struct CurveOptions {
  std::string model, muscle, motion;
  std::filesystem::path output;
  int samples = 101;
};

const MusculotendonUnit& unitNamed(const Model& model, const std::string& name) {
  return model.musculature.units[static_cast<std::size_t>(model.musculature.unitIndex(name))];
}

Json listJson(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(numberOrNull(value));
  return list;
}

Json curveJson(const MusculotendonUnit& unit, const JointMotion& motion, const MotionCurve& c) {
  return {{"format", "sinew.curve"},
          {"version", 1},
          {"muscle", unit.name},
          {"motion", motion.name},
          {"coordinate", motion.coordinate},
          {"theta", listJson(c.theta)},
          {"angle_deg", listJson(c.angle_deg)},
          {"length_m", listJson(c.length_m)},
          {"moment_arm_m", listJson(c.moment_arm_m)},
          {"normalized_fiber_length", listJson(c.normalized_fiber_length)},
          {"passive_force_N", listJson(c.passive_force_N)},
          {"active_force_N", listJson(c.active_force_N)},
          {"full_torque_Nm", listJson(c.full_torque_Nm)}};
}

std::string curveCsv(const MotionCurve& c) {
  std::string csv =
      "theta,angle_deg,length_m,moment_arm_m,normalized_fiber_length,passive_force_N,active_force_N,full_torque_Nm\n";
  for (std::size_t i = 0; i < c.theta.size(); ++i) {
    char line[256];
    std::snprintf(line, sizeof line, "%.6g,%.6g,%.9g,%.9g,%.6g,%.6g,%.6g,%.6g\n", c.theta[i], c.angle_deg[i],
                  c.length_m[i], c.moment_arm_m[i], c.normalized_fiber_length[i], c.passive_force_N[i],
                  c.active_force_N[i], c.full_torque_Nm[i]);
    csv += line;
  }
  return csv;
}

std::vector<double> inMm(std::vector<double> values) {
  for (double& value : values) value *= kMm;
  return values;
}

std::string curveSvg(const Model& model, const MusculotendonUnit& unit, const JointMotion& motion,
                     const MotionCurve& c) {
  return plotSvg(unit.name + ", " + motion.title + " (" + model.name + ")", motion.coordinate + " [deg]", c.angle_deg,
                 {{"length [mm]", {{"length", inMm(c.length_m)}}},
                  {"moment arm [mm]", {{"moment arm", inMm(c.moment_arm_m)}}},
                  {"force [N]", {{"passive", c.passive_force_N}, {"active, full", c.active_force_N}}}});
}

/// The curve in the form that the file name asks for.
std::string contentFor(const std::filesystem::path& file, const Model& model, const MusculotendonUnit& unit,
                       const JointMotion& motion, const MotionCurve& curve) {
  const std::string extension = file.extension().string();
  if (extension == ".csv") return curveCsv(curve);
  if (extension == ".json") return jsonText(curveJson(unit, motion, curve));
  if (extension == ".svg") return curveSvg(model, unit, motion, curve);
  if (extension == ".png") return pngFromSvg(curveSvg(model, unit, motion, curve), kPngScale);
  throw InputError{
      {"sinew curve", "--output", "a name that ends in .csv, .json, .svg or .png", "'" + extension + "'"}};
}

ExitStatus makeCurve(const CurveOptions& o, Session& session) {
  if (o.samples < 2 || o.samples > 100000)
    throw InputError{{"sinew curve", "--samples", "2 ... 100000", std::to_string(o.samples)}};
  const Model model = session.model(o.model);
  const MusculotendonUnit& unit = unitNamed(model, o.muscle);
  const auto motions = loadJointMotions(session.resourceDir(), model.skeleton);
  const JointMotion& motion = findMotion(motions, o.motion, unit.name.ends_with("_l") ? 'l' : 'r');
  const MotionCurve curve = motionCurve(model.skeleton, unit, motion, o.samples);
  std::string text = curveCsv(curve);
  if (!o.output.empty()) {
    writeFileAtomically(o.output, contentFor(o.output, model, unit, motion, curve));
    text = "written " + o.output.string() + "\n";
  }
  session.result(curveJson(unit, motion, curve), text);
  return ExitStatus::Done;
}

}  // namespace

void addCurveCommand(Commands& commands) {
  auto o = std::make_shared<CurveOptions>();
  auto& command =
      addCommand(commands.app, "curve", "length, moment arm and force of a muscle over a joint motion",
                 "sinew curve reference --muscle soleus_medial_r --motion ankle_dorsiflexion -o curve.svg");
  command.add_option("MODEL", o->model, "model file, or reference, reference:athlete")->required();
  command.add_option("--muscle", o->muscle, "musculotendon unit")->required();
  command.add_option("--motion", o->motion, "joint motion; without a side that of the muscle")->required();
  command.add_option("-o,--output", o->output, "file: .csv, .json, .svg or .png");
  command.add_option("--samples", o->samples, "number of angles")->capture_default_str();
  command.callback(
      [&commands, o] { commands.chosen = [&session = commands.session, o] { return makeCurve(*o, session); }; });
}

}  // namespace sinew
