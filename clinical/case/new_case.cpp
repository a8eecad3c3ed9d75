#include "clinical/case/new_case.h"

#include <algorithm>
#include <set>

#include "clinical/case/case_io.h"
#include "clinical/case/patient_edit.h"
#include "core/file.h"
#include "imaging/calibration/calibration_object.h"

namespace sinew {
namespace {

namespace fs = std::filesystem;

void refuseTaken(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder / "case.json", error))
    throw InputError{{folder.string(), "", "a folder without a case", "a case.json, which is not overwritten"}};
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw InputError{{folder.string(), "", "a folder", "a file"}};
}

bool isLateral(const Radiograph& image) {
  return image.tags.view_position == "LL" || image.tags.view_position == "RL" ||
         image.tags.view_position == "LATERAL";
}

std::string viewName(const char* subfolder, int view) {
  return std::string{subfolder} + "/view" + std::to_string(view + 1);
}

/// The files of a new case, read before anything is written.
struct Read {
  std::vector<fs::path> files;
  std::vector<Radiograph> images;
  std::ptrdiff_t frontal = 0;  ///< place of the frontal image in what was given
};

/// @throws InputError if an image is given twice.
void refuseRepeated(const std::vector<fs::path>& files) {
  std::set<std::string> seen;
  for (const auto& file : files)
    if (!seen.insert(sha256OfFile(file)).second)
      throw InputError{{"new case", "images", "different radiographs", "the same image twice"}};
}

template <class T>
void moveToFront(std::vector<T>& items, std::ptrdiff_t at) {
  std::rotate(items.begin(), items.begin() + at, items.begin() + at + 1);
}

Read readImages(const NewCase& wanted, Warnings& doubts) {
  if (wanted.images.size() < 2)
    throw InputError{{"new case", "images", "two or more", std::to_string(wanted.images.size())}};
  Read read{wanted.images, {}};
  for (const auto& file : read.files) {
    read.images.push_back(readRadiograph(file, wanted.declared_spacing_mm));
    const Warnings& more = read.images.back().warnings;
    doubts.insert(doubts.end(), more.begin(), more.end());
  }
  refuseRepeated(read.files);
  const auto at = std::ranges::find_if_not(read.images, isLateral) - read.images.begin();
  if (at == 0 || at == std::ssize(read.images)) return read;
  read.frontal = at;
  moveToFront(read.files, at);
  moveToFront(read.images, at);
  doubts.push_back({"views_in_other_order",
                    "the files say that image " + std::to_string(at + 1) + " is the frontal one; it becomes view 1"});
  return read;
}

/// Where the frontal image contradicts what a person stated, the person is right, and is told.
void doubtTags(const Patient& stated, const RadiographTags& tags, Warnings& doubts) {
  Patient said;
  fillFromTags(said, tags);
  if (!stated.birth_date.empty() && !said.birth_date.empty() && stated.birth_date != said.birth_date)
    doubts.push_back({"other_birth_date", "the image states another birth date than was entered"});
  if (!stated.sex.empty() && !said.sex.empty() && stated.sex != said.sex)
    doubts.push_back({"other_sex", "the image states another sex than was entered"});
}

/// @throws InputError for what is no radiograph or no table of beads.
void checkPhantom(const PhantomFiles& files) {
  for (const auto& image : files.images) readRadiograph(image);
  loadCalibrationObject(files.beads);
}

}  // namespace

Warnings fillFromTags(Patient& patient, const RadiographTags& tags) {
  if (patient.name.empty()) patient.name = tags.patient_name;
  if (patient.id.empty()) patient.id = tags.patient_id;
  if (patient.sex.empty() && (tags.patient_sex == "F" || tags.patient_sex == "M" || tags.patient_sex == "O"))
    patient.sex = tags.patient_sex;
  if (!patient.birth_date.empty() || tags.patient_birth_date.empty()) return {};
  const auto born = dateFromText(tags.patient_birth_date);
  const auto taken = dateFromText(tags.study_date);
  if (!born)
    return {{"birth_date_left_out", "the birth date in the image is no day of the calendar and was left out"}};
  if (taken && certainlyBefore(*taken, *born))
    return {{"birth_date_left_out", "the birth date in the image lies after the image itself and was left out"}};
  patient.birth_date = isoText(*born);
  return {};
}

CaseImage importRadiograph(const fs::path& source, const fs::path& folder, int view,
                           std::optional<double> declared_spacing_mm) {
  readRadiograph(source, declared_spacing_mm);  // refuses what is no radiograph
  const std::string name = viewName("images", view) + "-" + sha256OfFile(source).substr(0, 12);
  return {importFile(source, folder, name + imageExtension(source)), declared_spacing_mm};
}

PhantomImages importPhantom(const PhantomFiles& files, const fs::path& folder) {
  checkPhantom(files);
  const auto hashed = [](const fs::path& file) { return "-" + sha256OfFile(file).substr(0, 12); };
  PhantomImages phantom{{}, importFile(files.beads, folder, "calibration/beads" + hashed(files.beads) + ".csv")};
  for (const auto& image : files.images)
    phantom.images.push_back(importFile(
        image, folder, viewName("calibration", int(phantom.images.size())) + hashed(image) + imageExtension(image)));
  return phantom;
}

MadeCase makeCase(const NewCase& wanted, const fs::path& folder, const Date& today) {
  refuseTaken(folder);
  if (wanted.phantom && wanted.rig)
    throw InputError{{"new case", "geometry", "images of a phantom or a rig file", "both"}};
  MadeCase made;
  const Read read = readImages(wanted, made.doubts);
  Case& c = made.c;
  Patient patient = wanted.patient;
  patient.birth_date = checkedDate(patient.birth_date, "patient", "birth date");
  doubtTags(patient, read.images[0].tags, made.doubts);
  const Warnings left_out = fillFromTags(patient, read.images[0].tags);
  made.doubts.insert(made.doubts.end(), left_out.begin(), left_out.end());
  c.exam = wanted.exam;
  setPatient(c, patient, today);
  setExamDate(c, wanted.exam.date, today);
  const Warnings doubts = patientDoubts(c, read.images[0].tags.study_date);
  made.doubts.insert(made.doubts.end(), doubts.begin(), doubts.end());
  c.imported_rig = wanted.rig;
  c.sightings = wanted.sightings;
  caseFromJson(caseToJson(c), "new case");  // what could not be read back is refused before anything is written
  auto phantom = wanted.phantom;
  if (phantom) {
    checkPhantom(*phantom);
    if (phantom->images.size() != read.files.size())
      throw InputError{{"new case", "phantom", std::to_string(read.files.size()) + " images, one a view",
                        std::to_string(phantom->images.size())}};
    moveToFront(phantom->images, read.frontal);  // given in the same order as the images
  }
  for (int view = 0; view < int(read.files.size()); ++view) {
    const auto& source = read.files[std::size_t(view)];
    c.images.push_back(
        {importFile(source, folder, viewName("images", view) + imageExtension(source)), wanted.declared_spacing_mm});
  }
  if (phantom) c.phantom = importPhantom(*phantom, folder);
  saveCase(c, folder);
  return made;
}

}  // namespace sinew
