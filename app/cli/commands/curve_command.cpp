#include <fmt/format.h>

#include <memory>

#include "app/cli/support/commands.h"
#include "app/plot/paint_figure.h"
#include "app/plot/svg_to_png.h"
#include "core/file.h"
#include "core/foreign/foreign_evaluate.h"
#include "core/posture/evaluate.h"
#include "core/text.h"

namespace sinew {
namespace {

constexpr double kMm = 1000, kPngScale = 2;

struct CurveOptions {
  std::string model, muscle, motion;
  std::filesystem::path output;
  int samples = 101;
};

/// A curve and what it is of; from our model or a foreign one.
struct NamedCurve {
  std::string model, muscle;
  JointMotion motion;
  MotionCurve curve;
};

Json listJson(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(numberOrNull(value));
  return list;
}

Json curveJson(const NamedCurve& of) {
  const MotionCurve& c = of.curve;
  return {{"format", "sinew.curve"},
          {"version", 1},
          {"muscle", of.muscle},
          {"motion", of.motion.name},
          {"coordinate", of.motion.coordinate},
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
    csv += fmt::format("{:.6g},{:.6g},{:.9g},{:.9g},{:.6g},{:.6g},{:.6g},{:.6g}\n", c.theta[i], c.angle_deg[i],
                       c.length_m[i], c.moment_arm_m[i], c.normalized_fiber_length[i], c.passive_force_N[i],
                       c.active_force_N[i], c.full_torque_Nm[i]);
  }
  return csv;
}

std::vector<double> inMm(std::vector<double> values) {
  for (double& value : values) value *= kMm;
  return values;
}

std::string curveSvg(const NamedCurve& of) {
  const MotionCurve& c = of.curve;
  const auto& x = c.angle_deg;
  return svgOf({of.muscle + ", " + of.motion.title + " (" + of.model + ")",
                of.motion.coordinate + " [deg]",
                {{"length [mm]", {curveOver(x, inMm(c.length_m), "")}},
                 {"moment arm [mm]", {curveOver(x, inMm(c.moment_arm_m), "")}},
                 {"force [N]",
                  {curveOver(x, c.passive_force_N, "passive"), curveOver(x, c.active_force_N, "active, full", 1)}}}});
}

/// The curve in the form that the file name asks for.
std::string contentFor(const std::filesystem::path& file, const NamedCurve& curve) {
  const std::string extension = file.extension().string();
  if (extension == ".csv") return curveCsv(curve.curve);
  if (extension == ".json") return jsonText(curveJson(curve));
  if (extension == ".svg") return curveSvg(curve);
  if (extension == ".png") return pngFromSvg(curveSvg(curve), kPngScale);
  throw InputError{
      {"sinew curve", "--output", "a name that ends in .csv, .json, .svg or .png", "'" + extension + "'"}};
}

NamedCurve curveOf(const ForeignModel& model, const CurveOptions& o) {
  const int unit = model.musculature.unitIndex(o.muscle);
  const JointMotion motion = foreignMotion(model, o.motion);
  return {model.name, o.muscle, motion, motionCurve(model, unit, motion, o.samples)};
}

NamedCurve curveOf(const Model& model, const CurveOptions& o, const std::filesystem::path& resource_dir) {
  const MusculotendonUnit& unit = model.musculature.unit(o.muscle);
  const auto motions = loadJointMotions(resource_dir, model.skeleton);
  const JointMotion& motion = findMotion(motions, o.motion, unit.name.ends_with("_l") ? 'l' : 'r');
  return {model.name, unit.name, motion, motionCurve(model.skeleton, unit, motion, o.samples)};
}

ExitStatus makeCurve(const CurveOptions& o, Session& session) {
  if (o.samples < 2 || o.samples > 100000)
    throw InputError{{"sinew curve", "--samples", "2 ... 100000", std::to_string(o.samples)}};
  const auto foreign = session.foreignModel(o.model);
  const NamedCurve curve = foreign ? curveOf(*foreign, o) : curveOf(session.model(o.model), o, session.resourceDir());
  std::string text = curveCsv(curve.curve);
  if (!o.output.empty()) {
    writeFileAtomically(o.output, contentFor(o.output, curve));
    text = "written " + o.output.string() + "\n";
  }
  session.result(curveJson(curve), text);
  return ExitStatus::Done;
}

}  // namespace

void addCurveCommand(Commands& commands) {
  auto o = std::make_shared<CurveOptions>();
  auto& command =
      addCommand(commands.app, "curve", "length, moment arm and force of a muscle over a joint motion",
                 "sinew curve reference --muscle soleus_medial_r --motion ankle_dorsiflexion -o curve.svg");
  command.add_option("MODEL", o->model, "model file, or reference, reference:athlete, or an OpenSim file (.osim)")
      ->required();
  command.add_option("--muscle", o->muscle, "musculotendon unit")->required();
  command
      .add_option(
          "--motion", o->motion,
          "joint motion; without a side that of the muscle. Of an OpenSim file: a coordinate over its range, or "
          "COORDINATE=FROM:TO in degrees, the others at their defaults")
      ->required();
  command.add_option("-o,--output", o->output, "file: .csv, .json, .svg or .png");
  command.add_option("--samples", o->samples, "number of angles")->capture_default_str();
  command.callback(
      [&commands, o] { commands.chosen = [&session = commands.session, o] { return makeCurve(*o, session); }; });
}

}  // namespace sinew
