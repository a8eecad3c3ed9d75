#include "app/model/stage_text.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <set>

namespace sinew {
namespace {

QString tr(const char* text) {
  return QCoreApplication::translate("stage", text);
}

QString plural(std::size_t n, const char* one, const char* many) {
  return QString::number(n) + ' ' + (n == 1 ? tr(one) : tr(many));
}

QString landmarkLine(const Case& c) {
  if (c.sightings.empty()) return tr("No landmark placed");
  std::set<std::string> names;
  for (const auto& s : c.sightings) names.insert(s.name);
  return plural(names.size(), "landmark", "landmarks") + ' ' + tr("placed");
}

QString examLine(const Case& c) {
  std::size_t measured = 0;
  for (const auto& e : c.exam.entries) measured += e.measured_deg ? 1 : 0;
  return measured ? plural(measured, "angle measured", "angles measured") : tr("Nothing measured");
}

QString calibrationLine(const BiplanarRig& rig) {
  const QString method = methodTitle(rig.calibration.method);
  return std::isfinite(rig.calibration.rms_px) ? tr("%1, %2 px").arg(method, figure(rig.calibration.rms_px, 2))
                                               : method;
}

QString landmarkResultLine(const Triangulation& landmarks) {
  const QString points = plural(landmarks.points.size(), "point", "points");
  return std::isfinite(landmarks.rms_px) ? tr("%1, RMS %2 px").arg(points, figure(landmarks.rms_px, 2)) : points;
}

QString examResultLine(const ExamFit& fit) {
  const auto measured = std::ranges::count_if(fit.tests, [](const auto& t) { return t.measured_deg.has_value(); });
  return plural(std::size_t(measured), "angle", "angles") + ", " +
         plural(fit.length_factors.size(), "muscle", "muscles");
}

/// In few words, since the rail is narrow; empty if there is no result.
QString resultLine(const Case& c, Stage stage) {
  switch (stage) {
    case Stage::Images:
      return plural(c.images.size(), "radiograph", "radiographs") + ' ' + tr("checked");
    case Stage::Calibration:
      return c.rig ? calibrationLine(*c.rig) : QString{};
    case Stage::Landmarks:
      return c.landmarks ? landmarkResultLine(*c.landmarks) : QString{};
    case Stage::Skeleton:
      return c.skeleton ? tr("Fitted, RMS %1 px").arg(figure(c.skeleton->rms_px, 2)) : QString{};
    case Stage::Musculature:
      return c.model ? tr("Model built") : QString{};
    case Stage::Exam:
      return c.exam_fit ? examResultLine(*c.exam_fit) : QString{};
    case Stage::Report:
      return c.report ? tr("Report written") : QString{};
  }
  return {};
}

QString enteredLine(const Case& c, Stage stage) {
  switch (stage) {
    case Stage::Images:
      return c.images.empty() ? tr("No image") : plural(c.images.size(), "image", "images");
    case Stage::Calibration:
      return c.imported_rig ? tr("Imported geometry") : c.phantom ? tr("Bead phantom") : tr("From the image tags");
    case Stage::Landmarks:
      return landmarkLine(c);
    case Stage::Exam:
      return examLine(c);
    case Stage::Skeleton:
      return tr("Not fitted");
    case Stage::Musculature:
      return tr("Not built");
    case Stage::Report:
      return tr("Not made");
  }
  return {};
}

}  // namespace

QString stateTitle(StageState state) {
  switch (state) {
    case StageState::Missing:
      return tr("To enter");
    case StageState::Blocked:
      return tr("Waiting");
    case StageState::Ready:
      return tr("Ready");
    case StageState::Stale:
      return tr("Out of date");
    case StageState::Done:
      return tr("Done");
    case StageState::Failed:
      return tr("Failed");
  }
  return {};
}

QString stageLine(const Case& c, Stage stage) {
  const auto record = c.stages.find(stage);
  const bool done = record != c.stages.end() && record->second.outcome == Outcome::Converged;
  const QString result = done ? resultLine(c, stage) : QString{};
  return result.isEmpty() ? enteredLine(c, stage) : result;
}

QString stateExplanation(StageState state, Stage stage) {
  switch (state) {
    case StageState::Missing:
      switch (stage) {
        case Stage::Images:
          return tr("Add a frontal and a lateral radiograph.");
        case Stage::Landmarks:
          return tr("Place landmarks in two radiographs or more.");
        case Stage::Exam:
          return tr("Enter at least one measured angle.");
        default:
          return tr("Nothing has been entered for this stage.");
      }
    case StageState::Blocked:
      return tr("An earlier stage must be done first.");
    case StageState::Stale:
      return tr("The inputs changed since this was computed. Run the stage again.");
    case StageState::Failed:
      return tr("The last run did not reach a result.");
    default:
      return {};
  }
}

QString spacingText(const Radiograph& radiograph) {
  if (!radiograph.spacing || radiograph.spacing->source == PixelScaleSource::None)
    return tr("pixel size unknown: measured in px");
  const auto& s = *radiograph.spacing;
  QString source;
  switch (s.source) {
    case PixelScaleSource::Fiducial:
      source = tr("by a fiducial");
      break;
    case PixelScaleSource::Geometry:
      source = tr("by the geometry");
      break;
    case PixelScaleSource::Declared:
      source = tr("as declared");
      break;
    case PixelScaleSource::ImagerMagnified:
      source = tr("at the patient, by magnification");
      break;
    case PixelScaleSource::ImagerAtDetector:
      source = tr("at the detector");
      break;
    case PixelScaleSource::None:
      break;
  }
  return QStringLiteral("%1 × %2 mm, %3").arg(s.column_mm, 0, 'f', 3).arg(s.row_mm, 0, 'f', 3).arg(source);
}

QString viewTitle(const Case& c, int view) {
  if (c.rig && view < int(c.rig->views.size())) return tr(viewTitle(c.rig->views, view).c_str());
  return view == 0 ? tr("Frontal") : view == 1 ? tr("Lateral") : tr("View %1").arg(view + 1);
}

QString methodTitle(const std::string& method) {
  if (method == "bead_phantom") return tr("Bead phantom");
  if (method == "dicom_slot_scan") return tr("Slot scanner tags");
  if (method == "dicom_nominal") return tr("Nominal image tags");
  if (method == "autoscoper") return tr("Autoscoper file");
  if (method == "mayacam") return tr("MayaCam file");
  if (method == "json") return tr("Geometry file");
  return QString::fromStdString(method);
}

QString readableName(const std::string& name) {
  QString text = QString::fromStdString(name);
  QString side;
  if (text.endsWith("_r")) side = tr(", right");
  if (text.endsWith("_l")) side = tr(", left");
  if (!side.isEmpty()) text.chop(2);
  text.replace('_', ' ');
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text + side;
}

QString sideName(std::string_view side) {
  return side == "r" ? tr("right") : side == "l" ? tr("left") : QString{};
}

QString figure(double value, int decimals) {
  if (!std::isfinite(value)) return QStringLiteral("–");
  QString text = QString::number(value, 'f', decimals);
  if (text.startsWith('-') && text.mid(1).toDouble() == 0) text.remove(0, 1);  // no "-0.0"
  return text.replace('-', QChar{0x2212});
}

}  // namespace sinew
