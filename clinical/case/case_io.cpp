#include "clinical/case/case_io.h"

#include <algorithm>
#include <string_view>

#include "clinical/case/case_results_json.h"
#include "clinical/case/patient_edit.h"
#include "clinical/exam/physical_exam_json.h"
#include "core/date_json.h"
#include "core/file.h"
#include "core/strict_json.h"
#include "imaging/rig/biplanar_rig_json.h"

namespace sinew {
namespace {

constexpr std::uintmax_t kMaxBytes = std::uintmax_t{64} << 20;
constexpr std::string_view kFileName = "case.json";

// Optional parts: null if absent.

template <class T, class Write>
Json optionalToJson(const std::optional<T>& value, Write write) {
  return value ? write(*value) : Json(nullptr);
}

template <class T, class Read>
std::optional<T> optionalFromJson(const JsonReader& json, std::string_view member, Read read) {
  const auto found = json.find(member);
  if (!found) return std::nullopt;
  return read(*found);
}

template <class T, class Write>
Json listToJson(const std::vector<T>& items, Write write) {
  Json list = Json::array();
  for (const auto& item : items) list.push_back(write(item));
  return list;
}

Json referenceToJson(const FileReference& file) {
  return {{"path", file.path}, {"sha256", file.sha256}};
}

FileReference referenceFromJson(const JsonReader& json) {
  json.allowOnly({"path", "sha256"});
  const FileReference file{json["path"].text(), json["sha256"].text()};
  if (!staysInFolder(file.path)) json["path"].fail("a path inside the case folder");
  const bool hexadecimal = file.sha256.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (file.sha256.size() != 64 || !hexadecimal) json["sha256"].fail("64 hexadecimal digits");
  return file;
}

Json patientToJson(const Patient& p) {
  return {{"id", p.id},
          {"name", p.name},
          {"sex", p.sex},
          {"birth_date", p.birth_date},
          {"diagnosis", p.diagnosis},
          {"height_m", numberOrNull(p.height_m)},
          {"mass_kg", numberOrNull(p.mass_kg)}};
}

Patient patientFromJson(const JsonReader& json) {
  json.allowOnly({"id", "name", "sex", "birth_date", "diagnosis", "height_m", "mass_kg"});
  return {.id = json["id"].text(),
          .name = json["name"].text(),
          .sex = json["sex"].oneOf({"F", "M", "O", ""}),
          .birth_date = dateFromJson(json["birth_date"]),
          .diagnosis = json["diagnosis"].text(),
          .height_m = optionalFromJson<double>(json, "height_m",
                                               [](auto j) { return j.numberIn(kMinHeight_m, kMaxHeight_m); }),
          .mass_kg =
              optionalFromJson<double>(json, "mass_kg", [](auto j) { return j.numberIn(kMinMass_kg, kMaxMass_kg); })};
}

Json imageToJson(const CaseImage& image) {
  Json json = referenceToJson(image.file);
  json["declared_spacing_mm"] = numberOrNull(image.declared_spacing_mm);
  return json;
}

CaseImage imageFromJson(const JsonReader& json) {
  json.allowOnly({"path", "sha256", "declared_spacing_mm"});
  const Json file{{"path", json["path"].text()}, {"sha256", json["sha256"].text()}};
  return {referenceFromJson({file, json.where(), json.path()}),
          optionalFromJson<double>(json, "declared_spacing_mm", [](auto j) { return j.positive(); })};
}

Json phantomToJson(const PhantomImages& phantom) {
  return {{"images", listToJson(phantom.images, referenceToJson)}, {"beads", referenceToJson(phantom.beads)}};
}

PhantomImages phantomFromJson(const JsonReader& json) {
  json.allowOnly({"images", "beads"});
  PhantomImages phantom{{}, referenceFromJson(json["beads"])};
  for (const auto& image : json["images"].items()) phantom.images.push_back(referenceFromJson(image));
  if (phantom.images.size() < 2) json["images"].fail("two images or more");
  return phantom;
}

Json sightingToJson(const Sighting& s) {
  return {
      {"name", s.name}, {"view", s.view + 1}, {"u_px", s.uv_px.x()}, {"v_px", s.uv_px.y()}, {"sigma_px", s.sigma_px}};
}

Sighting sightingFromJson(const JsonReader& json) {
  json.allowOnly({"name", "view", "u_px", "v_px", "sigma_px"});
  return {json["name"].text(),
          json["view"].integer(1, kMaxViews) - 1,
          {json["u_px"].number(), json["v_px"].number()},
          json["sigma_px"].positive()};
}

Json resultsToJson(const Case& c) {
  return {{"rig", optionalToJson(c.rig, rigToJson)},
          {"landmarks", optionalToJson(c.landmarks, triangulationToJson)},
          {"exchanged_sides", exchangesToJson(c.exchanged_sides)},
          {"skeleton", optionalToJson(c.skeleton, skeletonFitToJson)},
          {"musculature", optionalToJson(c.musculature, referenceToJson)},
          {"model", optionalToJson(c.model, referenceToJson)},
          {"exam_fit", optionalToJson(c.exam_fit, examFitToJson)},
          {"report", optionalToJson(c.report, referenceToJson)}};
}

void readResults(const JsonReader& json, Case& c) {
  json.allowOnly({"rig", "landmarks", "exchanged_sides", "skeleton", "musculature", "model", "exam_fit", "report"});
  c.rig = optionalFromJson<BiplanarRig>(json, "rig", rigFromJson);
  c.landmarks = optionalFromJson<Triangulation>(json, "landmarks", triangulationFromJson);
  if (const auto exchanges = json.find("exchanged_sides")) c.exchanged_sides = exchangesFromJson(*exchanges);
  c.skeleton = optionalFromJson<SkeletonFit>(json, "skeleton", skeletonFitFromJson);
  c.musculature = optionalFromJson<FileReference>(json, "musculature", referenceFromJson);
  c.model = optionalFromJson<FileReference>(json, "model", referenceFromJson);
  c.exam_fit = optionalFromJson<ExamFit>(json, "exam_fit", examFitFromJson);
  c.report = optionalFromJson<FileReference>(json, "report", referenceFromJson);
}

Case fromJson(const JsonReader& json) {
  json.expectFormat("sinew.case", 1);
  json.allowOnly({"format", "version", "patient", "images", "phantom", "imported_rig", "sightings", "exam", "truth",
                  "results", "stages"});
  Case c;
  c.patient = patientFromJson(json["patient"]);
  for (const auto& image : json["images"].items()) c.images.push_back(imageFromJson(image));
  if (c.images.size() > 2) json["images"].fail("at most 2 images");
  c.phantom = optionalFromJson<PhantomImages>(json, "phantom", phantomFromJson);
  c.imported_rig = optionalFromJson<BiplanarRig>(json, "imported_rig", rigFromJson);
  for (const auto& sighting : json["sightings"].items()) c.sightings.push_back(sightingFromJson(sighting));
  c.exam = examFromJson(json["exam"]);
  c.truth = optionalFromJson<Truth>(json, "truth", truthFromJson);
  readResults(json["results"], c);
  for (const auto& [name, record] : json["stages"].members()) {
    const auto known = std::ranges::find(kStages, name, [](Stage s) { return nameOf(s); });
    if (known == kStages.end()) record.fail("the name of a stage", "'" + name + "'");
    c.stages[*known] = stageRecordFromJson(record);
  }
  return c;
}

}  // namespace

bool operator==(const Case& a, const Case& b) {
  return caseToJson(a) == caseToJson(b);
}

std::string caseToJson(const Case& c) {
  Json stages = Json::object();
  for (const auto& [stage, record] : c.stages) stages[nameOf(stage)] = stageRecordToJson(record);
  const Json json{{"format", "sinew.case"},
                  {"version", 1},
                  {"patient", patientToJson(c.patient)},
                  {"images", listToJson(c.images, imageToJson)},
                  {"phantom", optionalToJson(c.phantom, phantomToJson)},
                  {"imported_rig", optionalToJson(c.imported_rig, rigToJson)},
                  {"sightings", listToJson(c.sightings, sightingToJson)},
                  {"exam", examToJson(c.exam)},
                  {"truth", optionalToJson(c.truth, truthToJson)},
                  {"results", resultsToJson(c)},
                  {"stages", stages}};
  return jsonText(json);
}

Case caseFromJson(const std::string& text, const std::string& where) {
  const Json json = parseJson(text, where);
  return fromJson({json, where});
}

std::filesystem::path caseFile(const std::filesystem::path& folder) {
  const auto file = folder / kFileName;
  std::error_code error;
  if (!std::filesystem::is_symlink(file, error)) return file;
  const auto target = std::filesystem::canonical(file, error);
  return error ? file : target;
}

Case loadCase(const std::filesystem::path& folder) {
  const auto file = folder / kFileName;
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    throw InputError{{folder.string(), "", "a case folder", error ? error.message() : "no case.json in it"}};
  return caseFromJson(readFile(file, kMaxBytes), file.string());
}

void saveCase(const Case& c, const std::filesystem::path& folder) {
  const auto file = caseFile(folder);
  const std::string text = caseToJson(c);
  caseFromJson(text, file.string());  // what could not be read back is never written over what can
  writeFileAtomically(file, text);
}

}  // namespace sinew
