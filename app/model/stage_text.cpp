#include "app/model/stage_text.h"

#include <QCoreApplication>
#include <cmath>

#include "clinical/pipeline/stage_table.h"
#include "clinical/pipeline/stage_words.h"

namespace sinew {
namespace {

QString tr(const char* text) {
  return QCoreApplication::translate("stage", text);
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
  const StageRow& row = rowOf(stage);
  const std::string result = done ? row.result_line(c) : "";
  return QString::fromStdString(result.empty() ? row.entered(c) : result);
}

QString stateExplanation(StageState state, Stage stage) {
  switch (state) {
    case StageState::Missing:
      return QString::fromUtf8(rowOf(stage).to_enter);
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
  return QString::fromStdString(calibrationMethodTitle(method));
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
