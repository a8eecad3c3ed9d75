#include <algorithm>
#include <cmath>
#include <map>

#include "clinical/case/case_io.h"
#include "clinical/pipeline/pipeline.h"
#include "clinical/report/report_tables.h"
#include "clinical/synthetic/synthetic_case.h"
#include "imaging/radiograph/radiograph.h"

namespace sinew {
namespace {

std::string readable(std::string text) {
  std::ranges::replace(text, '_', ' ');
  return text;
}

/// "femoral_head_center_r" -> "femoral head center, right".
std::string landmarkText(const std::string& name) {
  const std::string bare = readable(std::string{withoutSide(name)});
  return bare.size() == name.size() ? bare : bare + (sideSign(name) < 0 ? ", left" : ", right");
}

/// "frontal", "lateral", "view 3"
std::string viewText(const Case& c, int view) {
  std::string text = viewTitle(c.rig->views, view);
  text[0] = char(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

std::string orNotRecorded(const std::string& text) {
  return text.empty() ? "not recorded" : text;
}

}  // namespace

ReportTable landmarkTable(const Case& c) {
  ReportTable table;
  table.title = "Landmarks: how well the fitted skeleton explains the picks";
  table.columns = {"Landmark", "View", "Residual u, px", "Residual v, px", "In SD of the pick", "3-D SD, mm"};
  std::map<std::string, double> sd_mm;
  if (c.landmarks)
    for (const auto& point : c.landmarks->points) sd_mm[point.name] = 1000 * std::sqrt(point.cov_W.trace() / 3);
  auto residuals = c.skeleton->residuals;
  std::ranges::stable_sort(residuals, std::greater{}, &LandmarkResidual::sigmas);
  constexpr std::size_t kWorst = 24;
  for (const auto& r : residuals) {
    if (table.rows.size() == kWorst) break;
    const auto sd = sd_mm.find(r.landmark);
    table.rows.push_back({landmarkText(r.landmark), viewText(c, r.view), signedText(r.residual_px.x(), 1),
                          signedText(r.residual_px.y(), 1), numberText(r.sigmas, 1),
                          sd == sd_mm.end() ? "seen once" : numberText(sd->second, 1)});
  }
  table.footnote = "Residual = picked - projected, largest first (" + std::to_string(table.rows.size()) + " of " +
                   std::to_string(residuals.size()) +
                   " picks). 3-D SD: root mean square of the three axes, from the views alone.";
  return table;
}

ReportTable truthTable(const Case& c) {
  ReportTable table;
  table.title = "Synthetic patient: truth and estimate";
  table.columns = {"Quantity", "Side", "Unit", "Truth", "Estimate", "95 % interval", "Truth inside"};
  int inside = 0, count = 0;
  for (const auto& t : compareWithTruth(c)) {
    const int decimals = t.unit == "mm" ? 1 : t.unit == "deg" ? 1 : 3;
    const bool interval = std::isfinite(t.lower95) && std::isfinite(t.upper95);
    const bool covers = interval && t.lower95 <= t.truth && t.truth <= t.upper95;
    count += interval;
    inside += covers;
    table.rows.push_back(
        {readable(t.quantity), t.side.empty() ? "midline" : sideText(t.side[0]), t.unit,
         numberText(t.truth, decimals), std::isfinite(t.estimate) ? numberText(t.estimate, decimals) : kUndetermined,
         interval ? numberText(t.lower95, decimals) + " to " + numberText(t.upper95, decimals) : "none",
         interval ? (covers ? "yes" : "no") : "no interval"});
  }
  table.footnote = "This patient was computed, not seen: seed " + std::to_string(c.truth->seed) +
                   ". The truth lies in " + std::to_string(inside) + " of " + std::to_string(count) +
                   " intervals; 95 % are expected.";
  return table;
}

ReportTable provenanceTable(const Case& c, const std::filesystem::path& case_dir) {
  ReportTable table;
  table.title = "Provenance of the images";
  table.columns = {"View", "Date", "Size, px", "Modality", "SOP instance UID", "SHA-256 (first 16)"};
  for (std::size_t i = 0; i < c.images.size(); ++i) {
    const auto image = readRadiograph(checkedFile(c.images[i].file, case_dir), c.images[i].declared_spacing_mm);
    table.rows.push_back({viewText(c, int(i)), orNotRecorded(dateText(image.tags.study_date)),
                          std::to_string(image.width_px) + " x " + std::to_string(image.height_px),
                          orNotRecorded(image.tags.modality), orNotRecorded(image.tags.sop_instance_uid),
                          c.images[i].file.sha256.substr(0, 16)});
  }
  table.footnote = "The files lie in the case folder, unchanged since they were imported.";
  return table;
}

ReportTable resourceTable(const std::filesystem::path& resource_dir) {
  ReportTable table;
  table.title = "Provenance of the reference data";
  table.columns = {"File", "Read by", "SHA-256 (first 16)"};
  for (const auto& use : resourcesRead(resource_dir)) {
    std::string readers;
    for (const Stage stage : use.read_by) readers += (readers.empty() ? "" : ", ") + nameOf(stage);
    table.rows.push_back({use.path, readers, use.sha256.substr(0, 16)});
  }
  table.footnote =
      "Priors, norms, protocols and the reference body that the stages read, as they are today. A stage "
      "that read others is out of date.";
  return table;
}

}  // namespace sinew
