#include <algorithm>
#include <memory>

#include "app/cli/support/commands.h"
#include "app/cli/support/text_table.h"
#include "core/file.h"
#include "core/foreign/foreign_from_model.h"
#include "core/foreign/length_deviation.h"
#include "core/geometry/mesh_io.h"
#include "core/io/mjcf/mjcf.h"
#include "core/io/osim/osim_reader.h"
#include "core/io/osim/osim_writer.h"
#include "core/muscle/muscle_path.h"

namespace sinew {
namespace {

struct ExportOptions {
  std::string model, format = "mjcf", muscles = "thelen";
  std::filesystem::path output;
  bool meshes = false, all = false;
};

/// Bone surfaces as OBJ in the folder Geometry beside the model, where OpenSim looks for them.
std::vector<OsimOptions::Mesh> writeMeshesBeside(const Model& model, const std::filesystem::path& file) {
  const auto folder = std::filesystem::absolute(file).parent_path() / "Geometry";
  std::filesystem::create_directories(folder);
  std::vector<OsimOptions::Mesh> meshes;
  for (const BoneMesh& bone : *model.bones) {
    writeFileAtomically(folder / (bone.bone + ".obj"), objText(bone.mesh));
    meshes.push_back({bone.segment, bone.bone + ".obj"});
  }
  return meshes;
}

LengthDeviation exportOsim(const Model& model, const ExportOptions& o) {
  const ForeignModel foreign = foreignFromModel(model);
  OsimOptions options;
  options.muscles = o.muscles == "millard" ? OsimOptions::Muscles::Millard : OsimOptions::Muscles::Thelen;
  if (o.meshes) options.meshes = writeMeshesBeside(model, o.output);
  options.remarks = {"Exported by Sinew from the model '" + model.name + "'. Coordinates are clinical angles."};
  // What is reported is what a reader of the file gets.
  const LengthDeviation deviation =
      lengthDeviation(model, osimFromText(osimText(foreign, options), o.output.string()));
  options.remarks.push_back(summaryText(deviation) + ".");
  writeFileAtomically(o.output, osimText(foreign, options));
  return deviation;
}

LengthDeviation exportMjcf(const Model& model, const ExportOptions& o) {
  writeFileAtomically(o.output, mjcfText(model));
  return mjcfDeviation(model);
}

LengthDeviation exportJson(const Model& model, const ExportOptions& o, Session& session) {
  saveModel(model, o.output);
  const Model back = loadModel(o.output, session.reference());
  LengthDeviation deviation = lengthDeviation(model, [&](const Posture& q) {
    const auto X_WB = segmentPoses(back.skeleton, q);
    Eigen::VectorXd length_m(static_cast<Eigen::Index>(back.musculature.units.size()));
    for (Eigen::Index u = 0; u < length_m.size(); ++u)
      length_m[u] = pathLength(back.musculature.units[static_cast<std::size_t>(u)], X_WB);
    return length_m;
  });
  deviation.structures = structureDeviation(model, [&](const Eigen::VectorXd& clinical) {
    Eigen::VectorXd moments_Nm(clinical.size());
    for (Eigen::Index i = 0; i < clinical.size(); ++i)
      moments_Nm[i] = passiveMoment_Nm(back.passive_moments[static_cast<std::size_t>(i)], clinical[i]);
    return moments_Nm;
  });
  return deviation;
}

Json structuresJson(const std::optional<StructureDeviation>& d) {
  if (!d) return nullptr;
  return {{"alone_Nm", d->alone_Nm},
          {"alone_share", d->alone_share},
          {"alone_coordinate", d->alone_coordinate},
          {"random_Nm", d->random_Nm},
          {"random_coordinate", d->random_coordinate}};
}

Json deviationJson(const LengthDeviation& deviation) {
  Json units = Json::array();
  for (const auto& u : deviation.units)
    units.push_back({{"name", u.unit},
                     {"blended", u.blended},
                     {"on_driven_bone", u.on_driven},
                     {"median_norm_m", u.median_norm_m},
                     {"max_norm_m", u.max_norm_m},
                     {"median_random_m", u.median_random_m},
                     {"max_random_m", u.max_random_m}});
  return {{"norm_postures", deviation.norm_postures},
          {"random_postures", deviation.random_postures},
          {"exact_units", deviation.exactUnits()},
          {"median_of_maxima_m", deviation.medianOfMaxima_m()},
          {"boxed_ranges", deviation.boxed_ranges},
          {"structures", structuresJson(deviation.structures)},
          {"units", units}};
}

/// The units that are not exact, the worst first; ten of them unless all are wanted.
std::string deviationText(LengthDeviation deviation, bool all) {
  constexpr std::size_t kShown = 10;
  const auto mm = [](double m) { return fixed(1000 * m, 2); };
  std::string text = summaryText(deviation) + ".\n";
  std::erase_if(deviation.units, &UnitDeviation::isExact);
  if (deviation.units.empty()) return text;
  std::ranges::stable_sort(deviation.units, std::greater{},
                           [](const UnitDeviation& u) { return std::max(u.max_norm_m, u.max_random_m); });
  std::vector<std::vector<std::string>> rows;
  for (const auto& u : deviation.units) {
    if (!all && rows.size() == kShown) break;
    rows.push_back({u.unit, mm(u.median_norm_m), mm(u.max_norm_m), mm(u.median_random_m), mm(u.max_random_m)});
  }
  text += textTable({"deviation [mm]", "norm, median", "norm, most", "random, median", "random, most"}, rows);
  if (rows.size() < deviation.units.size())
    text += "and " + std::to_string(deviation.units.size() - rows.size()) + " more: --all\n";
  return text;
}

ExitStatus exportModel(const ExportOptions& o, Session& session) {
  const auto refuse = [](const char* option) {
    throw InputError{{"sinew export", option, "--format osim with it", "another format"}};
  };
  if (o.meshes && o.format != "osim") refuse("--meshes");
  if (o.muscles != "thelen" && o.format != "osim") refuse("--muscles");
  const Model model = session.model(o.model);
  const LengthDeviation deviation = o.format == "osim"   ? exportOsim(model, o)
                                    : o.format == "mjcf" ? exportMjcf(model, o)
                                                         : exportJson(model, o, session);
  session.result({{"format", "sinew.export"},
                  {"version", 1},
                  {"model", o.model},
                  {"exported_format", o.format},
                  {"file", o.output.string()},
                  {"deviation", deviationJson(deviation)}},
                 "written " + o.output.string() + "\n" + deviationText(deviation, o.all));
  return ExitStatus::Done;
}

}  // namespace

void addExportCommand(Commands& commands) {
  auto o = std::make_shared<ExportOptions>();
  auto& command = addCommand(commands.app, "export",
                             "the model for another program, and how far its muscle lengths then are from ours",
                             "sinew export reference --format osim -o reference.osim");
  command.add_option("MODEL", o->model, "model file, or the word reference")->required();
  command.add_option("--format", o->format, "mjcf: MuJoCo XML; osim: OpenSim 4; json: our own model file")
      ->check(CLI::IsMember({"mjcf", "osim", "json"}))
      ->capture_default_str();
  command.add_option("-o,--output", o->output, "file to write")->required();
  command.add_option("--muscles", o->muscles, "osim: thelen (our curves) or millard (OpenSim's)")
      ->check(CLI::IsMember({"thelen", "millard"}))
      ->capture_default_str();
  command.add_flag("--meshes", o->meshes, "osim: bone surfaces in the folder Geometry beside the file, to be shown");
  command.add_flag("--all", o->all, "list every muscle that is not exact, not only the ten worst");
  command.callback(
      [&commands, o] { commands.chosen = [&session = commands.session, o] { return exportModel(*o, session); }; });
}

}  // namespace sinew
