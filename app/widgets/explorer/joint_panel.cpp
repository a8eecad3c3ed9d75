#include "app/widgets/explorer/joint_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <QWheelEvent>
#include <cmath>

#include "app/model/explorer/explorer.h"
#include "app/model/explorer/muscle_text.h"
#include "app/model/stage_text.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/range_slider.h"
#include "app/widgets/controls/theme.h"
#include "core/angle.h"
#include "core/skeleton/motion_words.h"

namespace sinew {
namespace {

/// "knee flexion" of the knee -> "Flexion": the joint stands above.
QString shortWords(const QString& words, const QString& joint_words) {
  QString text = words;
  if (text.startsWith(joint_words + ' ')) text.remove(0, joint_words.size() + 1);
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text;
}

/// What the words of all three coordinates of a joint begin with: "knee", "lumbar", "shoulder girdle".
QString commonWords(const QString& a, const QString& b) {
  QStringList first = a.split(' '), second = b.split(' '), common;
  for (int i = 0; i < std::min(first.size(), second.size()) && first[i] == second[i]; ++i) common << first[i];
  return common.join(' ');
}

}  // namespace

JointPanel::JointPanel(Explorer& explorer, QWidget* parent) : QWidget{parent}, explorer_{explorer} {
  setObjectName("joint_panel");
  presets_ = new QComboBox;
  presets_->setObjectName("preset_posture");
  presets_->setAccessibleName(tr("Preset posture"));
  auto* reset = makeButton("reset_posture", tr("Stand"), {}, tr("All coordinates to zero: standing"));
  auto* mirror = makeButton("mirror_posture", tr("Mirror"), {}, tr("Exchange left and right"));
  linked_ = new QCheckBox{tr("Both sides move together")};
  linked_->setObjectName("link_sides");
  joints_ = new QComboBox;
  joints_->setObjectName("go_to_joint");
  joints_->setAccessibleName(tr("Go to joint"));
  joints_->setToolTip(tr("Go to a joint in the list below"));
  scroll_ = new QScrollArea;
  scroll_->setObjectName("joint_scroll");
  scroll_->setWidgetResizable(true);
  scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);

  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(6);
  buttons->addWidget(presets_, 1);
  buttons->addWidget(reset);
  auto* second = new QHBoxLayout;
  second->setSpacing(6);
  second->addWidget(linked_, 1);
  second->addWidget(mirror);
  auto* legend = makeLabel(tr("<span style='color:#9fb0bf'>▬</span> envelope  "
                              "<span style='color:#8fcaa5'>■</span> normal  "
                              "<span style='color:#0b6b8c'>▬</span> as far as examined"),
                           "small");
  legend->setToolTip(tr(
      "Envelope: as far as bones and ligaments of this body go. Normal: adult norm. As far as "
      "examined: to where muscles, capsule and ligaments set the examiner's moment for a body of this mass against "
      "the movement, or a muscle reaches its longest length; all other joints held."));
  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(10, 10, 2, 8);
  column->setSpacing(6);
  column->addLayout(buttons);
  column->addLayout(second);
  column->addWidget(joints_);
  column->addWidget(legend);
  column->addWidget(scroll_, 1);

  connect(presets_, &QComboBox::activated, this, [this](int index) {
    const auto& presets = explorer_.presets();
    if (index >= 1 && index <= int(presets.size())) explorer_.setPosture(presets[std::size_t(index - 1)].posture);
    presets_->setCurrentIndex(0);
  });
  connect(reset, &QPushButton::clicked, this, [this] {
    if (explorer_.model()) explorer_.setPosture(zeroPosture(explorer_.model()->skeleton));
  });
  connect(mirror, &QPushButton::clicked, this, [this] {
    if (explorer_.model()) explorer_.mirror();
  });
  connect(linked_, &QCheckBox::toggled, &explorer_, &Explorer::setSidesLinked);
  connect(joints_, &QComboBox::activated, this,
          [this](int index) { scroll_->verticalScrollBar()->setValue(sections_[std::size_t(index)]->y()); });
  connect(&explorer_, &Explorer::modelChanged, this, &JointPanel::build);
  connect(&explorer_, &Explorer::postureChanged, this, &JointPanel::showPosture);
  connect(&explorer_, &Explorer::rangesChanged, this, &JointPanel::showRanges);
}

void JointPanel::build() {
  rows_.clear();
  sections_.clear();
  presets_->clear();
  joints_->clear();
  presets_->addItem(tr("Take a posture …"));
  for (const auto& preset : explorer_.presets()) presets_->addItem(QString::fromStdString(preset.name));
  const auto& joints = explorer_.model()->skeleton.joints;
  auto* all = new QWidget;
  auto* column = new QVBoxLayout{all};
  column->setContentsMargins(0, 0, 8, 0);
  column->setSpacing(10);
  const auto add = [&](int joint) {
    sections_.push_back(makeJoint(joint));
    column->addWidget(sections_.back());
    joints_->addItem(joint == 0 ? tr("Whole body") : readableName(joints[std::size_t(joint)].name));
  };
  for (int joint = 1; joint < int(joints.size()); ++joint) add(joint);
  add(0);  // where the body stands says least: last
  column->addStretch();
  scroll_->setWidget(all);
}

