#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <sstream>

#include "app/cli/support/commands.h"
#include "app/cli/support/text_table.h"
#include "app/mesh/surface_file.h"
#include "core/file.h"
#include "core/model/replace_bones.h"
#include "core/text.h"

namespace sinew {
namespace {

namespace fs = std::filesystem;
constexpr double kMm = 1000;

struct ReplaceOptions {
  std::string model, unit;
  std::vector<std::string> meshes;
  fs::path names, landmarks, output;
};

/// Lines of a small CSV file with exactly this header; blank lines and lines that start with '#' are passed over.
std::vector<std::vector<std::string>> csvLines(const fs::path& file, const std::vector<std::string>& header) {
  std::istringstream in{readFile(file)};
  std::vector<std::vector<std::string>> lines;
  std::string line, expected;
  for (const auto& name : header) expected += (expected.empty() ? "" : ",") + name;
  bool first = true;
  for (int number = 1; std::getline(in, line); ++number) {
    const auto cells = splitCsvLine(line);
    if ((cells.size() == 1 && cells[0].empty()) || (!cells.empty() && cells[0].starts_with("#"))) continue;
    const std::string where = file.filename().string() + ": line " + std::to_string(number);
    if (first && cells != header) throw InputError{{where, "", "the header " + expected, line}};
    if (cells.size() != header.size()) throw InputError{{where, "", expected, line}};
    if (!first) lines.push_back(cells);
    first = false;
  }
  return lines;
}

/// The surface files: those given, and all in the folders given, in the order of their names.
std::vector<fs::path> surfaceFiles(const std::vector<std::string>& meshes) {
  std::vector<fs::path> files;
  for (const fs::path place : meshes) {
    if (!fs::is_directory(place)) {
      files.push_back(place);
      continue;
    }
    std::vector<fs::path> inside;
    for (const auto& entry : fs::directory_iterator{place})
      if (isSurfaceFile(entry.path())) inside.push_back(entry.path());
    if (inside.empty())
      throw InputError{{"sinew model replace-bones", "--meshes", "a folder with .stl, .ply, .obj or .vtp files",
                        "none in " + place.string()}};
    std::ranges::sort(inside);
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

std::vector<SuppliedBone> readBones(const ReplaceOptions& o, double unit_m) {
  std::map<std::string, std::string> bone_of;  // file name -> bone
  if (!o.names.empty())
    for (const auto& cells : csvLines(o.names, {"file", "bone"})) bone_of[cells[0]] = cells[1];
  std::vector<SuppliedBone> bones;
  for (const auto& file : surfaceFiles(o.meshes)) {
    const auto named = bone_of.find(file.filename().string());
    bones.push_back({named != bone_of.end() ? named->second : file.stem().string(), readSurfaceFile(file, unit_m)});
    bone_of.erase(file.filename().string());
  }
  if (!bone_of.empty())
    throw InputError{
        {o.names.filename().string(), "file", "files among --meshes", "'" + bone_of.begin()->first + "'"}};
  return bones;
}

std::vector<SuppliedLandmark> readLandmarks(const fs::path& file, double unit_m) {
  std::vector<SuppliedLandmark> landmarks;
  if (file.empty()) return landmarks;
  for (const auto& cells : csvLines(file, {"name", "x", "y", "z"})) {
    Eigen::Vector3d p;
    for (int i = 0; i < 3; ++i)
      p[i] = unit_m * parseNumber(cells[std::size_t(i) + 1], file.filename().string(), cells[0]);
    landmarks.push_back({cells[0], p});
  }
  return landmarks;
}

Json replacementJson(const BoneReplacement& r, const fs::path& output) {
  Json fits = Json::array(), joints = Json::array(), attachments = Json::array();
  for (const auto& f : r.fits)
    fits.push_back({{"segment", f.segment}, {"landmarks", f.landmarks}, {"rms_mm", kMm * f.rms_m}});
  for (const auto& j : r.joints) joints.push_back({{"joint", j.joint}, {"moved_mm", kMm * j.moved_m}});
  for (const auto& a : r.attachments)
    attachments.push_back({{"muscle", a.unit}, {"point", a.point}, {"bone", a.bone}, {"moved_mm", kMm * a.moved_m}});
  return {{"format", "sinew.bone_replacement"},
          {"version", 1},
          {"model", output.string()},
          {"segments", fits},
          {"joints", joints},
          {"attachments", attachments},
          {"warnings", warningsToJson(r.warnings)}};
}

std::string replacementText(const BoneReplacement& r, const fs::path& output) {
  std::vector<std::vector<std::string>> segments, joints, steps;
  for (const auto& f : r.fits)
    segments.push_back({f.segment, std::to_string(f.landmarks), f.landmarks ? fixed(kMm * f.rms_m, 2) : "as given"});
  for (const auto& j : r.joints) joints.push_back({j.joint, fixed(kMm * j.moved_m, 2)});
  for (const auto& a : r.attachments)
    steps.push_back({a.unit, std::to_string(a.point), a.bone, fixed(kMm * a.moved_m, 2)});
  std::string text = textTable({"segment", "landmarks", "RMS mm"}, segments);
  if (!joints.empty()) text += "\n" + textTable({"joint", "centre moved mm"}, joints);
  if (!steps.empty()) text += "\n" + textTable({"muscle", "path point", "bone", "moved mm"}, steps);
  return text + "\nwritten " + output.string() + "\n";
}

ExitStatus replaceAll(const ReplaceOptions& o, Session& session) {
  if (o.unit != "mm" && o.unit != "m")
    throw InputError{{"sinew model replace-bones", "--unit", "mm or m", "'" + o.unit + "'"}};
  const double unit_m = o.unit == "mm" ? 1e-3 : 1.0;
  const auto bones = readBones(o, unit_m);
  const auto landmarks = readLandmarks(o.landmarks, unit_m);
  const BoneReplacement result = replaceBones(session.model(o.model), bones, landmarks);
  saveModel(result.model, o.output);
  session.warn(result.warnings);
  session.result(replacementJson(result, o.output), replacementText(result, o.output));
  return ExitStatus::Done;
}

}  // namespace

void addReplaceBonesCommand(CLI::App& parent, Commands& commands) {
  auto o = std::make_shared<ReplaceOptions>();
  auto& command = addCommand(parent, "replace-bones", "bone surfaces of one's own in the place of the model's",
                             "sinew model replace-bones reference --meshes scans/ --unit mm --landmarks picks.csv -o "
                             "mine.json\n"
                             "  scans/femur_r.stl, .ply, .obj or .vtp: closed, named like the bone; picks.csv: "
                             "name,x,y,z in the same coordinates");
  command.add_option("MODEL", o->model, "model file, or the word reference")->required();
  command.add_option("--meshes", o->meshes, "surface files, or folders of them")->required();
  command.add_option("--unit", o->unit, "of meshes and landmarks: mm or m")->required();
  command.add_option("--names", o->names, "CSV file,bone for files not named like their bones");
  command.add_option("--landmarks", o->landmarks, "CSV name,x,y,z; without it surfaces are in the segment frame");
  command.add_option("-o,--output", o->output, "model file to write")->required();
  command.callback(
      [&commands, o] { commands.chosen = [&session = commands.session, o] { return replaceAll(*o, session); }; });
}

}  // namespace sinew
