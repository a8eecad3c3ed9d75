#include <algorithm>
#include <memory>
#include <set>

#include "app/cli/support/commands.h"
#include "clinical/case/case_io.h"
#include "clinical/exam/physical_exam.h"
#include "core/file.h"
#include "core/rom/tests/clinical_tests.h"
#include "imaging/radiograph/radiograph.h"

namespace sinew {
namespace {

struct NewOptions {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> images, phantom;
  std::filesystem::path exam, rig, sightings, beads;
  std::optional<double> pixel_size_mm, height_m, mass_kg;
};

/// Extension that says what the file is; never more of its name, which may be a person's.
std::string extensionOf(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const char* known : {".dcm", ".tif", ".tiff", ".png", ".csv"})
    if (extension == known) return extension;
  return ".dcm";
}

/// DICOM's YYYYMMDD as YYYY-MM-DD; nothing for anything else.
std::string isoDate(const std::string& dicom) {
  if (dicom.size() != 8 || dicom.find_first_not_of("0123456789") != std::string::npos) return {};
  return dicom.substr(0, 4) + "-" + dicom.substr(4, 2) + "-" + dicom.substr(6);
}

bool isLateral(const Radiograph& image) {
  return image.tags.view_position == "LL" || image.tags.view_position == "RL" ||
         image.tags.view_position == "LATERAL";
}

/// Puts the frontal radiograph first where the files say which is which.
void orderViews(std::vector<std::filesystem::path>& files, std::vector<Radiograph>& images, Session& session) {
  const auto first = std::ranges::find_if_not(images, isLateral);
  const std::ptrdiff_t at = first - images.begin();
  if (first == images.begin() || first == images.end()) return;
  std::rotate(files.begin(), files.begin() + at, files.begin() + at + 1);
  std::rotate(images.begin(), images.begin() + at, images.begin() + at + 1);
  session.note("note: the files say that image " + std::to_string(at + 1) + " is the frontal one; it becomes view 1");
}

void fillPatient(Patient& patient, const Radiograph& image) {
  patient.id = image.tags.patient_id;
  patient.name = image.tags.patient_name;
  patient.birth_date = isoDate(image.tags.patient_birth_date);
  const std::string& sex = image.tags.patient_sex;
  patient.sex = sex == "F" || sex == "M" || sex == "O" ? sex : "";
}

/// @throws InputError unless there are two radiographs or more, and as many images of a phantom as there are views.
void expectViews(const NewOptions& o) {
  const auto refuse = [](const char* option, const std::string& expected, std::size_t found) {
    throw InputError{{"sinew new", option, expected, std::to_string(found)}};
  };
  if (o.images.size() < 2) refuse("--image", "two files or more, frontal first", o.images.size());
  if (!o.phantom.empty() && o.phantom.size() != o.images.size())
    refuse("--phantom", std::to_string(o.images.size()) + " files, one a view", o.phantom.size());
}

/// @throws InputError if an image is given twice.
void refuseRepeated(const std::vector<std::filesystem::path>& files) {
  std::set<std::string> seen;
  for (const auto& file : files)
    if (!seen.insert(sha256OfFile(file)).second)
      throw InputError{{"sinew new", "--image", "different radiographs", "the same image twice"}};
}

void refuseExisting(const std::filesystem::path& folder) {
  std::error_code error;
  if (std::filesystem::exists(folder / "case.json", error))
    throw InputError{{folder.string(), "", "a folder without a case", "a case.json, which is not overwritten"}};
  if (std::filesystem::exists(folder, error) && !std::filesystem::is_directory(folder, error))
    throw InputError{{folder.string(), "", "a folder", "a file"}};
}

Case makeCase(const NewOptions& o, Session& session) {
  Case c;
  std::vector<std::filesystem::path> files = o.images;
  std::vector<Radiograph> images;
  for (const auto& file : files) {
    images.push_back(
        readRadiograph(file, o.pixel_size_mm));  // unusable images are refused before anything is written
    session.warn(images.back().warnings);
  }
  refuseRepeated(o.images);
  orderViews(files, images, session);
  fillPatient(c.patient, images.at(0));
  c.patient.height_m = o.height_m;
  c.patient.mass_kg = o.mass_kg;
  if (!o.rig.empty()) c.imported_rig = loadRig(o.rig);
  if (!o.sightings.empty()) c.sightings = loadSightings(o.sightings);
  if (!o.exam.empty()) {
    c.exam = loadExam(o.exam);
    session.warn(checkExam(c.exam, loadClinicalTests(session.resourceDir())));
  }
  caseFromJson(caseToJson(c), "sinew new");  // figures out of range are refused before anything is written
  for (std::size_t i = 0; i < files.size(); ++i)
    c.images.push_back({importFile(files[i], o.folder, "images/view" + std::to_string(i + 1) + extensionOf(files[i])),
                        o.pixel_size_mm});
  if (!o.phantom.empty()) {
    const auto import = [&](std::size_t i) {
      return importFile(o.phantom[i], o.folder,
                        "calibration/view" + std::to_string(i + 1) + extensionOf(o.phantom[i]));
    };
    c.phantom = {{}, importFile(o.beads, o.folder, "calibration/beads.csv")};
    for (std::size_t i = 0; i < o.phantom.size(); ++i) c.phantom->images.push_back(import(i));
  }
  return c;
}

ExitStatus makeNew(const NewOptions& o, Session& session) {
  refuseExisting(o.folder);
  expectViews(o);
  if (o.phantom.empty() != o.beads.empty())
    throw InputError{{"sinew new", "--phantom", "phantom images together with --beads", "one without the other"}};
  if (!o.phantom.empty() && !o.rig.empty())
    throw InputError{{"sinew new", "--rig", "a rig file or images of a phantom", "both"}};
  const Case c = makeCase(o, session);
  saveCase(c, o.folder);
  session.result({{"format", "sinew.new"}, {"version", 1}, {"case", o.folder.string()}},
                 "made " + o.folder.string() + "; next: sinew run " + o.folder.string() + "\n");
  return ExitStatus::Done;
}

}  // namespace

void addNewCommand(Commands& commands) {
  auto o = std::make_shared<NewOptions>();
  auto& command =
      addCommand(commands.app, "new", "make a case folder from two or more radiographs",
                 "sinew new mycase --image ap.dcm --image lateral.dcm --sightings picks.csv --exam exam.json");
  command.add_option("CASE", o->folder, "folder to make")->required();
  command.add_option("--image", o->images, "radiograph, once a view: frontal, lateral, others")->required();
  command.add_option("--exam", o->exam, "physical examination (JSON)");
  command.add_option("--rig", o->rig, "view geometry (rig file)");
  command.add_option("--phantom", o->phantom, "image of the bead phantom, once a view in the same order");
  command.add_option("--beads", o->beads, "beads of the phantom (CSV name,x_mm,y_mm,z_mm)");
  command.add_option("--sightings", o->sightings, "landmark picks (CSV name,view,u_px,v_px[,sigma_px])");
  command.add_option("--pixel-size-mm", o->pixel_size_mm, "size of a pixel, for images that do not state it");
  command.add_option("--height-m", o->height_m, "height of the patient");
  command.add_option("--mass-kg", o->mass_kg, "mass of the patient");
  command.callback(
      [&commands, o] { commands.chosen = [&session = commands.session, o] { return makeNew(*o, session); }; });
}

}  // namespace sinew
