#include "app/widgets/explorer/rom_panel.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QTimer>
#include <QVBoxLayout>

#include "app/model/explorer/explorer.h"
#include "app/model/stage_text.h"
#include "app/scene/rom_patch.h"
#include "app/scene/rom_sphere.h"
#include "app/widgets/controls/colour_bar.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/theme.h"
#include "app/widgets/views/rom_sphere_view.h"
#include "core/angle.h"
#include "core/skeleton/clinical_angles.h"
#include "core/skeleton/motion_words.h"

namespace sinew {
namespace {

constexpr int kSlow_ms = 250;

/// Whether two postures differ in more than the joint itself and the coordinate that is held at two values.
bool sameConditions(const Skeleton& skeleton, const RomQuestion& question, const Posture& a, const Posture& b) {
  const Joint& joint = skeleton.joints[std::size_t(skeleton.jointIndex(question.joint))];
  const int with = question.with.empty() ? -1 : skeleton.coordinateIndex(question.with);
  const Eigen::VectorXd x = clinicalFromPosture(skeleton, a), y = clinicalFromPosture(skeleton, b);
  constexpr double kRounding = 1e-6;
  for (int i = 0; i < int(x.size()); ++i) {
    const bool free =
        i == with || (i >= joint.first_coordinate && i < joint.first_coordinate + joint.coordinate_count);
    if (!free && std::abs(x[i] - y[i]) > kRounding) return false;
  }
  return true;
}

QComboBox* makeChoice(const QString& object_name, const QString& accessible_name) {
  auto* choice = new QComboBox;
  choice->setObjectName(object_name);
  choice->setAccessibleName(accessible_name);
  choice->setMaxVisibleItems(20);
  choice->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  return choice;
}

}  // namespace

RomPanel::RomPanel(Explorer& explorer, RomStudy::Mapper mapper, QWidget* parent)
    : QWidget{parent}, explorer_{explorer}, study_{std::move(mapper)} {
  setObjectName("rom_panel");
  joint_ = makeChoice("rom_joint", tr("Ball joint"));
  with_ = makeChoice("rom_with", tr("Second joint"));
  auto* values = new QHBoxLayout;
  values->setSpacing(6);
  values->addWidget(makeLabel(tr("held at"), "muted"));
  for (std::size_t i = 0; i < 2; ++i) {
    auto* value = new QDoubleSpinBox;
    value->setObjectName(i == 0 ? "rom_first_value" : "rom_second_value");
    value->setAccessibleName(i == 0 ? tr("First angle of the second joint") : tr("Second angle of the second joint"));
    value->setKeyboardTracking(false);
    value->setDecimals(0);
    value->setRange(-180, 180);
    value->setSingleStep(5);
    value->setSuffix(QStringLiteral("°"));
    values_[i] = value;
    if (i == 1) values->addWidget(makeLabel(tr("and"), "muted"));
    values->addWidget(value, 1);
    connect(value, &QDoubleSpinBox::valueChanged, this, [this] { ask(true); });
  }
  for (std::size_t i = 0; i < 2; ++i) spheres_[i] = new RomSphereView{i == 0 ? "rom_first" : "rom_second"};
  spheres_[1]->turnWith(*spheres_[0]);
  bar_ = new ColourBar{ColourBar::Ground::Light};
  bar_->setToolTip(tr("How far the bone can turn about its own shaft when it points there"));
  summary_ = makeLabel({}, "small");
  summary_->setObjectName("rom_summary");
  summary_->setWordWrap(true);
  on_body_ = makeChoice("rom_on_body", tr("Show on the body"));
  progress_ = new QProgressBar;
  progress_->setObjectName("rom_progress");
  progress_->setRange(0, 1000);
  progress_->setTextVisible(false);
  cancel_ = makeButton("rom_cancel", tr("Cancel"), {}, tr("Stop computing the range of motion"));

  auto* waiting = new QHBoxLayout;
  waiting->addWidget(progress_, 1);
  waiting->addWidget(cancel_);
  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(14, 12, 10, 8);
  column->setSpacing(5);
  column->addWidget(joint_);
  column->addWidget(with_);
  column->addLayout(values);
  column->addLayout(waiting);
  column->addWidget(spheres_[0], 1);
  column->addWidget(spheres_[1], 1);
  column->addWidget(bar_);
  column->addWidget(summary_);
  column->addWidget(on_body_);

  slow_ = new QTimer{this};
  slow_->setSingleShot(true);
  slow_->setInterval(kSlow_ms);
  const auto showProgress = [this](bool shown) {
    progress_->setVisible(shown);
    cancel_->setVisible(shown);
  };
  showProgress(false);
  connect(slow_, &QTimer::timeout, this, [=] { showProgress(true); });
  connect(&study_.runner(), &JobRunner::started, this, [this] {
    progress_->setValue(0);
    if (!progress_->isVisible() && !slow_->isActive()) slow_->start();
  });
  connect(&study_.runner(), &JobRunner::progressed, this,
          [this](double fraction) { progress_->setValue(int(1000 * fraction)); });
  connect(&study_.runner(), &JobRunner::ended, this, [this](JobRunner::Ending ending, const QString& message) {
    if (ending == JobRunner::Ending::Failed) summary_->setText(message);
  });
  connect(&study_, &RomStudy::idle, this, [=, this] {
    slow_->stop();
    showProgress(false);
  });
  connect(cancel_, &QPushButton::clicked, &study_, &RomStudy::cancel);
  connect(joint_, &QComboBox::currentIndexChanged, this, &RomPanel::chooseJoint);
  connect(with_, &QComboBox::currentIndexChanged, this, [this] {
    for (auto* value : values_) value->setEnabled(with_->currentIndex() > 0);
    on_body_->setCurrentIndex(std::min(0, on_body_->count() - 1));  // the body does not stand as the next map says
    ask(true);
  });
  connect(on_body_, &QComboBox::activated, this, [this](int index) {
    const auto& answer = study_.answer();
    if (answer && index >= 1 && !answer->question.with.empty())  // the body stands as the map says
      explorer_.setCoordinate(explorer_.model()->skeleton.coordinateIndex(answer->question.with),
                              answer->question.with_deg[std::size_t(index - 1)] * kRadPerDeg);
    emit mapOnBodyChanged();
  });
  connect(&study_, &RomStudy::answered, this, &RomPanel::showAnswer);
  connect(&explorer_, &Explorer::modelChanged, this, &RomPanel::fillJoints);
  connect(&explorer_, &Explorer::postureChanged, this, &RomPanel::askIfPostureMatters);
}

void RomPanel::fillJoints() {
  study_.clear();
  const QString before = joint_->currentData().toString();
  {
    const QSignalBlocker block{joint_};
    joint_->clear();
    for (const auto& name : ballJoints(explorer_.model()->skeleton))
      joint_->addItem(readableName(name), QString::fromStdString(name));
    const int hip = joint_->findData(before.isEmpty() ? QStringLiteral("hip_r") : before);
    joint_->setCurrentIndex(std::max(0, hip));
  }
  chooseJoint();
}

void RomPanel::chooseJoint() {
  const Skeleton& skeleton = explorer_.model()->skeleton;
  const RomQuestion first = firstQuestion(skeleton, joint_->currentData().toString().toStdString());
  on_body_->setCurrentIndex(std::min(0, on_body_->count() - 1));
  const QSignalBlocker block_with{with_}, block_a{values_[0]}, block_b{values_[1]};
  with_->clear();
  with_->addItem(tr("No second joint"), QString{});
  for (const auto& name : secondCoordinates(skeleton, first.joint)) {
    const QString side = sideName(name.ends_with("_l") ? "l" : name.ends_with("_r") ? "r" : "");
    const QString words = readableName(motionWords(name, true));
    with_->addItem(tr("with %1").arg((side.isEmpty() ? words : words + ", " + side).toLower()),
                   QString::fromStdString(name));
  }
  with_->setCurrentIndex(std::max(0, with_->findData(QString::fromStdString(first.with))));
  for (std::size_t i = 0; i < 2; ++i) {
    values_[i]->setValue(first.with_deg[i]);
    values_[i]->setEnabled(with_->currentIndex() > 0);
  }
  ask(true);
}

RomQuestion RomPanel::question() const {
  return {joint_->currentData().toString().toStdString(),
          with_->currentData().toString().toStdString(),
          {values_[0]->value(), values_[1]->value()}};
}

void RomPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  askIfPostureMatters();
}

