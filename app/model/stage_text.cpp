#include "app/model/stage_text.h"

#include <QCoreApplication>
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
  return plural(names.size(), "landmark", "landmarks") + ", " + plural(c.sightings.size(), "sighting", "sightings");
}

QString examLine(const Case& c) {
  std::size_t measured = 0;
  for (const auto& e : c.exam.entries) measured += e.measured_deg ? 1 : 0;
  return measured ? plural(measured, "angle measured", "angles measured") : tr("Nothing measured");
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
  if (record != c.stages.end() && !record->second.summary.empty())
    return QString::fromStdString(record->second.summary);
  return enteredLine(c, stage);
}

QString stateExplanation(StageState state, Stage stage) {
  switch (state) {
    case StageState::Missing:
      switch (stage) {
        case Stage::Images:
          return tr("Add a frontal and a lateral radiograph.");
        case Stage::Landmarks:
          return tr("Place landmarks in both radiographs.");
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

QString readableName(const std::string& name) {
  QString text = QString::fromStdString(name);
  QString side;
  if (text.endsWith("_r")) side = tr(", right");
  if (text.endsWith("_l")) side = tr(", left");
  if (!side.isEmpty()) text.chop(2);
  text.replace('_', ' ');
  if (text == "hka") text = "HKA angle";
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
