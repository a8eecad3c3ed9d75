#include "app/widgets/stages/landmarks_page.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalBlocker>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>

#include "app/model/case_actions.h"
#include "app/model/stage_text.h"
#include "app/model/workspace.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/theme.h"
#include "app/widgets/views/radiograph_pane.h"
#include "clinical/pipeline/patient_fit.h"
#include "clinical/pipeline/pipeline.h"
#include "clinical/pipeline/side_check.h"
#include "clinical/report/figure_texts.h"

namespace sinew {
namespace {

// Columns: the name, one a view, the residual.
constexpr int kName = 0, kFirstView = 1;
constexpr double kGross_sigmas = 5;  // the residual that triangulateAll() warns of

/// Whether there is a geometry of every view that was picked in: not while an image has just been added.
bool rigShowsAll(const Case& c) {
  if (!c.rig || c.rig->views.size() < c.images.size()) return false;
  return std::ranges::all_of(c.sightings, [&](const Sighting& s) { return s.view < int(c.rig->views.size()); });
}

}  // namespace

LandmarksPage::LandmarksPage(Workspace& workspace)
    : StagePage{workspace, Stage::Landmarks, tr("Choose a landmark and click it in two radiographs or more.")} {
  auto* import = makeButton("import_sightings", tr("Import"), "import", tr("Read sightings from a CSV file"));
  auto* save = makeButton("export_sightings", tr("Export"), "export", tr("Write the sightings to a CSV file"));
  actions().addWidget(import);
  actions().addWidget(save);
  connect(import, &QPushButton::clicked, this, [this] {
    const auto file = askForFile(this, tr("Sightings"), tr("Tables (*.csv);;All files (*)"));
    if (!file.empty()) importSightings(file);
  });
  connect(save, &QPushButton::clicked, this, [this] {
    const auto file = askForNewFile(this, tr("Export sightings"), "sightings.csv", tr("Tables (*.csv)"));
    if (!file.empty()) exportSightings(file);
  });

  auto* side = new QWidget;
  side->setFixedWidth(326);
  buildList(*side);
  auto* row = new QHBoxLayout;
  row->setSpacing(12);
  row->addWidget(side);
  for (int view = 0; view < 2; ++view) {
    panes_[std::size_t(view)] = new RadiographPane{workspace, view, false};
    panes_[std::size_t(view)]->view().setTool(RadiographView::Tool::Place);
    panes_[std::size_t(view)]->view().setLoupe(true);
    connectPane(*panes_[std::size_t(view)]);
    connect(panes_[std::size_t(view)], &RadiographPane::viewChanged, this, &LandmarksPage::refreshMarks);
    row->addWidget(panes_[std::size_t(view)], 1);
  }
  body().addLayout(row, 1);
  connect(&workspace.view(), &ViewState::landmarkChanged, this, [this] {
    if (!isVisible()) return;
    refreshMarks();
    refreshCard();
    const auto& selected = this->workspace().view().landmark();
    for (int i = 0; i < int(names_.size()); ++i)
      if (names_[std::size_t(i)] == selected && table_->currentRow() != i) {
        const QSignalBlocker block{table_};
        table_->selectRow(i);
        table_->scrollToItem(table_->item(i, 0));
      }
  });
}

void LandmarksPage::buildList(QWidget& side) {
  auto* column = new QVBoxLayout{&side};
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(8);
  search_ = makeSearchField("landmark_search", tr("Find a landmark"));
  progress_ = makeLabel({}, "small");
  progress_->setObjectName("landmark_progress");
  rms_ = makeLabel({}, "small");
  rms_->setObjectName("landmark_rms");
  auto* line = new QHBoxLayout;
  line->addWidget(progress_, 1);
  line->addWidget(rms_);
  table_ = makeTable("landmark_table", {tr("Landmark"), {}, {}, tr("px")});
  table_->setAccessibleName(tr("Landmarks"));

  exchange_frame_ = makeExchangeFrame();
  advice_ = makeLabel({}, "small");
  advice_->setObjectName("landmark_advice");
  advice_->setAccessibleName(tr("Landmarks that are still needed"));
  advice_->setWordWrap(true);
  advice_->hide();
  constexpr int kRest_ms = 300;
  advice_timer_ = new QTimer{this};
  advice_timer_->setSingleShot(true);
  advice_timer_->setInterval(kRest_ms);
  connect(advice_timer_, &QTimer::timeout, this, &LandmarksPage::refreshAdvice);

  auto* card = new Card;
  card_title_ = makeLabel({}, "heading");
  card_title_->setObjectName("landmark_title");
  card_text_ = makeLabel({}, "small");
  card_text_->setObjectName("landmark_details");
  card_text_->setWordWrap(true);
  card_text_->setMinimumHeight(66);
  card_text_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  card->content().addWidget(card_title_);
  card->content().addWidget(card_text_);
  auto* tools = new QHBoxLayout;
  auto* previous = makeToolButton("previous_landmark", "previous", tr("Previous landmark (P)"));
  auto* next = makeToolButton("next_landmark", "next", tr("Next landmark (N)"));
  auto* missing = makeButton("next_missing_landmark", tr("Next to place"), "",
                             tr("Next landmark that is missing in a view (Space)"));
  remove_ = makeButton("remove_landmark", {}, "delete",
                       tr("Remove from every view (Delete: only from the view used last)"));
  for (QWidget* button :
       {static_cast<QWidget*>(previous), static_cast<QWidget*>(next), static_cast<QWidget*>(missing)})
    tools->addWidget(button);
  tools->addStretch();
  tools->addWidget(remove_);
  card->content().addLayout(tools);

  column->addWidget(exchange_frame_);
  column->addWidget(search_);
  column->addLayout(line);
  column->addWidget(table_, 1);
  column->addWidget(advice_);
  column->addWidget(card);

  connect(search_, &QLineEdit::textChanged, this, &LandmarksPage::filterRows);
  connect(table_, &QTableWidget::currentCellChanged, this, [this](int row) {
    if (row >= 0 && row < int(names_.size())) workspace().view().setLandmark(names_[std::size_t(row)]);
  });
  connect(previous, &QToolButton::clicked, this, [this] { step(-1); });
  connect(next, &QToolButton::clicked, this, [this] { step(1); });
  connect(missing, &QPushButton::clicked, this, &LandmarksPage::selectNextMissing);
  connect(remove_, &QPushButton::clicked, this, [this] { removeSelected(true); });
}

QWidget* LandmarksPage::makeExchangeFrame() {
  auto* card = new Card;
  card->setObjectName("exchange_frame");
  exchange_text_ = makeLabel({}, "small");
  exchange_text_->setObjectName("exchange_text");
  exchange_text_->setWordWrap(true);
  exchange_text_->setStyleSheet("color: " + colour::kDanger.name());
  auto* exchange = makeButton("exchange_sides", tr("Exchange left and right"), "",
                              tr("Gives these picks the names of the other side; undo takes it back"));
  connect(exchange, &QPushButton::clicked, this,
          [this] { workspace().document().edit(tr("Exchange left and right"), exchangeSides); });
  card->content().addWidget(exchange_text_);
  card->content().addWidget(exchange);
  card->hide();
  return card;
}

void LandmarksPage::refreshExchange() {
  const Case& c = shownCase();
  const bool found = !c.exchanged_sides.empty() && resultIsOfToday(c, Stage::Landmarks, workspace().resourceDir());
  exchange_frame_->setVisible(found);
  const auto record = c.stages.find(Stage::Landmarks);
  if (!found || record == c.stages.end()) return;
  for (const auto& warning : record->second.warnings)
    if (warning.code == kSidesExchanged) exchange_text_->setText(QString::fromStdString(warning.message));
}

void LandmarksPage::connectPane(RadiographPane& pane) {
  RadiographView& canvas = pane.view();
  connect(&canvas, &RadiographView::placed, this, [this, &pane](const QPointF& uv_px) {
    const std::string name = workspace().view().landmark();
    if (name.empty()) {
      emit workspace().problem(tr("Choose a landmark in the list first."));
      return;
    }
    place(pane, name, uv_px);
  });
  connect(&canvas, &RadiographView::markPressed, this, [this, &pane](const std::string& name) {
    last_view_ = pane.viewIndex();
    workspace().view().setLandmark(name);
  });
  connect(&canvas, &RadiographView::markDragged, this, [this, &pane](const std::string& name, const QPointF& uv_px) {
    const double sigma_px = sigmaOfPick(pane, name);
    workspace().document().preview([&](Case& c) {
      setSighting(c, name, pane.viewIndex(), {uv_px.x(), uv_px.y()}, sigma_px);
    });
  });
  connect(&canvas, &RadiographView::markDropped, this,
          [this, &pane](const std::string& name, const QPointF& uv_px) { place(pane, name, uv_px); });
  connect(&canvas, &RadiographView::markDragCancelled, &workspace().document(), &CaseDocument::dropPreview);
}

void LandmarksPage::place(RadiographPane& pane, const std::string& name, const QPointF& uv_px) {
  const int view = last_view_ = pane.viewIndex();
  const Radiograph* r = pane.view().radiograph();
  const Eigen::Vector2d inside{std::clamp(uv_px.x(), 0.0, r->width_px - 1.0),
                               std::clamp(uv_px.y(), 0.0, r->height_px - 1.0)};
  const bool known = findSighting(shownCase(), name, view) != nullptr;
  const QString label = (known ? tr("Move %1") : tr("Place %1")).arg(readableName(name));
  const double sigma_px = sigmaOfPick(pane, name);
  workspace().document().edit(label, [&](Case& c) { setSighting(c, name, view, inside, sigma_px); });
}

double LandmarksPage::sigmaOfPick(RadiographPane& pane, const std::string& name) {
  const Case& c = shownCase();
  const Radiograph* r = pane.view().radiograph();
  constexpr double kUsualPixel_mm = 0.2;  // of a flat panel that does not say
  const double pixel_mm = r && r->spacing ? r->spacing->column_mm : kUsualPixel_mm;
  return pickSigma_px(workspace().resourceDir(), name, c.rig ? &*c.rig : nullptr, pane.viewIndex(), pixel_mm);
}

int LandmarksPage::viewCount() const {
  return std::max(2, int(shownCase().images.size()));
}

void LandmarksPage::removeSelected(bool all_views) {
  const std::string name = workspace().view().landmark();
  workspace().document().edit(tr("Remove %1").arg(readableName(name)), [&](Case& c) {
    for (int view = 0; view < viewCount(); ++view)
      if (all_views || view == last_view_) removeSighting(c, name, view);
  });
}

void LandmarksPage::keyPressEvent(QKeyEvent* event) {
  switch (event->key()) {
    case Qt::Key_Delete:
    case Qt::Key_Backspace:
      removeSelected(false);
      break;
    case Qt::Key_N:
      step(1);
      break;
    case Qt::Key_P:
      step(-1);
      break;
    case Qt::Key_Space:
      selectNextMissing();
      break;
    default:
      StagePage::keyPressEvent(event);
  }
}

void LandmarksPage::step(int direction) {
  const int count = table_->rowCount();
  for (int i = table_->currentRow() + direction; i >= 0 && i < count; i += direction)
    if (!table_->isRowHidden(i)) {
      table_->setCurrentCell(i, 0);
      return;
    }
}

void LandmarksPage::selectNextMissing() {
  const int count = int(names_.size());
  for (int i = 1; i <= count; ++i) {
    const int row = (std::max(table_->currentRow(), -1) + i) % count;
    const auto found = findings_.find(names_[std::size_t(row)]);
    if (found != findings_.end() && found->second.seen.size() >= 2) continue;
    search_->clear();
    table_->setCurrentCell(row, 0);
    return;
  }
  emit workspace().notice(tr("Every landmark is placed in two views."));
}

void LandmarksPage::filterRows() {
  const QString wanted = search_->text().trimmed();
  for (int i = 0; i < table_->rowCount(); ++i)
    table_->setRowHidden(i,
                         !wanted.isEmpty() && !table_->item(i, kName)->text().contains(wanted, Qt::CaseInsensitive));
}

void LandmarksPage::refresh() {
  for (auto* pane : panes_) pane->refresh();
  refreshColumns();
  refreshNames();
  refreshFindings();
  refreshExchange();
}

void LandmarksPage::refreshColumns() {
  const int views = viewCount(), residual = kFirstView + views;
  if (table_->columnCount() != residual + 1) {
    table_->setColumnCount(residual + 1);
    names_.clear();  // the cells are written anew
  }
  QStringList headings{tr("Landmark")};
  for (int view = 0; view < views; ++view) {
    const QString title = viewTitle(shownCase(), view);
    headings << title.left(1) + (title.back().isDigit() ? title.right(1) : QString{});
  }
  headings << tr("px");
  table_->setHorizontalHeaderLabels(headings);
  auto& header = *table_->horizontalHeader();
  header.setSectionResizeMode(kName, QHeaderView::Stretch);
  for (int column = kFirstView; column <= residual; ++column) {
    header.setSectionResizeMode(column, QHeaderView::Fixed);
    table_->setColumnWidth(column, column == residual ? 52 : 30);
    table_->horizontalHeaderItem(column)->setToolTip(
        column == residual ? tr("Reprojection residual of all views")
                           : tr("Placed in view %1, %2").arg(column).arg(viewTitle(shownCase(), column - 1)));
  }
}

void LandmarksPage::refreshNames() {
  if (protocol_.empty()) protocol_ = loadLandmarkProtocol(workspace().resourceDir());
  std::vector<std::string> protocol;
  for (const auto& landmark : protocol_) protocol.push_back(landmark.name);
  auto names = landmarkNames(shownCase(), protocol);
  if (names == names_) return;
  names_ = std::move(names);
  const QSignalBlocker block{table_};
  table_->setRowCount(int(names_.size()));
  for (int i = 0; i < int(names_.size()); ++i)
    setCell(*table_, i, kName, titleOfLandmark(names_[std::size_t(i)]))
        ->setToolTip(QString::fromStdString(names_[std::size_t(i)]));
  if (workspace().view().landmark().empty() && !names_.empty()) workspace().view().setLandmark(names_.front());
  filterRows();
}

void LandmarksPage::refreshFindings() {
  const Case& c = shownCase();
  findings_.clear();
  for (const auto& s : c.sightings) findings_[s.name].seen.insert(s.view);
  double rms_px = std::numeric_limits<double>::quiet_NaN();
  if (rigShowsAll(c)) {
    const Triangulation points = triangulateAll(*c.rig, c.sightings);
    rms_px = points.rms_px;
    for (const auto& p : points.points) {
      Finding& finding = findings_[p.name];
      finding.residual_px = p.reprojection_rms_px;
      for (const auto& r : p.residuals) finding.residual[r.view] = r.residual_px;
      finding.sd_mm = 1000 * std::sqrt(p.cov_W.trace() / 3);
    }
  }
  int placed = 0;
  const int views = viewCount();
  for (int i = 0; i < int(names_.size()); ++i) {
    const auto& finding = findings_[names_[std::size_t(i)]];
    placed += finding.seen.size() >= 2;
    for (int view = 0; view < views; ++view) {
      const bool seen = finding.seen.contains(view);
      setCell(*table_, i, kFirstView + view, seen ? "●" : "○", Qt::AlignCenter)
          ->setForeground(seen ? colour::kSuccess : QColor{0x9a, 0xa6, 0xb1});
    }
    auto* residual =
        setCell(*table_, i, kFirstView + views,
                std::isfinite(finding.residual_px) ? figure(finding.residual_px, 1) : QString{}, kNumber);
    const bool gross = finding.residual_px > kGross_sigmas * typicalSigma_px(c);
    residual->setForeground(gross ? colour::kDanger : colour::kText);
  }
  progress_->setText((views == 2 ? tr("%1 of %2 placed in both views") : tr("%1 of %2 placed in two views or more"))
                         .arg(placed)
                         .arg(names_.size()));
  advice_timer_->start();
  rms_->setText(std::isfinite(rms_px) ? tr("RMS %1 px").arg(figure(rms_px, 2)) : QString{});
  refreshMarks();
  refreshCard();
}

void LandmarksPage::refreshAdvice() {
  const Case& c = workspace().document().current();
  if (!isVisible() || c.sightings == advised_on_) return;
  advised_on_ = c.sightings;
  constexpr std::size_t kFewest = 6, kShown = 3;  // sightings that place a body; lines that the page has room for
  QStringList lines;
  if (c.rig && c.sightings.size() >= kFewest) {
    try {
      const SkeletonFit fit =
          fitPatient(workspace().reference()->skeleton, *c.rig, c.sightings, workspace().resourceDir());
      for (const auto& text : adviceTexts(fit.advice, workspace().norms(), protocol_))
        lines << QString::fromStdString(text);
      if (fit.outcome == Outcome::Converged && lines.isEmpty())
        lines << tr("These landmarks determine every figure.");
    } catch (const InputError&) {
      lines.clear();  // none of them is a landmark of the skeleton; the stage itself says so
    }
  }
  advice_->setToolTip(lines.join('\n'));
  const qsizetype left = lines.size() - qsizetype(kShown);
  if (left > 0) lines = lines.mid(0, kShown) << tr("... and %1 more (see the tool tip)").arg(left);
  advice_->setText(lines.join('\n'));
  advice_->setVisible(!lines.isEmpty());
}

void LandmarksPage::refreshMarks() {
  const Case& c = shownCase();
  const std::string& selected = workspace().view().landmark();
  for (auto* pane : panes_) {
    const int view = pane->viewIndex();
    std::vector<MarkOverlay> marks;
    for (const auto& s : c.sightings) {
      if (s.view != view) continue;
      MarkOverlay mark{s.name, {s.uv_px.x(), s.uv_px.y()}, sideColour(s.name), false, {}};
      const auto found = findings_.find(s.name);
      if (found != findings_.end() && found->second.residual.contains(view)) {
        const Eigen::Vector2d projected = s.uv_px - found->second.residual.at(view);
        mark.projected_px = QPointF{projected.x(), projected.y()};
      }
      marks.push_back(std::move(mark));
    }
    std::vector<LineOverlay> lines;
    for (int other = 0; other < viewCount() && rigShowsAll(c); ++other) {
      const Sighting* partner = other == view ? nullptr : findSighting(c, selected, other);
      if (!partner) continue;
      LineOverlay line{{}, colour::kEpipolar, 1.3, true};
      for (const auto& p : epipolarLine(*c.rig, other, partner->uv_px, view))
        line.points_px.emplace_back(p.x(), p.y());
      lines.push_back(std::move(line));
    }
    RadiographView& canvas = pane->view();
    canvas.setLines(std::move(lines));
    canvas.setMarks(std::move(marks), selected);
    canvas.setPlacing(!selected.empty() && !findSighting(c, selected, view));
    if (const Sighting* own = findSighting(c, selected, view)) canvas.reveal({own->uv_px.x(), own->uv_px.y()});
  }
}

QString LandmarksPage::titleOfLandmark(const std::string& name) const {
  for (const auto& landmark : protocol_)
    if (landmark.name == name) return QString::fromStdString(landmark.title);
  return readableName(name);
}

void LandmarksPage::refreshCard() {
  const Case& c = shownCase();
  const std::string& name = workspace().view().landmark();
  card_title_->setText(name.empty() ? tr("No landmark chosen") : titleOfLandmark(name));
  QStringList lines;
  for (const auto& landmark : protocol_)
    if (landmark.name == name && !landmark.hint.empty()) lines << QString::fromStdString(landmark.hint);
  bool any = false;
  for (int view = 0; view < viewCount(); ++view) {
    const Sighting* s = findSighting(c, name, view);
    any |= s != nullptr;
    const QString where = viewTitle(c, view);
    lines << (s ? tr("%1: %2, %3 px  ± %4")
                      .arg(where, figure(s->uv_px.x(), 1), figure(s->uv_px.y(), 1), figure(s->sigma_px, 1))
                : tr("%1: not placed").arg(where));
  }
  const auto found = findings_.find(name);
  if (found != findings_.end() && std::isfinite(found->second.sd_mm))
    lines << tr("Residual %1 px, position ± %2 mm")
                 .arg(figure(found->second.residual_px, 2), figure(found->second.sd_mm, 2));
  else if (!c.rig && any)
    lines << tr("Calibrate to see lines and residuals.");
  card_text_->setText(lines.join('\n'));
  remove_->setEnabled(any);
}

void LandmarksPage::importSightings(const std::filesystem::path& file) {
  workspace().document().edit(tr("Import sightings"), [&](Case& c) { c.sightings = loadSightings(file); });
}

void LandmarksPage::exportSightings(const std::filesystem::path& file) {
  try {
    saveSightings(shownCase().sightings, file);
    emit workspace().notice(tr("Sightings written"));
  } catch (const InputError& error) {
    emit workspace().problem(QString::fromUtf8(error.what()));
  }
}

}  // namespace sinew
