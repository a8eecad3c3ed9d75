#include "app/widgets/stages/calibration_page.h"

#include <QButtonGroup>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/model/case_actions.h"
#include "app/model/stage_text.h"
#include "app/model/workspace.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/theme.h"
#include "app/widgets/views/radiograph_pane.h"
#include "clinical/case/case_io.h"
#include "clinical/case/new_case.h"
#include "imaging/calibration/calibration_object.h"

namespace sinew {
namespace {

/// Rows of the geometry table: label and value of one view.
std::vector<std::pair<QString, QString>> describe(const View& view) {
  using Rows = std::vector<std::pair<QString, QString>>;
  const QString size = QObject::tr("%1 × %2 px").arg(view.width_px).arg(view.height_px);
  const Eigen::Vector3d source_m = -view.R_CW.transpose() * view.p_CW;
  const auto mm = [](double m) { return figure(1000 * m, 1); };
  Rows rows = std::visit(
      [&](const auto& p) -> Rows {
        using P = std::decay_t<decltype(p)>;
        if constexpr (std::is_same_v<P, ConeBeam>)
          return {
              {QObject::tr("Projection"), QObject::tr("cone beam")},
              {QObject::tr("Focal length"), QObject::tr("%1 × %2 px").arg(figure(p.fx_px, 1), figure(p.fy_px, 1))},
              {QObject::tr("Principal point, px"), QObject::tr("%1, %2").arg(figure(p.cx_px, 1), figure(p.cy_px, 1))},
              {QObject::tr("Source to origin"), mm(view.p_CW.norm()) + " mm"}};
        else if constexpr (std::is_same_v<P, SlotScan>)
          return {{QObject::tr("Projection"), QObject::tr("slot scan")},
                  {QObject::tr("Source to isocentre"), mm(p.source_to_isocenter_m) + " mm"},
                  {QObject::tr("Pixel at isocentre"),
                   QObject::tr("%1 × %2 mm")
                       .arg(figure(1000 * p.column_spacing_m, 3), figure(1000 * p.row_spacing_m, 3))},
                  {QObject::tr("Isocentre, px"), QObject::tr("%1, %2").arg(figure(p.u0_px, 1), figure(p.v0_px, 1))}};
        else
          return {{QObject::tr("Projection"), QObject::tr("parallel")},
                  {QObject::tr("Pixel"),
                   QObject::tr("%1 × %2 mm")
                       .arg(figure(1000 * p.column_spacing_m, 3), figure(1000 * p.row_spacing_m, 3))}};
      },
      view.projection);
  rows.emplace_back(QObject::tr("Source X, Y, Z"),
                    QString{"%1, %2, %3 mm"}.arg(mm(source_m.x()), mm(source_m.y()), mm(source_m.z())));
  rows.emplace_back(QObject::tr("Image size"), size);
  return rows;
}

QWidget* makeFigure(QLabel*& value, const QString& name, const QString& caption) {
  auto* box = new QWidget;
  auto* column = new QVBoxLayout{box};
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  value = makeLabel("–", "figure");
  value->setObjectName(name);
  column->addWidget(value);
  column->addWidget(makeLabel(caption, "small"));
  return box;
}

}  // namespace

CalibrationPage::CalibrationPage(Workspace& workspace)
    : StagePage{workspace, Stage::Calibration,
                tr("How each radiograph was taken, so that points have a place in space.")} {
  auto* row = new QHBoxLayout;
  row->setSpacing(12);
  auto* side = new QVBoxLayout;
  side->setSpacing(12);
  side->addWidget(makeSourceCard());
  side->addWidget(makeResultCard(), 1);
  auto* side_box = new QWidget;
  side_box->setFixedWidth(400);
  side_box->setLayout(side);
  side->setContentsMargins(0, 0, 0, 0);
  row->addWidget(side_box);
  for (int view = 0; view < 2; ++view) {
    panes_[std::size_t(view)] = new RadiographPane{workspace, view, false};
    row->addWidget(panes_[std::size_t(view)], 1);
    connect(panes_[std::size_t(view)], &RadiographPane::viewChanged, this, &CalibrationPage::showBeads);
  }
  body().addLayout(row, 1);
}

QWidget* CalibrationPage::makeSourceCard() {
  auto* card = new Card{tr("Source of the geometry")};
  phantom_ = new QRadioButton{tr("Images of a bead phantom")};
  imported_ = new QRadioButton{tr("Imported calibration")};
  tags_ = new QRadioButton{tr("Tags of the radiographs")};
  phantom_->setObjectName("source_phantom");
  imported_->setObjectName("source_imported");
  tags_->setObjectName("source_tags");
  auto* group = new QButtonGroup{this};
  for (auto* button : {phantom_, imported_, tags_}) group->addButton(button);
  choose_phantom_ = makeButton("choose_phantom", tr("Choose …"), "",
                               tr("An image of the phantom for every view, and the file of bead positions"));
  choose_rig_ = makeButton("choose_rig", tr("Choose …"), "",
                           tr("A Sinew rig, or an Autoscoper or MayaCam text file for every view"));
  const auto line = [&](QRadioButton* radio, QPushButton* button) {
    auto* row = new QHBoxLayout;
    row->addWidget(radio, 1);
    if (button) row->addWidget(button);
    card->content().addLayout(row);
  };
  line(phantom_, choose_phantom_);
  line(imported_, choose_rig_);
  line(tags_, nullptr);
  connect(choose_phantom_, &QPushButton::clicked, this, &CalibrationPage::askForPhantom);
  connect(choose_rig_, &QPushButton::clicked, this, &CalibrationPage::askForRig);
  connect(phantom_, &QRadioButton::clicked, this, [this] {
    if (rigSource(shownCase()) != RigSource::Phantom) askForPhantom();
    refresh();
  });
  connect(imported_, &QRadioButton::clicked, this, [this] {
    if (rigSource(shownCase()) != RigSource::Imported) askForRig();
    refresh();
  });
  connect(tags_, &QRadioButton::clicked, this,
          [this] { this->workspace().document().edit(tr("Take geometry from image tags"), useImageTags); });
  return card;
}

QWidget* CalibrationPage::makeResultCard() {
  auto* card = new Card{tr("Result")};
  auto* figures = new QHBoxLayout;
  figures->setSpacing(20);
  figures->addWidget(makeFigure(rms_, "calibration_rms", tr("reprojection RMS")));
  figures->addWidget(makeFigure(accuracy_, "calibration_accuracy", tr("accuracy in space")));
  figures->addWidget(makeFigure(angle_, "view_angle", tr("between the views")));
  figures->addStretch();
  card->content().addLayout(figures);
  method_ = makeLabel({}, "small");
  method_->setObjectName("calibration_method");
  method_->setWordWrap(true);
  card->content().addWidget(method_);
  geometry_ = makeTable("geometry_table", {tr("Geometry"), tr("Frontal"), tr("Lateral")});
  geometry_->setSelectionMode(QAbstractItemView::NoSelection);
  geometry_->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  geometry_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  wrapRows(*geometry_);
  card->content().addWidget(geometry_, 1);
  return card;
}

void CalibrationPage::refresh() {
  const Case& c = shownCase();
  const RigSource source = rigSource(c);
  phantom_->setChecked(source == RigSource::Phantom);
  imported_->setChecked(source == RigSource::Imported);
  tags_->setChecked(source == RigSource::ImageTags);
  for (auto* pane : panes_) {
    pane->setPhantom(source == RigSource::Phantom);
    pane->refresh();
  }
  refreshGeometry();
  showBeads();
}

void CalibrationPage::refreshGeometry() {
  const auto& rig = shownCase().rig;
  geometry_->setRowCount(0);
  if (!rig) {
    for (auto* label : {rms_, accuracy_, angle_}) label->setText("–");
    method_->setText(tr("Not calibrated yet"));
    return;
  }
  const auto& record = rig->calibration;
  rms_->setText(std::isfinite(record.rms_px) ? figure(record.rms_px, 3) + " px" : tr("none"));
  accuracy_->setText(std::isfinite(record.accuracy_mm) ? "± " + figure(record.accuracy_mm, 2) + " mm"
                                                       : tr("unknown"));
  angle_->setText(figure(angleBetweenViews_rad(*rig) * 180 / std::numbers::pi, 1) + "°");
  method_->setText(tr("%1  ·  calibration %2  ·  %3")
                       .arg(methodTitle(record.method), QString::fromStdString(record.id),
                            rig->patient_aligned ? tr("in the patient's axes") : tr("in the laboratory's axes")));
  QStringList headings{tr("Geometry")};
  for (int view = 0; view < int(rig->views.size()); ++view) headings << viewTitle(shownCase(), view);
  geometry_->setColumnCount(int(headings.size()));
  geometry_->setHorizontalHeaderLabels(headings);
  for (int view = 0; view < int(rig->views.size()); ++view) {
    const auto rows = describe(rig->views[std::size_t(view)]);
    geometry_->setRowCount(std::max(geometry_->rowCount(), int(rows.size())));
    for (int i = 0; i < int(rows.size()); ++i) {
      setCell(*geometry_, i, 0, rows[std::size_t(i)].first);
      setCell(*geometry_, i, view + 1, rows[std::size_t(i)].second)->setToolTip(rows[std::size_t(i)].second);
    }
  }
  geometry_->resizeRowsToContents();
}

void CalibrationPage::showBeads() {
  const Case& c = shownCase();
  for (auto* pane : panes_) {
    const std::size_t view = std::size_t(pane->viewIndex());
    std::vector<MarkOverlay> marks;
    if (c.phantom && c.rig && view < c.rig->views.size()) {
      const auto object = loadCalibrationObject(checkedFile(c.phantom->beads, workspace().document().folder()));
      for (const auto& bead : object.beads)
        if (const auto uv_px = project(c.rig->views[view], bead.p_WQ))
          marks.push_back({bead.name, {uv_px->x(), uv_px->y()}, colour::kMidline, true, {}});
    }
    pane->view().setMarks(std::move(marks), {});
  }
}

void CalibrationPage::askForRig() {
  // The two kinds of text file cannot be told apart by their names: the person says which.
  const std::pair<QString, const char*> formats[] = {{tr("Sinew rig, one file (*.json)"), "json"},
                                                     {tr("Autoscoper, one text file per view (*.txt)"), "autoscoper"},
                                                     {tr("MayaCam, one text file per view (*.txt)"), "mayacam"}};
  QStringList filters;
  for (const auto& [filter, method] : formats) filters << filter;
  QString chosen = filters.front();
  const QStringList names = QFileDialog::getOpenFileNames(this, tr("Calibration: choose the format, then the files"),
                                                          {}, filters.join(";;"), &chosen);
  std::vector<std::filesystem::path> files;
  for (const auto& name : names) files.emplace_back(name.toStdString());
  if (!files.empty()) importRig(files, formats[std::max<qsizetype>(0, filters.indexOf(chosen))].second);
}

void CalibrationPage::askForPhantom() {
  const QString filter = tr("Radiographs (*.dcm *.tif *.tiff *.png);;All files (*)");
  std::vector<std::filesystem::path> images;
  for (int view = 0; view < std::max(2, int(shownCase().images.size())); ++view) {
    images.push_back(askForFile(this, tr("%1 image of the phantom").arg(viewTitle(shownCase(), view)), filter));
    if (images.back().empty()) return;
  }
  const auto beads = askForFile(this, tr("Bead positions: name,x_mm,y_mm,z_mm"), tr("Tables (*.csv);;All files (*)"));
  if (!beads.empty()) importPhantom(images, beads);
}

void CalibrationPage::importRig(const std::vector<std::filesystem::path>& files, const std::string& method) {
  workspace().document().edit(tr("Import calibration"), [&](Case& c) {
    useImportedRig(c, method == "json" ? loadRig(files[0]) : importTextCalibration(files, method));
  });
  refresh();
}

void CalibrationPage::importPhantom(const std::vector<std::filesystem::path>& images,
                                    const std::filesystem::path& beads) {
  workspace().document().edit(tr("Choose phantom images"), [&](Case& c) {
    usePhantom(c, sinew::importPhantom({images, beads}, workspace().document().folder()));
  });
  refresh();
}

}  // namespace sinew
