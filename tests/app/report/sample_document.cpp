#include "tests/app/report/sample_document.h"

#include <cmath>

#include "app/scene/model_scene.h"
#include "core/version.h"
#include "tests/support/plain_model.h"

namespace sinew::test {
namespace {

void addFigure(SkeletonFit& fit, const char* quantity, const char* side, const char* unit, double value, double half,
               bool determined = true) {
  BoneFigure figure;
  figure.quantity = quantity;
  figure.side = side;
  figure.unit = unit;
  figure.value = value;
  figure.lower95 = value - half;
  figure.upper95 = value + half;
  figure.determined = determined;
  fit.figures.push_back(figure);
}

QImage plainPlate(StandardView view) {
  const Model model = plainModel();
  ModelPicture picture;
  picture.width_px = 200;
  picture.height_px = 400;
  picture.view = view;
  picture.quality = {1, false};
  const auto rgb = renderModel(model, zeroPosture(model.skeleton), picture);
  return QImage{rgb.rgb.data(), rgb.width_px, rgb.height_px, 3 * rgb.width_px, QImage::Format_RGB888}.convertToFormat(
      QImage::Format_RGB32);
}

RadiographPicture plainRadiograph(const char* title, bool frontal) {
  RadiographPicture picture;
  picture.image = QImage{frontal ? 380 : 300, 900, QImage::Format_Grayscale8};
  for (int v = 0; v < picture.image.height(); ++v)
    for (int u = 0; u < picture.image.width(); ++u)
      picture.image.scanLine(v)[u] = uchar(40 + 60 * std::abs(std::sin(u * 0.02)));
  picture.title = title;
  picture.left_letter = frontal ? "R" : "post.";
  picture.right_letter = frontal ? "L" : "ant.";
  picture.px_per_100_mm = 90;
  for (const std::string side : {"_r", "_l"}) {
    BoneContour contour{"femur" + side, {{}}};
    for (int i = 0; i <= 60; ++i) {
      const double t = 2 * M_PI * i / 60;
      contour.lines[0].emplace_back((side == "_r" ? 100 : 260) + 25 * std::cos(t), 300 + 200 * std::sin(t));
    }
    picture.contours.push_back(contour);
  }
  return picture;
}

PassiveMomentPlot plot(const char* title, double measured_deg) {
  PassiveMomentPlot p;
  p.title = title;
  p.convention = "0 = straight, positive = lack of extension";
  p.measured_deg = measured_deg;
  p.simulated_after_deg = 41;
  p.threshold_Nm = 48;
  p.norm_low_deg = 10;
  p.norm_high_deg = 50;
  for (int a = 90; a >= 0; a -= 2) {
    p.before.emplace_back(a, 90 * std::exp(-a / 14.0));
    p.after.emplace_back(a, 480 * std::exp(-a / 18.0));
  }
  return p;
}

ReportTable examOf() {
  ReportTable t{"Physical examination and the same tests on the model",
                {"Test", "Side", "Measured, deg", "Norm, deg", "Model before, deg", "Model after, deg",
                 "Residual, deg", "Stop at, N m", "Limited by"},
                {},
                "Residual = measured - model after.",
                {"Unilateral popliteal angle: 0 = straight; norm Katz 1992"},
                {}};
  for (const char* test : {"Unilateral popliteal angle", "Staheli prone hip extension",
                           "Silfverskiöld, knee extended", "Silfverskiöld, knee flexed 90"})
    for (const char* side : {"Right", "Left"})
      t.rows.push_back({test, side, side[0] == 'R' ? "41" : "not measured: pain", "26 ± 12 \u2021", "22", "40.6",
                        side[0] == 'R' ? "+0.4" : kNotMeasured, "48",
                        "semimembranosus, semitendinosus, biceps femoris long head"});
  return t;
}

ReportTable musclesOf() {
  ReportTable t{"Muscle lengths found from the examination",
                {"Muscle group", "Length factor left", "Length factor right", "Force factor", "Limits, left side",
                 "Limits, right side"},
                {},
                "Length factor: relative to what this skeleton calls for.",
                {},
                {}};
  for (const char* group : {"Hamstrings", "Hip flexors", "Gastrocnemius", "Soleus", "Rectus femoris"})
    t.rows.push_back({group, "0.91", "1.00", kNotMeasured, "Unilateral popliteal angle", "none"});
  return t;
}

}  // namespace

SkeletonFit sampleFit() {
  SkeletonFit fit;
  fit.outcome = Outcome::Converged;
  fit.rms_px = 1.37;
  for (const char* side : {"r", "l"}) {
    const bool right = side[0] == 'r';
    addFigure(fit, "femur_length", side, "mm", right ? 436 : 441, 2);
    addFigure(fit, "tibia_length", side, "mm", 379, 2);
    addFigure(fit, "leg_length", side, "mm", right ? 815 : 820, 2.5);
    addFigure(fit, "hka", side, "deg", right ? 1.2 : 9.5, 0.8);
    addFigure(fit, "neck_shaft_angle", side, "deg", 129, 3.5);
    addFigure(fit, "femoral_torsion", side, "deg", right ? 14 : 38.5, 5);
    addFigure(fit, "tibial_torsion", side, "deg", 31, 4.5, right);
    addFigure(fit, "knee_flexion", side, "deg", 4.1, 0.6);
  }
  addFigure(fit, "leg_length_difference", "", "mm", -5, 3.4);
  addFigure(fit, "pelvic_width", "", "mm", 171, 1.5);
  addFigure(fit, "pelvic_obliquity", "", "deg", -0.6, 0.3);
  addFigure(fit, "pelvic_tilt", "", "deg", 11, 2);
  return fit;
}

ReportDocument sampleDocument() {
  ReportDocument d;
  const NormTable norms = loadNorms(resourceDir());
  Report& r = d.report;
  r.title = "Musculoskeletal report";
  r.header = {{"Patient", personText("Hong^Gildong=洪^吉洞=홍^길동")},
              {"ID", "P-0042"},
              {"Sex", "male"},
              {"Born", "2008-02-11"},
              {"Height", "171 cm"},
              {"Mass", "62.0 kg"},
              {"Diagnosis", "spastic diplegia, GMFCS II"},
              {"Images", "2026-05-04"},
              {"Age at images", "18 y 2 m"},
              {"Examination", "date not recorded"},
              {"Age at exam", "not known"},
              {"Examiner", "not recorded"}};
  r.bones = boneTable(sampleFit(), norms, {"M", 18.2, 1.71});
  r.exam = examOf();
  r.muscles = musclesOf();
  r.annexes = {definitionTable(sampleFit(), norms)};
  ReportTable lengths{
      "Length factor of every changed musculotendon unit", {"Unit", "Side", "Length factor"}, {}, "", {}, {}};
  for (int i = 0; i < 70; ++i) lengths.rows.push_back({"unit number " + std::to_string(i), "Left", "0.912"});
  r.annexes.push_back(lengths);
  r.passive_moments = {plot("Unilateral popliteal angle, right", 41), plot("Unilateral popliteal angle, left", NAN),
                       plot("Silfverskiöld, knee extended, right", 12)};
  r.footer = {{"Software", "Sinew 0.1.0"},
              {"Model", "SHA-256 0123456789ab"},
              {"Calibration", "bead phantom 7f3a, 0.21 px RMS, about 0.2 mm"},
              {"Landmarks", "skeleton fit 1.37 px RMS, triangulation 1.21 px RMS"},
              {"Torque at the stop", "48 N m, per test in the table"},
              {"Norms", "named in the annex"}};
  r.warnings = {"Images: the frontal view has no laterality tag",
                "Examination: the left popliteal angle is not measured",
                "Skeleton: the left tibial torsion is undetermined"};
  r.disclaimer = kDisclaimer;
  d.radiographs = {plainRadiograph("Frontal radiograph", true), plainRadiograph("Lateral radiograph", false)};
  d.plates = {{plainPlate(StandardView::Front), "Front, axes"},
              {plainPlate(StandardView::Right), "Right side, axes"},
              {plainPlate(StandardView::Oblique), "Muscle length"}};
  return d;
}

}  // namespace sinew::test
