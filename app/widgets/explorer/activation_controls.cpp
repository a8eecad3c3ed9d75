#include "app/widgets/explorer/activation_controls.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QVBoxLayout>
#include <algorithm>

#include "app/model/explorer/explorer.h"
#include "app/model/explorer/muscle_text.h"
#include "app/model/stage_text.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/theme.h"

namespace sinew {
namespace {
constexpr int kChosen = 0, kGroup = 1, kFirstMotion = 2;
}

ActivationControls::ActivationControls(Explorer& explorer, QWidget* parent) : QWidget{parent}, explorer_{explorer} {
  setObjectName("activation_controls");
  target_ = new QComboBox;
  target_->setObjectName("activation_target");
  target_->setAccessibleName(tr("Muscles to activate"));
  target_->setMaxVisibleItems(20);
  target_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  slider_ = new QSlider{Qt::Horizontal};
  slider_->setObjectName("activation_slider");
  slider_->setAccessibleName(tr("Activation, percent"));
  slider_->setRange(0, 100);
  slider_->setPageStep(10);
  percent_ = makeLabel("0 %", "");
  percent_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  percent_->setFixedWidth(44);
  effect_ = makeLabel({}, "small");
  effect_->setObjectName("activation_effect");
  effect_->setWordWrap(true);
  auto* relax = makeButton("relax_all", tr("Relax all"), {}, tr("No muscle active"));

  auto* line = new QHBoxLayout;
  line->setSpacing(6);
  line->addWidget(slider_, 1);
  line->addWidget(percent_);
  auto* last = new QHBoxLayout;
  last->addWidget(effect_, 1);
  last->addWidget(relax, 0, Qt::AlignTop);
  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(0, 4, 0, 0);
  column->setSpacing(4);
  column->addWidget(makeLabel(tr("ACTIVATE"), "caption"));
  column->addWidget(target_);
  column->addLayout(line);
  column->addLayout(last);

  connect(target_, &QComboBox::currentIndexChanged, this, [this] { describe(); });
  connect(slider_, &QSlider::valueChanged, this, &ActivationControls::apply);
  connect(relax, &QPushButton::clicked, &explorer_, &Explorer::relaxAll);
  connect(&explorer_, &Explorer::modelChanged, this, &ActivationControls::fill);
  for (const auto signal : {&Explorer::muscleChanged, &Explorer::postureChanged, &Explorer::coloursChanged})
    connect(&explorer_, signal, this, &ActivationControls::describe);
}

void ActivationControls::fill() {
  const QSignalBlocker block{target_};
  target_->clear();
  target_->addItem(tr("The chosen muscle"));
  target_->addItem(tr("The chosen muscle's group"));
  for (const auto& motion : explorer_.motions())
    target_->addItem(tr("All for %1").arg(motionTitle(motion).toLower()));
  describe();
}

const JointMotion* ActivationControls::motion() const {
  const int index = target_->currentIndex() - kFirstMotion;
  return index >= 0 && index < int(explorer_.motions().size()) ? &explorer_.motions()[std::size_t(index)] : nullptr;
}

std::vector<int> ActivationControls::targets() const {
  if (!explorer_.model()) return {};
  if (const JointMotion* wanted = motion()) return explorer_.agonistsOf(*wanted);
  const int chosen = explorer_.muscleIndex();
  if (chosen < 0) return {};
  return target_->currentIndex() == kGroup ? explorer_.groupOf(chosen) : std::vector<int>{chosen};
}

void ActivationControls::apply() {
  const auto units = targets();
  if (units.empty()) return;
  explorer_.setActivation(units, slider_->value() / 100.0);  // first: every answer shows the slider's value anew
  explorer_.setColouring(MuscleColouring::Activation);
}

void ActivationControls::describe() {
  if (!explorer_.model()) return;
  const auto units = targets();
  slider_->setEnabled(!units.empty());
  const auto& activation = explorer_.activation();
  double highest = 0;
  for (const int i : units) highest = std::max(highest, activation[std::size_t(i)]);
  const QSignalBlocker block{slider_};
  slider_->setValue(int(std::lround(100 * highest)));
  percent_->setText(tr("%1 %").arg(slider_->value()));
  const auto active = std::ranges::count_if(activation, [](double a) { return a > 0; });
  QString text = units.empty() ? tr("Choose a muscle, or a motion.")
                               : tr("%1 of %2 units active.").arg(active).arg(activation.size());
  if (const JointMotion* wanted = motion(); wanted && active > 0) {
    const int coordinate = explorer_.model()->skeleton.coordinateIndex(wanted->coordinate);
    const double sign = wanted->end_deg > wanted->start_deg ? 1 : -1;
    text += ' ' + tr("They turn with %1 N m.").arg(figure(sign * explorer_.torque_Nm(coordinate), 0));
  }
  effect_->setText(text);
}

}  // namespace sinew