QWidget* JointPanel::makeJoint(int joint) {
  const Joint& j = explorer_.model()->skeleton.joints[std::size_t(joint)];
  auto* section = new QWidget;
  auto* column = new QVBoxLayout{section};
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  column->addWidget(makeLabel(joint == 0 ? tr("Whole body") : readableName(j.name), "heading"));
  for (int i = 0; i < j.coordinate_count; ++i) column->addWidget(makeRow(j.first_coordinate + i));
  return section;
}

QWidget* JointPanel::makeRow(int coordinate) {
  const Coordinate& c = explorer_.model()->skeleton.coordinates[std::size_t(coordinate)];
  const QString name = QString::fromStdString(c.name);
  const double scale = c.translational ? 1 : 1 / kRadPerDeg;
  const QString unit = c.translational ? tr(" m") : QStringLiteral("°");
  const QString more = QString::fromStdString(motionWords(c.name, true)),
                less = QString::fromStdString(motionWords(c.name, false));
  const QString common = commonWords(more, less);

  auto* title = makeLabel(shortWords(more, common), "");
  title->setToolTip(tr("%1: positive is %2, negative is %3").arg(name, more, less));
  auto* value = new PatientSpinBox;
  value->setObjectName("value_" + name);
  value->setAccessibleName(readableName(c.name));
  value->setKeyboardTracking(false);
  value->setDecimals(c.translational ? 2 : 1);
  value->setSingleStep(c.translational ? 0.05 : 1);
  value->setRange(c.translational ? -10 : -180,
                  c.translational ? 10 : 180);  // beyond the envelope too: it then says so
  value->setSuffix(unit);
  value->setFixedWidth(82);
  auto* slider = new RangeSlider;
  slider->setObjectName("slider_" + name);
  slider->setAccessibleName(readableName(c.name));
  slider->setRange(int(std::lround(10 * c.stop_min_rad * scale)), int(std::lround(10 * c.stop_max_rad * scale)));
  slider->setBand(int(std::lround(10 * c.normal_min_rad * scale)), int(std::lround(10 * c.normal_max_rad * scale)));
  if (c.translational) {
    slider->setBand(0, 0);
    slider->setSingleStep(1);
    slider->setPageStep(5);
  }
  const auto end = [&](const QString& words, double figure_rad) {
    return shortWords(words, common).toLower() + ' ' + figure(std::abs(figure_rad) * scale, 0) + unit;
  };
  slider->setEnds(end(less, c.stop_min_rad), end(more, c.stop_max_rad));
  slider->setToolTip(tr("%1\nNormal %2 to %3%4, envelope %5 to %6%4")
                         .arg(more, figure(c.normal_min_rad * scale, 0), figure(c.normal_max_rad * scale, 0), unit,
                              figure(c.stop_min_rad * scale, 0), figure(c.stop_max_rad * scale, 0)));
  auto* range = makeLabel({}, "small");
  range->setObjectName("range_" + name);
  range->setWordWrap(true);
  range->setVisible(c.joint != 0);

  auto* box = new QWidget;
  auto* head = new QHBoxLayout;
  head->addWidget(title, 1);
  head->addWidget(value);
  auto* column = new QVBoxLayout{box};
  column->setContentsMargins(0, 0, 0, 4);
  column->setSpacing(1);
  column->addLayout(head);
  column->addWidget(slider);
  column->addWidget(range);

  connect(slider, &RangeSlider::valueChanged, this,
          [this, coordinate, scale](int tenths) { explorer_.setCoordinate(coordinate, tenths / (10 * scale)); });
  connect(value, &QDoubleSpinBox::valueChanged, this,
          [this, coordinate, scale](double shown) { explorer_.setCoordinate(coordinate, shown / scale); });
  rows_.push_back({coordinate, scale, slider, value, range});
  return box;
}

/// What relaxed muscles and the joint's structures set against a turn at this posture.
QString JointPanel::passiveText(int coordinate) const {
  const PostureEvaluation& e = explorer_.evaluation();
  const double structures_Nm = e.structure_torque[coordinate];
  return tr("Passive moment: relaxed muscles %1 N m, capsule and ligaments %2 N m (positive: towards larger values)")
      .arg(figure(e.passive_torque[coordinate] - structures_Nm, 1), figure(structures_Nm, 1));
}

void JointPanel::showPosture() {
  for (const Row& row : rows_) {
    if (explorer_.model()->skeleton.coordinates[std::size_t(row.coordinate)].joint != 0)
      row.value->setToolTip(passiveText(row.coordinate));
    const double shown = explorer_.clinical()[row.coordinate] * row.scale;
    const QSignalBlocker block_slider{row.slider}, block_value{row.value};
    if (!row.slider->isSliderDown()) row.slider->setValue(int(std::lround(10 * shown)));
    row.value->setValue(shown);
    row.slider->update();
  }
}

void JointPanel::showRanges() {
  const Model& model = *explorer_.model();
  for (const Row& row : rows_) {
    const auto range = explorer_.range(row.coordinate);
    if (!range) continue;
    const auto tenths = [&](double rad) { return int(std::lround(10 * rad * row.scale)); };
    row.slider->setFree(range->isEmpty() ? std::pair{1, 0}
                                         : std::pair{tenths(range->low_rad), tenths(range->high_rad)});
    row.range->setText(rangeText(model, model.skeleton.coordinates[std::size_t(row.coordinate)], *range));
  }
}

}  // namespace sinew
