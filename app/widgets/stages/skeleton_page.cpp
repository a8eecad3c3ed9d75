#include "app/widgets/stages/skeleton_page.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <map>

#include "app/model/stage_text.h"
#include "app/model/workspace.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/theme.h"
#include "app/widgets/views/model_view.h"
#include "app/widgets/views/radiograph_pane.h"
#include "clinical/report/figure_texts.h"
#include "clinical/report/report_tables.h"
#include "clinical/report/supported_bones.h"
#include "core/model/bone_contours.h"
#include "core/skeleton/fit/landmark_protocol.h"

namespace sinew {
namespace {

/// The same figure the other way.
QString comparisonText(const BoneFigure& f) {
  if (!std::isfinite(f.other)) return {};
  const QString other =
      QObject::tr("%1 (%2 to %3)").arg(figure(f.other, 1), figure(f.other_lower95, 1), figure(f.other_upper95, 1));
  return f.triangulated
             ? QObject::tr("Taken from the picks themselves: the bone is outside the model. Fitted: %1").arg(other)
             : QObject::tr("By the fitted bone. From the picks themselves: %1").arg(other);
}

}  // namespace

SkeletonPage::SkeletonPage(Workspace& workspace)
    : StagePage{workspace, Stage::Skeleton, tr("Bones fitted to the landmarks of the radiographs.")} {
  auto* views = new QHBoxLayout;
  views->setSpacing(12);
  model_ = new ModelView{"skeleton_model", false};
  views->addWidget(model_, 5);
  for (int view = 0; view < 2; ++view) {
    panes_[std::size_t(view)] = new RadiographPane{workspace, view, false};
    views->addWidget(panes_[std::size_t(view)], 4);
    connect(panes_[std::size_t(view)], &RadiographPane::viewChanged, this,
            [this] { refreshOverlays(this->workspace().patientModel().get()); });
  }
  table_ = makeTable("figure_table", {tr("Figure"), tr("Right"), tr("95 % interval"), tr("Left"), tr("95 % interval"),
                                      tr("Right − left"), tr("Unit")});
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  table_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  table_->horizontalHeader()->setSectionResizeMode(6, QHeaderView::ResizeToContents);
  table_->setSelectionMode(QAbstractItemView::NoSelection);
  table_->verticalHeader()->setDefaultSectionSize(26);
  for (int column = 1; column <= 5; ++column)
    table_->horizontalHeaderItem(column)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
  table_->setMinimumHeight(190);
  summary_ = makeLabel({}, "small");
  summary_->setObjectName("fit_summary");
  summary_->setWordWrap(true);
  body().addLayout(views, 5);
  body().addWidget(table_, 3);
  body().addWidget(summary_);
}

void SkeletonPage::refresh() {
  const Case& c = shownCase();
  const auto model = workspace().patientModel();
  model_->setModel(model, model ? c.skeleton->posture : Posture{}, tr("Run this stage to see the fitted skeleton."));
  for (auto* pane : panes_) pane->refresh();
  refreshOverlays(model.get());
  refreshFigures();
}

void SkeletonPage::refreshOverlays(const Model* model) {
  const Case& c = shownCase();
  for (auto* pane : panes_) {
    const std::size_t view = std::size_t(pane->viewIndex());
    std::vector<LineOverlay> lines;
    if (model && c.rig && view < c.rig->views.size()) {
      const View& geometry = c.rig->views[view];
      for (const auto& contour : boneContours(supportedBones(*model, c.sightings),
                                              segmentPoses(model->skeleton, c.skeleton->posture), geometry))
        for (const auto& line : contour.lines) {
          LineOverlay overlay{{}, sideColour(contour.bone), 1.3, false};
          for (const auto& p : line) overlay.points_px.emplace_back(p.x(), p.y());
          lines.push_back(std::move(overlay));
        }
    }
    pane->view().setLines(std::move(lines));
  }
}

void SkeletonPage::refreshFigures() {
  const auto& fit = shownCase().skeleton;
  table_->setRowCount(0);
  if (!fit) {
    summary_->setText(tr("No fit yet."));
    return;
  }
  std::map<std::string, int> rows;
  std::map<std::string, std::array<const BoneFigure*, 2>> pairs;
  for (const auto& f : fit->figures) {
    auto [row, is_new] = rows.try_emplace(f.quantity, table_->rowCount());
    if (is_new) {
      table_->insertRow(row->second);
      const FigureText text = workspace().norms().textOf(f.quantity);
      setCell(*table_, row->second, 0, QString::fromStdString(headingOf(text)))
          ->setToolTip(QString::fromStdString(text.definition));
      for (int column = 1; column <= 5; ++column) setCell(*table_, row->second, column, {}, kNumber);
      setCell(*table_, row->second, 6, f.unit == "deg" ? "°" : QString::fromStdString(f.unit));
    }
    const int column = f.side == "l" ? 3 : 1;
    pairs[f.quantity][f.side == "l" ? 1 : 0] = &f;
    const int decimals = 1;
    const QString mark = f.triangulated ? QStringLiteral(" §") : QString{};
    auto* value = setCell(*table_, row->second, column,
                          f.determined ? figure(f.value, decimals) + mark : tr(kUndetermined), kNumber);
    if (f.determined) {
      setCell(*table_, row->second, column + 1,
              tr("%1 to %2").arg(figure(f.lower95, decimals), figure(f.upper95, decimals)), kNumber);
      value->setToolTip(comparisonText(f));
    } else {
      value->setForeground(colour::kMuted);
      value->setToolTip(
          tr("The images do not say, or not well enough: %1 (%2 to %3)")
              .arg(figure(f.value, decimals), figure(f.lower95, decimals), figure(f.upper95, decimals)));
    }
  }
  for (const auto& [quantity, pair] : pairs)
    if (pair[0] && pair[1] && pair[0]->determined && pair[1]->determined)
      setCell(*table_, rows[quantity], 5, figure(pair[0]->value - pair[1]->value, 1), kNumber);
  QString text =
      tr("Reprojection RMS %1 px over %2 sightings.").arg(figure(fit->rms_px, 2)).arg(fit->residuals.size());
  if (!fit->undetermined.empty())
    text += ' ' + tr("%1 parameters are undetermined by these images and stay at the population's value.")
                      .arg(fit->undetermined.size());
  for (const auto& warning : fit->warnings)
    if (warning.code == "outside_model") text += ' ' + QString::fromStdString(warning.message) + '.';
  if (std::ranges::any_of(fit->figures, &BoneFigure::triangulated))
    text += ' ' + tr("§ taken from the picks themselves; the fitted figure is in its tool tip.");
  const auto protocol = loadLandmarkProtocol(workspace().resourceDir());
  for (const auto& line : adviceTexts(fit->advice, workspace().norms(), protocol))
    text += '\n' + QString::fromStdString(line) + '.';
  summary_->setText(text);
  QStringList names;
  for (const auto& name : fit->undetermined) names << QString::fromStdString(name);
  summary_->setToolTip(names.join(", "));
}

}  // namespace sinew
