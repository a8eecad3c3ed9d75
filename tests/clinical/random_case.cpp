#include "tests/clinical/random_case.h"

#include <cmath>

#include "core/file.h"

namespace sinew::test {

double RandomCase::number(double lower, double upper) {
  return std::uniform_real_distribution{lower, upper}(random_);
}

double RandomCase::numberOrNaN() {
  return coin() ? number() : std::nan("");
}

std::string RandomCase::text() {
  static const std::vector<std::string> texts = {
      "",       "plain",       "with \"quotes\" and \\", "two\nlines\tand a tab",
      "김희중", "Müller^Jürg", "{\"a\": [1, 2]}",        "null"};
  return texts[static_cast<std::size_t>(below(static_cast<int>(texts.size())))];
}

Warnings RandomCase::warnings() {
  Warnings list;
  for (int i = below(3); i > 0; --i) list.push_back({"code_" + std::to_string(i), text()});
  return list;
}

FileReference RandomCase::file(const std::string& path) {
  return {path, sha256(std::to_string(number()))};
}

BiplanarRig RandomCase::rig() {
  BiplanarRig rig;
  rig.views.resize(static_cast<std::size_t>(2 + below(3)));
  for (auto& view : rig.views) {
    view.role = static_cast<ViewRole>(below(6));
    view.exposure = below(3);
    if (coin())
      view.projection = ConeBeam{number(1, 9e3), number(1, 9e3), number(), number(), number(), number(), number()};
    else
      view.projection = SlotScan{number(0.5, 2), number(1e-4, 1e-3), number(1e-4, 1e-3), number(), number()};
    view.R_CW = rotationFromVector<double>(Eigen::Vector3d{number(-2, 2), number(-2, 2), number(-2, 2)});
    view.p_CW = vector3();
    view.width_px = 1 + below(5000);
    view.height_px = 1 + below(5000);
  }
  rig.patient_aligned = coin();
  rig.calibration = {text(), text(), numberOrNaN(), numberOrNaN(), warnings()};
  return rig;
}

PhysicalExam RandomCase::exam() {
  PhysicalExam exam{text(), coin() ? "2024-02-29" : "", {}};
  for (int i = below(5); i > 0; --i) {
    ExamEntry entry{
        .test = "test_" + std::to_string(i), .side = side(), .measured_deg = {}, .note = text(), .threshold_Nm = {}};
    if (coin()) entry.measured_deg = number(-90, 90);
    if (coin()) entry.threshold_Nm = number(1, 80);
    exam.entries.push_back(entry);
  }
  exam.leave_in_norm = coin();
  return exam;
}

std::map<std::string, double> RandomCase::factors() {
  std::map<std::string, double> map;
  for (int i = below(4); i > 0; --i) map["muscle_" + std::to_string(i)] = number(0.5, 1.5);
  return map;
}

std::vector<BoneFigure> RandomCase::figures() {
  std::vector<BoneFigure> list;
  for (int i = below(4); i > 0; --i)
    list.push_back({"femur_length", coin() ? "r" : "", "mm", numberOrNaN(), numberOrNaN(), numberOrNaN(), coin(),
                    coin(), numberOrNaN(), numberOrNaN(), numberOrNaN()});
  return list;
}

Triangulation RandomCase::triangulation() {
  Triangulation t;
  for (int i = below(4); i > 0; --i) {
    TriangulatedLandmark point{"point_" + std::to_string(i), vector3(), {}, numberOrNaN(), {}};
    for (int view = 0; view < 3; ++view)
      if (coin()) point.residuals.push_back({view, vector2()});
    point.cov_W << vector3(), vector3(), vector3();
    t.points.push_back(point);
  }
  t.rms_px = numberOrNaN();
  t.warnings = warnings();
  return t;
}

SkeletonFit RandomCase::skeletonFit() {
  SkeletonFit fit;
  fit.outcome = coin() ? Outcome::Converged : Outcome::NotConverged;
  auto values = toVector(ShapeParameters{});
  for (auto& value : values) value += number(-0.1, 0.1);
  fit.shape = shapeFromVector(values);
  fit.posture = Posture::NullaryExpr(50, [this] { return numberOrNaN(); });
  for (int i = below(4); i > 0; --i) fit.residuals.push_back({text(), below(2), vector2(), numberOrNaN()});
  fit.rms_px = numberOrNaN();
  fit.figures = figures();
  if (coin()) fit.undetermined = {"pelvis.depth", text()};
  if (coin())
    fit.outside = {{"femur_r", number(1, 9), text(), number(0, 30)}, {"pelvis", number(1, 2), "asis_l", 3.5}};
  if (coin()) fit.advice = {{"pelvic_tilt", "", {"sacral_endplate_center", text()}, coin()}, {"hka", "l", {}, false}};
  fit.warnings = warnings();
  return fit;
}

ExamFit RandomCase::examFit() {
  ExamFit fit{.outcome = Outcome::Converged,
              .tests = {},
              .groups = {},
              .length_factors = factors(),
              .left_in_norm = coin(),
              .seconds = number(0, 9),
              .warnings = warnings()};
  for (int i = below(4); i > 0; --i) {
    ExamComparison c;
    c.test = text();
    c.side = side();
    if (coin()) c.measured_deg = number();
    c.simulated_before_deg = numberOrNaN();
    c.simulated_after_deg = numberOrNaN();
    c.residual_deg = numberOrNaN();
    if (coin()) c.reason = text();
    c.norm_mean_deg = numberOrNaN();
    c.norm_sd_deg = numberOrNaN();
    c.threshold_Nm = number(1, 80);
    c.stopped_by_joint = coin();
    if (coin()) c.limiting_muscles = {"semimembranosus_r", text()};
    if (coin()) c.limited_by = {"capsule and ligaments", text()};
    if (coin()) c.changed = {{"semimembranosus_r", number(0.6, 1.4)}};
    fit.tests.push_back(c);
  }
  for (int i = below(3); i > 0; --i)
    fit.groups.push_back(
        {text(), side(), coin(), number(0.6, 1.4), numberOrNaN(), numberOrNaN(), coin(), number(0.1, 2)});
  return fit;
}

Case RandomCase::make() {
  Case c;
  c.patient = {.id = text(),
               .name = text(),
               .sex = coin() ? "F" : "",
               .birth_date = coin() ? "2009-05-31" : "",
               .diagnosis = text(),
               .height_m = {},
               .mass_kg = {}};
  if (coin()) c.patient.height_m = number(0.5, 2.2), c.patient.mass_kg = number(3, 150);
  for (int i = below(3); i > 0; --i) c.images.push_back({file("images/view" + std::to_string(i) + ".dcm"), {}});
  if (!c.images.empty() && coin()) c.images[0].declared_spacing_mm = number(0.01, 1);
  if (coin())
    c.phantom = {{file("calibration/view1.dcm"), file("calibration/view2.dcm")}, file("calibration/beads.csv")};
  if (c.phantom && coin()) c.phantom->images.push_back(file("calibration/view3.dcm"));
  if (coin()) c.imported_rig = rig();
  for (int i = below(6); i > 0; --i)
    c.sightings.push_back({"landmark_" + std::to_string(i), below(3), vector2(), number(0.1, 3)});
  c.exam = exam();
  if (coin()) c.truth = {figures(), factors(), static_cast<unsigned>(below(1 << 30))};
  if (coin()) c.rig = rig();
  if (coin()) c.landmarks = triangulation();
  if (coin()) c.exchanged_sides = {{below(3), {"ankle", text()}, coin()}};
  if (coin()) c.skeleton = skeletonFit();
  if (coin()) c.musculature = file("results/musculature/0123456789ab.json");
  if (coin()) c.model = file("results/model.json");
  if (coin()) c.exam_fit = examFit();
  if (coin()) c.report = file("results/report.pdf");
  for (const Stage stage : kStages)
    if (coin()) c.stages[stage] = {Outcome::Cancelled, sha256(text()), number(0, 99), warnings(), text()};
  return c;
}

}  // namespace sinew::test
