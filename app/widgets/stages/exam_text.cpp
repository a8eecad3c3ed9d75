#include "app/widgets/stages/exam_text.h"

#include <QObject>
#include <cmath>

#include "app/model/stage_text.h"
#include "app/widgets/controls/theme.h"
#include "clinical/case/patient_body.h"

namespace sinew {
namespace {

QString cell(const QString& text, const QColor& colour = {}) {
  const QString style = colour.isValid() ? QStringLiteral(" style='color:%1'").arg(colour.name()) : QString{};
  return QStringLiteral("<td%1>%2&nbsp;&nbsp;</td>").arg(style, text);
}

QString row(const GroupFactor& g, const ClinicalTests& tests) {
  const QString side = g.side == 'r' ? QObject::tr("right") : QObject::tr("left");
  const bool changed = std::abs(g.factor - 1) > 5e-3;
  QString interval = QStringLiteral("–");
  if (std::isfinite(g.lower95)) interval = figure(g.lower95, 2) + "–" + figure(g.upper95, 2);
  return "<tr>" + cell(QString::fromStdString(tests.group(g.group).title)) + cell(side) +
         cell(figure(g.factor, 3), changed ? colour::kPrimaryDark : QColor{}) + cell(interval) +
         cell(figure(g.fiber_only_factor, 2)) +
         cell(g.determined ? QString{} : QObject::tr("undetermined"), colour::kWarning) + "</tr>";
}

}  // namespace

TestNorm patientNorm(const Case& c, const ClinicalTest& test) {
  return normOf(test, {"average-adult", ageYears(c.patient, c.exam), c.patient.sex});
}

QString normWords(const ClinicalTest& test, const TestNorm& norm) {
  if (!std::isfinite(norm.mean_deg)) return QObject::tr("no norm");
  QString text = QObject::tr("norm %1°").arg(figure(test.written_deg(norm.mean_deg), 0));
  if (std::isfinite(norm.sd_deg)) text += " ± " + figure(norm.sd_deg, 0) + "°";
  return text + (norm.verified ? QString{} : QObject::tr(" (not verified)"));
}

QString factorTable(const Case& c, const ClinicalTests& tests) {
  if (!c.exam_fit) return QObject::tr("Run this stage to solve the muscle lengths.");
  QString rows;
  for (const auto& g : c.exam_fit->groups)
    if (g.tested) rows += row(g, tests);
  if (rows.isEmpty()) return QObject::tr("No test that muscle lengths follow was measured.");
  const auto head = [](const QString& text) { return "<th align='left'>" + text + "&nbsp;&nbsp;</th>"; };
  return "<table cellspacing='0' cellpadding='1'><tr>" + head(QObject::tr("Muscles")) + head({}) +
         head(QObject::tr("Factor")) + head(QObject::tr("95 %")) + head(QObject::tr("Fibre only")) + head({}) +
         "</tr>" + rows + "</table>";
}

}  // namespace sinew
