#include "app/widgets/stages/exam_page.h"

#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "app/model/case_actions.h"
#include "app/model/stage_text.h"
#include "app/model/workspace.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/curve_plot.h"
#include "app/widgets/controls/theme.h"
#include "app/widgets/stages/exam_text.h"
#include "clinical/case/patient_edit.h"
#include "core/passive/structures.h"
#include "core/rom/tests/clinical_sweep.h"
#include "core/rom/tests/threshold.h"
#include "core/text.h"

namespace sinew {
namespace {

QString degrees(double value) {
  return std::isfinite(value) ? figure(value, 0) + "°" : QStringLiteral("–");
}

QString postureText(const ClinicalTest& test) {
  QStringList parts;
  for (const auto& [coordinate, value_deg] : test.posture_deg)
    parts << readableName(coordinate).toLower() + ' ' + figure(value_deg, 0) + "°";
  return parts.join(", ");
}

const ExamComparison* comparisonOf(const Case& c, const std::string& test, char side) {
  if (!c.exam_fit) return nullptr;
  for (const auto& comparison : c.exam_fit->tests)
    if (comparison.test == test && comparison.side == side) return &comparison;
  return nullptr;
}

/// What a person typed, with the signs that keyboards and habits add; nothing for an empty field.
std::optional<double> typedNumber(const QString& text, const ClinicalTest& test, const char* field) {
  QString number = text.trimmed();
  number.remove(QChar{0xb0});
  number.replace(QChar{0x2212}, '-').replace(',', '.');
  if (number.isEmpty()) return std::nullopt;
  return parseNumber(number.trimmed().toStdString(), test.title, field);
}

QString shortFigure(double value) {
  return figure(value, 1).replace(".0", "");
}

/// The protocol's torque for this patient: of the mass that was entered, else of the body that belongs to the bones.
double usualThreshold(Workspace& workspace, const Case& c, const ClinicalTest& test) {
  double mass_kg = c.patient.mass_kg.value_or(workspace.protocol().reference_mass_kg);
  if (!c.patient.mass_kg)
    if (const auto model = workspace.patientModel()) mass_kg = bodyMass_kg(model->skeleton);
  return scaledThreshold_Nm(test, mass_kg);
}

double thresholdOf(Workspace& workspace, const Case& c, const ClinicalTest& test, char side) {
  if (const auto* comparison = comparisonOf(c, test.id, side)) return comparison->threshold_Nm;
  const ExamEntry* entry = findExamEntry(c, test.id, side);
  if (entry && entry->threshold_Nm) return *entry->threshold_Nm;
  return usualThreshold(workspace, c, test);
}

/// "Limited by psoas major, joint stop".
QString limitWords(const ExamComparison& result) {
  QStringList limits;
  for (const auto& limit : result.limited_by) {
    const bool unit = limit.ends_with("_r") || limit.ends_with("_l");
    limits << (limit.starts_with("stop of") ? QObject::tr("joint stop")
               : unit                       ? readableName(limit).section(',', 0, 0)
                                            : QString::fromStdString(limit));
  }
  return limits.isEmpty() ? QString{} : QObject::tr("Limited by %1").arg(limits.join(", "));
}

}  // namespace

ExamPage::ExamPage(Workspace& workspace)
    : StagePage{workspace, Stage::Exam, tr("Enter what was measured; empty means not measured.")} {
  auto* scroll = new QScrollArea;
  scroll->setObjectName("exam_form");
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  auto* form = new QWidget;
  form_ = new QVBoxLayout{form};
  form_->setContentsMargins(0, 0, 8, 0);
  form_->setSpacing(10);
  scroll->setWidget(form);

  auto* head = new Card;
  auto* head_line = new QHBoxLayout;
  examiner_ = new QLineEdit;
  examiner_->setObjectName("examiner");
  date_ = new QLineEdit;
  date_->setObjectName("exam_date");
  date_->setPlaceholderText("YYYY-MM-DD");
  date_->setFixedWidth(120);
  head_line->addWidget(makeLabel(tr("Examiner"), "small"));
  head_line->addWidget(examiner_, 1);
  head_line->addWidget(makeLabel(tr("Date"), "small"));
  head_line->addWidget(date_);
  head->content().addLayout(head_line);
  leave_in_norm_ = new QCheckBox{tr("Leave lengths as they are inside the norm")};
  leave_in_norm_->setObjectName("leave_in_norm");
  leave_in_norm_->setToolTip(
      tr("A measurement inside the norm of the patient's age, or within its own SD of the mean, changes no muscle "
         "length; beyond the norm lengths fade in. Off: every measurement counts as it stands."));
  head->content().addWidget(leave_in_norm_);
  form_->addWidget(head);
  connect(leave_in_norm_, &QCheckBox::clicked, this, [this](bool on) {
    this->workspace().document().edit(on ? tr("Leave lengths inside the norm") : tr("Solve inside the norm too"),
                                      [&](Case& c) { c.exam.leave_in_norm = on; });
  });
  connect(examiner_, &QLineEdit::editingFinished, this, [this] {
    this->workspace().document().edit(tr("Set examiner"),
                                      [&](Case& c) { c.exam.examiner = examiner_->text().trimmed().toStdString(); });
  });
  connect(date_, &QLineEdit::editingFinished, this, [this] {
    this->workspace().document().edit(tr("Set date of the examination"),
                                      [&](Case& c) { setExamDate(c, date_->text().toStdString(), dateToday()); });
    refresh();  // a refused date shows the truth again
  });

  auto* side = new Card{tr("Passive moment of the simulated test")};
  auto* choice = new QHBoxLayout;
  plot_test_ = new QComboBox;
  plot_test_->setObjectName("plot_test");
  plot_test_->setAccessibleName(tr("Test to plot"));
  plot_side_ = new QComboBox;
  plot_side_->setObjectName("plot_side");
  plot_side_->addItems({tr("Right"), tr("Left")});
  choice->addWidget(plot_test_, 1);
  choice->addWidget(plot_side_);
  plot_ = new CurvePlot;
  plot_->setObjectName("moment_plot");
  verdict_ = makeLabel({}, "small");
  verdict_->setObjectName("plot_verdict");
  verdict_->setWordWrap(true);
  side->content().addLayout(choice);
  side->content().addWidget(plot_, 1);
  side->content().addWidget(verdict_);
  connect(plot_test_, &QComboBox::activated, this, &ExamPage::refreshPlot);
  connect(plot_side_, &QComboBox::activated, this, &ExamPage::refreshPlot);

  auto* lengths = new Card{tr("Muscle lengths")};
  factors_ = makeLabel({}, "small");
  factors_->setObjectName("factor_table");
  factors_->setTextFormat(Qt::RichText);
  factors_->setWordWrap(true);
  lengths->content().addWidget(factors_);

  auto* results = new QVBoxLayout;
  results->setSpacing(10);
  results->addWidget(side, 1);
  results->addWidget(lengths);
  auto* row = new QHBoxLayout;
  row->setSpacing(12);
  row->addWidget(scroll, 8);
  row->addLayout(results, 5);
  body().addLayout(row, 1);
}

void ExamPage::buildForm() {
  if (built_) return;
  const ClinicalTests& protocol = workspace().protocol();
  for (const ClinicalTest* test : protocol.form()) {
    form_->addWidget(makeTestCard(*test));
    plot_test_->addItem(QString::fromStdString(test->title), QString::fromStdString(test->id));
  }
  form_->addStretch();
  built_ = true;
}

QWidget* ExamPage::makeTestCard(const ClinicalTest& test) {
  auto* card = new Card;
  auto* head = new QHBoxLayout;
  head->addWidget(makeLabel(QString::fromStdString(test.title), "heading"));
  head->addStretch();
  card->content().addLayout(head);
  auto* protocol = makeLabel(QString::fromStdString(test.form->protocol), "small");
  protocol->setWordWrap(true);
  auto* convention = makeLabel(tr("Convention: %1").arg(QString::fromStdString(test.form->convention)), "small");
  convention->setStyleSheet("font-weight: 600; color: " + colour::kPrimaryDark.name());
  convention->setWordWrap(true);
  card->content().addWidget(convention);
  card->content().addWidget(protocol);
  auto* facts = makeLabel({}, "small");
  facts->setObjectName("facts_" + QString::fromStdString(test.id));
  facts->setWordWrap(true);
  facts_.emplace(test.id, facts);
  card->content().addWidget(facts);

  auto* grid = new QGridLayout;
  grid->setHorizontalSpacing(10);
  grid->setVerticalSpacing(6);
  const std::pair<QString, QString> titles[] = {
      {{}, {}},
      {tr("Measured °"), tr("Measured angle; empty: not measured")},
      {tr("Stop N m"), tr("Torque at which the examiner stopped; empty: the protocol's, scaled by body mass")},
      {tr("Remark"), tr("Reason why it was not measured, end-feel")},
      {tr("Before"), tr("Simulated on the model before its muscle lengths were solved")},
      {tr("After"), tr("Simulated on the model afterwards")},
      {tr("Residual"), tr("Measured minus after")}};
  for (int column = 0; column < int(std::size(titles)); ++column) {
    auto* title = makeLabel(titles[column].first, "caption");
    title->setToolTip(titles[column].second);
    grid->addWidget(title, 0, column);
  }
  lines_.emplace(std::pair{test.id, 'r'}, makeLine(test, 'r', *grid, 1));
  lines_.emplace(std::pair{test.id, 'l'}, makeLine(test, 'l', *grid, 3));
  grid->setColumnStretch(3, 1);
  card->content().addLayout(grid);
  return card;
}

ExamPage::Line ExamPage::makeLine(const ClinicalTest& test, char side, QGridLayout& grid, int row) {
  const QString name = QString::fromStdString(test.id) + (side == 'r' ? "_r" : "_l");
  const QString side_title = side == 'r' ? tr("Right") : tr("Left");
  Line line;
  grid.addWidget(new QLabel{side_title}, row, 0);
  line.measured = new QLineEdit;
  line.measured->setObjectName("measured_" + name);
  line.measured->setAccessibleName(QString::fromStdString(test.title) + ", " + side_title + tr(", degrees"));
  line.measured->setPlaceholderText(tr("none"));
  line.measured->setFixedWidth(72);
  line.measured->setAlignment(Qt::AlignRight);
  grid.addWidget(line.measured, row, 1);
  line.stop = new QLineEdit;
  line.stop->setObjectName("stop_" + name);
  line.stop->setAccessibleName(QString::fromStdString(test.title) + ", " + side_title + tr(", stop torque in N m"));
  line.stop->setFixedWidth(64);
  line.stop->setAlignment(Qt::AlignRight);
  grid.addWidget(line.stop, row, 2);
  line.note = new QLineEdit;
  line.note->setObjectName("note_" + name);
  line.note->setAccessibleName(tr("Remark or reason, ") + side_title);
  line.note->setPlaceholderText(tr("reason, end-feel"));
  line.note->setMinimumWidth(60);
  line.note->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  grid.addWidget(line.note, row, 3);
  const auto result = [&](QLabel*& label, const QString& key, int column) {
    label = new QLabel;
    label->setObjectName(key + name);
    label->setMinimumWidth(44);
    grid.addWidget(label, row, column);
  };
  result(line.before, "before_", 4);
  result(line.after, "after_", 5);
  result(line.residual, "residual_", 6);
  line.limiting = makeLabel({}, "small");
  line.limiting->setObjectName("limiting_" + name);
  line.limiting->setWordWrap(true);
  grid.addWidget(line.limiting, row + 1, 1, 1, 6);

  const std::string id = test.id;
  connect(line.measured, &QLineEdit::editingFinished, this, [this, id, side] {
    const ClinicalTest& edited = workspace().protocol().test(id);
    enterMeasured(edited, side, lines_.at({id, side}).measured->text());
  });
  connect(line.stop, &QLineEdit::editingFinished, this, [this, id, side] {
    const ClinicalTest& edited = workspace().protocol().test(id);
    enterStop(edited, side, lines_.at({id, side}).stop->text());
  });
  connect(line.note, &QLineEdit::editingFinished, this, [this, id, side] {
    const std::string text = lines_.at({id, side}).note->text().trimmed().toStdString();
    workspace().document().edit(tr("Set remark"), [&](Case& c) { setExamNote(c, id, side, text); });
  });
  return line;
}

void ExamPage::enterMeasured(const ClinicalTest& test, char side, const QString& text) {
  const QString label =
      tr("Set %1, %2").arg(QString::fromStdString(test.title).toLower(), sideName(std::string_view{&side, 1}));
  workspace().document().edit(label, [&](Case& c) {
    setMeasured(c, workspace().protocol(), test.id, side, typedNumber(text, test, "measured angle"));
  });
  refreshLine(test, side, lines_.at({test.id, side}));  // a refused value gives way to the case's
}

void ExamPage::enterStop(const ClinicalTest& test, char side, const QString& text) {
  const QString label = tr("Set stop torque of %1, %2")
                            .arg(QString::fromStdString(test.title).toLower(), sideName(std::string_view{&side, 1}));
  workspace().document().edit(
      label, [&](Case& c) { setThreshold(c, test.id, side, typedNumber(text, test, "stop torque")); });
  refreshLine(test, side, lines_.at({test.id, side}));
}

void ExamPage::refresh() {
  buildForm();
  const Case& c = shownCase();
  examiner_->setText(QString::fromStdString(c.exam.examiner));
  date_->setText(QString::fromStdString(c.exam.date));
  leave_in_norm_->setChecked(c.exam.leave_in_norm);
  factors_->setText(factorTable(c, workspace().protocol()));
  for (auto& [id, label] : facts_) refreshFacts(workspace().protocol().test(id), *label);
  for (auto& [key, line] : lines_) refreshLine(workspace().protocol().test(key.first), key.second, line);
  refreshPlot();
}

void ExamPage::refreshFacts(const ClinicalTest& test, QLabel& label) {
  const TestNorm norm = patientNorm(shownCase(), test);
  label.setText(tr("%1  ·  %2  ·  stop at %3 N m (%4 kg)  ·  accepted %5 to %6")
                    .arg(postureText(test), normWords(test, norm), figure(test.threshold_Nm, 0),
                         figure(test.threshold_mass_kg, 0), degrees(test.form->entry_min_deg),
                         degrees(test.form->entry_max_deg)));
  label.setToolTip(tr("Norm: %1").arg(QString::fromStdString(norm.source)));
}

void ExamPage::refreshLine(const ClinicalTest& test, char side, Line& line) {
  const Case& c = shownCase();
  const ExamEntry* entry = findExamEntry(c, test.id, side);
  const bool measured = entry && entry->measured_deg;
  line.measured->setText(measured ? shortFigure(*entry->measured_deg) : QString{});
  const bool doubt = measured && (*entry->measured_deg < test.form->doubt_min_deg ||
                                  *entry->measured_deg > test.form->doubt_max_deg);
  setRole(line.measured, "state", doubt ? "doubt" : "");
  line.measured->setToolTip(
      doubt
          ? tr("Unusual: expected %1 to %2").arg(degrees(test.form->doubt_min_deg), degrees(test.form->doubt_max_deg))
          : QString::fromStdString(test.form->convention));
  line.stop->setText(entry && entry->threshold_Nm ? shortFigure(*entry->threshold_Nm) : QString{});
  line.stop->setPlaceholderText(figure(usualThreshold(workspace(), c, test), 0));
  line.note->setText(entry ? QString::fromStdString(entry->note) : QString{});

  const ExamComparison* result = comparisonOf(c, test.id, side);
  line.before->setText(result ? degrees(result->simulated_before_deg) : "–");
  line.after->setText(result ? degrees(result->simulated_after_deg) : "–");
  line.residual->setText(result && result->measured_deg ? figure(result->residual_deg, 1) + "°" : "–");
  const bool off = result && std::abs(result->residual_deg) > test.form->measurement_sd_deg;
  line.residual->setStyleSheet(off ? "font-weight: 600; color: " + colour::kWarning.name() : QString{});
  QStringList words;
  if (result) words << limitWords(*result);
  if (result && !result->reason.empty()) words << tr("Residual: %1").arg(QString::fromStdString(result->reason));
  words.removeAll(QString{});
  line.limiting->setText(words.join(". "));
  line.limiting->setVisible(!words.isEmpty());
}

void ExamPage::refreshPlot() {
  const std::string id = plot_test_->currentData().toString().toStdString();
  if (id.empty()) return;
  const ClinicalTest& test = workspace().protocol().test(id);
  const char side = plot_side_->currentIndex() == 0 ? 'r' : 'l';
  const auto model = workspace().patientModel();
  if (!model) {
    plot_->setNothing(tr("Fit the skeleton to see how the test feels before and after."));
    verdict_->clear();
    return;
  }
  const Case& c = shownCase();
  const double threshold_Nm = thresholdOf(workspace(), c, test, side);
  const auto text = [](const QString& words) { return words.toStdString(); };
  FigurePanel panel{text(tr("passive moment, N m"))};
  const ExamComparison* result = comparisonOf(c, id, side);
  if (result && !model->length_factors.empty()) {
    const Model before =
        modelBeforeExam(c, *workspace().reference(), workspace().document().folder(), workspace().resourceDir());
    panel.curves.push_back({text(tr("before")), passiveMomentCurve(before, test, side), LineRole::Before});
  }
  panel.curves.push_back(
      {text(panel.curves.empty() ? tr("model") : tr("after")), passiveMomentCurve(*model, test, side)});
  panel.marks.push_back(
      {text(tr("stop at %1 N m").arg(figure(threshold_Nm, 0))), threshold_Nm, LineRole::Alarm, true});
  const ExamEntry* entry = findExamEntry(c, id, side);
  if (entry && entry->measured_deg)
    panel.marks.push_back({text(tr("measured %1").arg(degrees(*entry->measured_deg))), *entry->measured_deg});
  panel.from_zero = true;
  panel.highest = 3 * threshold_Nm;
  const TestNorm norm = patientNorm(c, test);
  const double mean_deg = test.written_deg(norm.mean_deg);
  if (std::isfinite(mean_deg) && std::isfinite(norm.sd_deg))
    panel.band = {mean_deg - 2 * norm.sd_deg, mean_deg + 2 * norm.sd_deg, text(tr("norm ± 2 SD"))};
  plot_->setPanel(std::move(panel), tr("%1, degrees").arg(QString::fromStdString(test.title)));

  QStringList changes;
  if (result)
    for (const auto& change : result->changed)
      if (std::abs(change.factor - 1) > 5e-4)
        changes << tr("%1 × %2").arg(readableName(change.muscle).section(',', 0, 0), figure(change.factor, 3));
  verdict_->setText(!result             ? tr("Run this stage to solve the muscle lengths.")
                    : changes.isEmpty() ? tr("No muscle length was changed for this test.")
                                        : tr("Changed for this test: %1").arg(changes.join(", ")));
}

}  // namespace sinew
