#include "clinical/report/report.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "clinical/case/case_io.h"
#include "clinical/case/patient_edit.h"
#include "clinical/pipeline/pipeline.h"
#include "clinical/report/report_tables.h"
#include "core/version.h"
#include "imaging/radiograph/radiograph.h"

namespace sinew {
namespace {

void refuseUnfinished(const Case& c, const std::filesystem::path& resource_dir) {
  const auto reasons = reasonsAgainstReport(c, resource_dir);
  if (reasons.empty()) return;
  std::string all;
  for (const auto& reason : reasons) all += (all.empty() ? "" : "; ") + reason;
  throw InputError{{"report", "stages", "every stage done and fresh", all}};
}

std::string imagingDate(const Case& c, const std::filesystem::path& case_dir) {
  if (c.images.empty()) return {};
  const auto& image = c.images.front();
  return dateText(readRadiograph(checkedFile(image.file, case_dir), image.declared_spacing_mm).tags.study_date);
}

std::string orText(const std::string& text, const char* otherwise) {
  return text.empty() ? otherwise : text;
}

std::string ageText(const std::string& birth, const std::string& day) {
  const auto age = ageAt(birth, day);
  return age ? std::to_string(age->years) + " y " + std::to_string(age->months) + " m" : "not known";
}

std::string measuredText(const std::optional<double>& value, double scale, int decimals, const char* unit) {
  return value ? numberText(scale * *value, decimals) + " " + unit : kNotMeasured;
}

std::string sexText(const std::string& sex) {
  return sex == "F" ? "female" : sex == "M" ? "male" : sex == "O" ? "other" : "not recorded";
}

std::vector<std::pair<std::string, std::string>> headerOf(const Case& c, const std::string& imaging_date) {
  const Patient& p = c.patient;
  return {{"Patient", orText(personText(p.name), "not recorded")},
          {"ID", orText(p.id, "not recorded")},
          {"Sex", sexText(p.sex)},
          {"Born", orText(dateText(p.birth_date), "not recorded")},
          {"Height", measuredText(p.height_m, 100, 0, "cm")},
          {"Mass", measuredText(p.mass_kg, 1, 1, "kg")},
          {"Diagnosis", orText(p.diagnosis, "not recorded")},
          {"Images", orText(imaging_date, "date not recorded")},
          {"Age at images", ageText(p.birth_date, imaging_date)},
          {"Examination", orText(c.exam.date, "date not recorded")},
          {"Age at exam", ageText(p.birth_date, c.exam.date)},
          {"Examiner", orText(c.exam.examiner, "not recorded")}};
}

std::string rmsText(double rms_px) {
  return std::isfinite(rms_px) ? numberText(rms_px, 2) + " px RMS" : "no RMS known";
}

std::string calibrationText(const Case& c) {
  const auto& record = c.rig->calibration;
  std::string method = record.method;
  std::ranges::replace(method, '_', ' ');
  std::string text = method + " " + orText(record.id, "without id") + ", " + rmsText(record.rms_px);
  if (std::isfinite(record.accuracy_mm))
    text +=
        record.accuracy_mm < 0.1 ? ", better than 0.1 mm" : ", about " + numberText(record.accuracy_mm, 1) + " mm";
  return text;
}

std::string thresholdsText(const ExamFit& fit) {
  if (fit.tests.empty()) return kNotMeasured;
  double low = fit.tests.front().threshold_Nm, high = low;
  for (const auto& t : fit.tests) low = std::min(low, t.threshold_Nm), high = std::max(high, t.threshold_Nm);
  const std::string a = numberText(low), b = numberText(high);
  return (a == b ? a : a + " to " + b) + " N m, per test in the table";
}

std::vector<std::pair<std::string, std::string>> footerOf(const Case& c) {
  return {{"Software", std::string{"Sinew "} + kVersion},
          {"Model", c.model ? "SHA-256 " + c.model->sha256.substr(0, 12) : "none"},
          {"Calibration", calibrationText(c)},
          {"Landmarks",
           "skeleton fit " + rmsText(c.skeleton->rms_px) + ", triangulation " + rmsText(c.landmarks->rms_px)},
          {"Torque at the stop", thresholdsText(*c.exam_fit)},
          {"Norms", "sources in the annex; \u2021 = not yet verified"}};
}

std::vector<std::string> warningsOf(const Case& c) {
  std::vector<std::string> texts;
  std::set<std::string> seen;
  const auto add = [&](const std::string& stage, const Warnings& warnings) {
    for (const auto& w : warnings)
      if (seen.insert(w.message).second) texts.push_back(stage + ": " + w.message);
  };
  for (const Stage stage : kStages)
    if (const auto it = c.stages.find(stage); it != c.stages.end() && stage < Stage::Report)
      add(titleOf(stage), it->second.warnings);
  add(titleOf(Stage::Calibration), c.rig->calibration.warnings);
  add(titleOf(Stage::Landmarks), c.landmarks->warnings);
  add(titleOf(Stage::Skeleton), c.skeleton->warnings);
  add(titleOf(Stage::Exam), c.exam_fit->warnings);
  return texts;
}

}  // namespace

Report makeReport(const Case& c, const std::filesystem::path& case_dir, const Model& reference,
                  const std::filesystem::path& resource_dir) {
  refuseUnfinished(c, resource_dir);
  const NormTable norms = loadNorms(resource_dir);
  const ClinicalTests protocol = loadClinicalTests(resource_dir);
  const std::string imaging_date = imagingDate(c, case_dir);
  NormQuery who{c.patient.sex, {}, c.patient.height_m};
  if (const auto age = ageAt(c.patient.birth_date, imaging_date.empty() ? c.exam.date : imaging_date))
    who.age_y = age->inYears();

  Report report;
  report.title = c.truth ? "Musculoskeletal report (synthetic patient)" : "Musculoskeletal report";
  report.header = headerOf(c, imaging_date);
  report.bones = boneTable(*c.skeleton, norms, who);
  report.exam = examTable(*c.exam_fit, c.exam, protocol);
  report.muscles = muscleTable(*c.exam_fit, protocol);
  report.annexes = {residualTable(*c.exam_fit, protocol),
                    definitionTable(*c.skeleton, norms),
                    protocolTable(*c.exam_fit, protocol),
                    lengthFactorTable(*c.exam_fit),
                    landmarkTable(c),
                    provenanceTable(c, case_dir),
                    resourceTable(resource_dir)};
  if (c.truth) report.annexes.push_back(truthTable(c));
  report.passive_moments = passiveMomentPlots(c, modelBeforeExam(c, reference, case_dir, resource_dir), protocol);
  report.footer = footerOf(c);
  report.warnings = warningsOf(c);
  for (const auto& doubt : patientDoubts(c, imaging_date)) report.warnings.push_back("Patient: " + doubt.message);
  report.disclaimer = kDisclaimer;
  return report;
}

}  // namespace sinew