void RomPanel::ask(bool abandon_running) {
  if (!explorer_.model() || !isVisible()) return;
  study_.ask(explorer_.model(), question(), explorer_.posture(), abandon_running);
}

void RomPanel::askIfPostureMatters() {
  if (!explorer_.model()) return;
  const auto& answer = study_.answer();
  const bool same = answer && answer->model == explorer_.model() && answer->question == question() &&
                    sameConditions(explorer_.model()->skeleton, answer->question, answer->held, explorer_.posture());
  if (same)
    showShaft();
  else
    ask(false);
}

QString RomPanel::conditionText(int map) const {
  const RomQuestion& q = study_.answer()->question;
  if (q.with.empty()) return tr("as posed");
  return tr("%1 %2°").arg(QString::fromStdString(motionWords(q.with, true)), figure(q.with_deg[std::size_t(map)], 0));
}

void RomPanel::showAnswer() {
  const auto& answer = study_.answer();
  if (!answer) {
    emit mapOnBodyChanged();
    return;
  }
  const auto& maps = answer->maps;
  widest_rad_ = answer->widest_rad();
  bar_->setScale(tr("Twist range, degrees"), 0, widest_rad_ / kRadPerDeg, 0, false, false,
                 [](double t) { return romColour(t, 1); });
  spheres_[1]->setVisible(maps.size() > 1);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    spheres_[i]->setCaption(
        tr("%1: %2 of %3 cells").arg(conditionText(int(i))).arg(maps[i].validCount()).arg(RomMap::kCells));
    spheres_[i]->setMap(maps[i], widest_rad_, shaftDirection(*answer->model, maps[i], explorer_.posture()));
  }
  QString text = tr("Directions of the bone that joint and muscles allow, all other joints as posed.");
  if (maps.size() > 1) {
    const double before = maps[0].validCount(), after = maps[1].validCount();
    const RomDifference& d = answer->difference;
    text = tr("%1 cells differ: %2 % of all, %3 % of those free in either.")
               .arg(d.differing())
               .arg(figure(100 * d.ofAll(), 1), figure(100 * d.ofUnion(), 1));
    if (before > 0)
      text.prepend(
          tr("Second against first: %1%2 % cells. ")
              .arg(after >= before ? "+" : QString{QChar{0x2212}}, figure(100 * std::abs(after / before - 1), 1)));
  }
  summary_->setText(text);
  const int shown = std::max(0, on_body_->currentIndex());
  on_body_->clear();
  on_body_->addItem(tr("Not shown on the body"));
  for (std::size_t i = 0; i < maps.size(); ++i) on_body_->addItem(tr("On the body: %1").arg(conditionText(int(i))));
  on_body_->setCurrentIndex(std::min(shown, on_body_->count() - 1));
  emit mapOnBodyChanged();
}

void RomPanel::showShaft() {
  const auto& answer = study_.answer();
  if (!answer || !isVisible()) return;
  for (std::size_t i = 0; i < answer->maps.size(); ++i)
    spheres_[i]->setShaft(shaftDirection(*answer->model, answer->maps[i], explorer_.posture()));
}

const RomMap* RomPanel::mapOnBody() const {
  const auto& answer = study_.answer();
  const int index = on_body_->currentIndex() - 1;
  if (!answer || answer->model != explorer_.model() || index < 0 || index >= int(answer->maps.size())) return nullptr;
  return &answer->maps[std::size_t(index)];
}

}  // namespace sinew
