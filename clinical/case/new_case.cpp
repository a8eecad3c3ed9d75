#include "clinical/case/new_case.h"

#include "clinical/case/case_io.h"
#include "core/file.h"

namespace sinew {

void fillFromTags(Patient& patient, const RadiographTags& tags) {
  if (patient.name.empty()) patient.name = tags.patient_name;
  if (patient.id.empty()) patient.id = tags.patient_id;
  if (patient.sex.empty() && (tags.patient_sex == "F" || tags.patient_sex == "M" || tags.patient_sex == "O"))
    patient.sex = tags.patient_sex;
  const std::string& date = tags.patient_birth_date;  // DICOM: YYYYMMDD
  if (patient.birth_date.empty() && date.size() == 8)
    patient.birth_date = date.substr(0, 4) + "-" + date.substr(4, 2) + "-" + date.substr(6, 2);
}

CaseImage importRadiograph(const std::filesystem::path& source, const std::filesystem::path& folder, int view,
                           std::optional<double> declared_spacing_mm) {
  const Radiograph radiograph = readRadiograph(source, declared_spacing_mm);  // refuses what is no radiograph
  const bool dicom = !radiograph.tags.sop_class_uid.empty();
  const std::string extension = dicom ? ".dcm" : source.extension().string();
  const std::string name =
      "images/view" + std::to_string(view + 1) + "-" + sha256OfFile(source).substr(0, 12) + extension;
  return {importFile(source, folder, name), declared_spacing_mm};
}

Case makeCase(const NewCase& wanted, const std::filesystem::path& folder) {
  if (std::filesystem::exists(folder / "case.json"))
    throw InputError{{folder.string(), "folder", "one without a case", "a case.json"}};
  if (wanted.images.size() < 2)
    throw InputError{{folder.string(), "radiographs", "two or more", std::to_string(wanted.images.size())}};
  Case c;
  c.patient = wanted.patient;
  for (const auto& image : wanted.images) readRadiograph(image, wanted.declared_spacing_mm);
  for (int view = 0; view < int(wanted.images.size()); ++view)
    c.images.push_back(importRadiograph(wanted.images[std::size_t(view)], folder, view, wanted.declared_spacing_mm));
  fillFromTags(c.patient, readRadiograph(wanted.images[0], wanted.declared_spacing_mm).tags);
  saveCase(c, folder);
  return c;
}

}  // namespace sinew
