#include "app/widgets/retarget/rom_edit_panel.h"

#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "app/model/retarget/design_files.h"
#include "app/model/retarget/rom_handles.h"
#include "app/model/stage_text.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/theme.h"
#include "core/angle.h"

namespace sinew {
namespace {

constexpr const char* kSided[] = {"forward", "backward", "outward", "inward", "up", "down"};
constexpr const char* kMidline[] = {"forward", "backward", "right", "left", "up", "down"};

/// Whether a joint knows a tilt by this name.
bool knowsTilt(const Skeleton& skeleton, int joint, const std::string& towards) {
  try {
    tiltVector_J(skeleton, joint, {.towards = towards, .angle_rad = 0.1}, "tilt");
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// As tall as the field beside it, so that both stand on one line.
QLabel* rowLabel(const QString& text) {
  auto* label = makeLabel(text, "");
  label->setMinimumHeight(30);
  return label;
}

}  // namespace

RomEditPanel::RomEditPanel(DesignDocument& document, QWidget* parent) : QWidget{parent}, document_{document} {
  setObjectName("rom_edit_panel");
  joints_ = new QComboBox;
  joints_->setObjectName("rom_edit_joint");
  joints_->setAccessibleName(tr("Joint"));
  joints_->setToolTip(tr("Joint whose range is edited"));
  joints_->setMaxVisibleItems(20);
  cone_ =
      makeField("rom_cone", tr("Width of the cone"),
                tr("Angles between the bone's directions and the middle of their cone, over those before"), false);
  tilt_ = makeField("rom_tilt", tr("Tilt of the cone, degrees"),
                    tr("How far the middle of the cone turns towards the direction named beside"), true);
  tilt_->setRange(0, 180);
  towards_ = new QComboBox;
  towards_->setObjectName("rom_tilt_towards");
  towards_->setAccessibleName(tr("Direction of the tilt"));
  towards_->setToolTip(
      tr("Direction that the cone is tilted to, as the body stands; 'freely' keeps the direction of a drag"));
  twist_ = makeField("rom_twist", tr("Width of the twist range"),
                     tr("Width of the range of turns about the bone's own shaft, over that before"), false);
  twist_shift_ = makeField("rom_twist_shift", tr("Shift of the twist range, degrees"),
                           tr("How far that range moves; positive as the joint's coordinate about the shaft"), true);
  range_ =
      makeField("rom_range", tr("Width of the range"), tr("Width of the joint's range, over that before"), false);
  shift_ = makeField("rom_shift", tr("Shift of the range, degrees"),
                     tr("How far the range moves; positive as the joint's coordinate"), true);

  ball_box_ = new QWidget;
  auto* ball = new QFormLayout{ball_box_};
  ball->setContentsMargins(0, 0, 0, 0);
  ball->setVerticalSpacing(5);
  ball->addRow(rowLabel(tr("Cone, width")), cone_);
  ball->addRow(rowLabel(tr("Cone, tilt")), tilt_);
  ball->addRow(rowLabel(tr("   towards")), towards_);
  ball->addRow(rowLabel(tr("Twist, width")), twist_);
  ball->addRow(rowLabel(tr("Twist, shift")), twist_shift_);
  hinge_box_ = new QWidget;
  auto* hinge = new QFormLayout{hinge_box_};
  hinge->setContentsMargins(0, 0, 0, 0);
  hinge->setVerticalSpacing(5);
  hinge->addRow(rowLabel(tr("Range, width")), range_);
  hinge->addRow(rowLabel(tr("Range, shift")), shift_);
  axis_ = makeLabel({}, "small");
  axis_->setObjectName("rom_edit_hint");
  axis_->setWordWrap(true);

  auto* reset = makeButton("rom_reset_joint", tr("Reset joint"), "undo", tr("Take back all edits of this joint"));
  auto* reset_all = makeButton("rom_reset_all", tr("Reset all"), {}, tr("Take back the edits of all joints"));
  auto* load = makeButton("rom_load", tr("Load …"), "folder-open", tr("Read edits of ranges of motion from a file"));
  auto* save = makeButton("rom_save", tr("Save …"), "save", tr("Write the edits of ranges of motion into a file"));
  const auto line = [](QPushButton* a, QPushButton* b) {
    auto* row = new QHBoxLayout;
    row->setSpacing(6);
    row->addWidget(a, 1);
    row->addWidget(b, 1);
    return row;
  };
  edits_ = new QListWidget;
  edits_->setObjectName("rom_edit_list");
  edits_->setAccessibleName(tr("Edits"));
  edits_->setToolTip(tr("All edits, in the order in which they apply; click one to see its joint"));
  edits_->setWordWrap(true);
  edits_->setResizeMode(QListView::Adjust);
  edits_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(12, 10, 12, 10);
  column->setSpacing(7);
  column->addWidget(joints_);
  column->addWidget(ball_box_);
  column->addWidget(hinge_box_);
  column->addWidget(axis_);
  column->addLayout(line(reset, reset_all));
  column->addWidget(makeLabel(tr("Edits of this body"), "heading"));
  column->addWidget(edits_, 1);
  column->addLayout(line(load, save));

  connect(joints_, &QComboBox::currentIndexChanged, this, [this] {
    joint_ = joints_->currentData().toString().toStdString();
    refresh();
    emit jointChosen();
  });
  connect(cone_, &QDoubleSpinBox::valueChanged, this,
          [this](double v) { apply(tr("Width of the cone"), [v](RomEdit& e) { e.cone_factor = v; }); });
  connect(tilt_, &QDoubleSpinBox::valueChanged, this, &RomEditPanel::applyTilt);
  connect(towards_, &QComboBox::activated, this, &RomEditPanel::applyTilt);
  connect(twist_, &QDoubleSpinBox::valueChanged, this,
          [this](double v) { apply(tr("Width of the twist range"), [v](RomEdit& e) { e.twist_factor = v; }); });
  connect(twist_shift_, &QDoubleSpinBox::valueChanged, this, [this](double v) {
    apply(tr("Shift of the twist range"), [v](RomEdit& e) { e.twist_shift_rad = v * kRadPerDeg; });
  });
  connect(range_, &QDoubleSpinBox::valueChanged, this,
          [this](double v) { apply(tr("Width of the range"), [v](RomEdit& e) { e.range_factor = v; }); });
  connect(shift_, &QDoubleSpinBox::valueChanged, this,
          [this](double v) { apply(tr("Shift of the range"), [v](RomEdit& e) { e.shift_rad = v * kRadPerDeg; }); });
  connect(reset, &QPushButton::clicked, this, [this] {
    document_.edit(tr("Reset the range of %1").arg(readableName(joint_)), [this](RetargetDesign& d) {
      std::erase_if(d.rom, [this](const RomEdit& e) { return e.joint == joint_; });
    });
  });
  connect(reset_all, &QPushButton::clicked, this,
          [this] { document_.edit(tr("Reset all ranges"), [](RetargetDesign& d) { d.rom.clear(); }); });
  connect(load, &QPushButton::clicked, this, &RomEditPanel::loadFile);
  connect(save, &QPushButton::clicked, this, &RomEditPanel::saveFile);
  connect(edits_, &QListWidget::itemClicked, this,
          [this](QListWidgetItem* item) { chooseJoint(item->data(Qt::UserRole).toString().toStdString()); });
  connect(&document_, &DesignDocument::changed, this, &RomEditPanel::refresh);
  connect(&document_, &DesignDocument::previewed, this, &RomEditPanel::refresh);
  connect(&document_, &DesignDocument::rejected, this, &RomEditPanel::refresh);
}

QDoubleSpinBox* RomEditPanel::makeField(const QString& object_name, const QString& spoken, const QString& tip,
                                        bool is_angle) {
  auto* field = new PatientSpinBox;
  field->setObjectName(object_name);
  field->setAccessibleName(spoken);
  field->setToolTip(tip);
  field->setKeyboardTracking(false);
  field->setDecimals(is_angle ? 1 : 2);
  field->setSingleStep(is_angle ? 5 : 0.05);
  field->setRange(is_angle ? -180 : kLeastRomFactor, is_angle ? 180 : kMostRomFactor);
  field->setValue(is_angle ? 0 : 1);
  if (is_angle)
    field->setSuffix(QStringLiteral("°"));
  else
    field->setPrefix(QStringLiteral("× "));
  return field;
}

void RomEditPanel::setSkeleton(std::shared_ptr<const Model> model) {
  const bool first = !model_;
  model_ = std::move(model);
  if (!first) return;
  {
    const QSignalBlocker block{joints_};
    for (const auto& name : editableJoints(model_->skeleton))
      joints_->addItem(readableName(name), QString::fromStdString(name));
  }
  chooseJoint("hip_r");
}

void RomEditPanel::chooseJoint(const std::string& joint) {
  const int index = joints_->findData(QString::fromStdString(joint));
  if (index == joints_->currentIndex() && joint == joint_) return;
  if (index == joints_->currentIndex())
    emit joints_->currentIndexChanged(index);
  else
    joints_->setCurrentIndex(index);
}

bool RomEditPanel::isBall() const {
  return model_ && !joint_.empty() &&
         model_->skeleton.joints[std::size_t(model_->skeleton.jointIndex(joint_))].type == JointType::Ball;
}

void RomEditPanel::apply(const QString& label, const std::function<void(RomEdit&)>& change) {
  document_.edit(tr("%1: %2").arg(readableName(joint_), label.toLower()), [&](RetargetDesign& d) {
    change(editOf(d.rom, joint_));
    dropIdentities(d.rom);
    checkRomEdits(model_->skeleton, d.rom, "range of motion");
  });
}

void RomEditPanel::applyTilt() {
  const double angle_rad = tilt_->value() * kRadPerDeg;
  const std::string towards = towards_->currentData().toString().toStdString();
  apply(tr("Tilt of the cone"), [&](RomEdit& e) {
    const bool has_axis = e.tilt.axis_J != std::array<double, 3>{0, 0, 0};
    if (!towards.empty() || !has_axis) e.tilt = {.towards = towards.empty() ? "forward" : towards};
    e.tilt.angle_rad = angle_rad;
  });
}

void RomEditPanel::loadFile() {
  if (!model_) return;
  const auto file = askForFile(this, tr("Edits of ranges of motion"), tr("Edits of ranges (*.json)"));
  if (file.empty()) return;
  try {
    const RomEdits edits = loadRanges(file, model_->skeleton);
    document_.edit(tr("Load ranges"), [&](RetargetDesign& d) { d.rom = edits; });
  } catch (const InputError& error) {
    emit problem(QString::fromUtf8(error.what()));
  }
}

void RomEditPanel::saveFile() {
  const auto file =
      askForNewFile(this, tr("Edits of ranges of motion"), "ranges.json", tr("Edits of ranges (*.json)"));
  if (file.empty()) return;
  try {
    saveRanges(document_.current().rom, file);
    emit notice(tr("Saved: %1").arg(QString::fromStdString(file.filename().string())));
  } catch (const InputError& error) {
    emit problem(QString::fromUtf8(error.what()));
  }
}

void RomEditPanel::refresh() {
  if (!model_ || joint_.empty()) return;
  const bool ball = isBall();
  ball_box_->setVisible(ball);
  hinge_box_->setVisible(!ball);
  axis_->setText(ball ? tr("On the sphere: drag the ball in the middle of the green circle to tilt the cone, the one "
                           "on it to widen it.")
                      : tr("Drag the ends of the bar, or the piece between."));
  const RomEdit* found = findEdit(document_.current().rom, joint_);
  const RomEdit edit = found ? *found : RomEdit{.joint = joint_};
  const auto set = [](QDoubleSpinBox* field, double value) {
    const QSignalBlocker block{field};
    field->setValue(value);
  };
  set(cone_, edit.cone_factor);
  set(tilt_, edit.tilt.angle_rad / kRadPerDeg);
  set(twist_, edit.twist_factor);
  set(twist_shift_, edit.twist_shift_rad / kRadPerDeg);
  set(range_, edit.range_factor);
  set(shift_, edit.shift_rad / kRadPerDeg);
  {
    const QSignalBlocker block{towards_};
    towards_->clear();
    if (ball) {
      const int joint = model_->skeleton.jointIndex(joint_);
      const bool sided = joint_.ends_with("_r") || joint_.ends_with("_l");
      for (const char* name : sided ? kSided : kMidline)
        if (knowsTilt(model_->skeleton, joint, name)) towards_->addItem(readableName(name).toLower(), QString{name});
    }
    const QString towards = QString::fromStdString(edit.tilt.towards);
    if (edit.tilt.angle_rad != 0 && towards.isEmpty()) {
      towards_->addItem(tr("freely, as dragged"), QString{});
      towards_->setCurrentIndex(towards_->count() - 1);
    } else if (!towards.isEmpty()) {
      if (towards_->findData(towards) < 0) towards_->addItem(towards, towards);
      towards_->setCurrentIndex(towards_->findData(towards));
    }
  }
  const RomEdits& all = document_.current().rom;
  edits_->clear();
  for (const RomEdit& e : all) {
    QString words = QString::fromStdString(inWords(e)).section(": ", 1);
    words.replace(" x ", QStringLiteral(" × ")).replace(" deg", QStringLiteral("°"));
    auto* item = new QListWidgetItem{readableName(e.joint) + ": " + words};
    item->setData(Qt::UserRole, QString::fromStdString(e.joint));
    edits_->addItem(item);
  }
}

}  // namespace sinew
