#include "app/widgets/explorer/muscle_curves.h"

#include <QComboBox>
#include <QLabel>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "app/model/explorer/explorer.h"
#include "app/model/explorer/muscle_text.h"
#include "app/model/stage_text.h"
#include "app/widgets/controls/curve_plot.h"
#include "app/widgets/controls/theme.h"
#include "core/angle.h"
#include "core/muscle/hill.h"
#include "core/posture/muscle_role.h"
#include "core/skeleton/motion_words.h"

namespace sinew {
namespace {

template <class Curve>
std::vector<std::pair<double, double>> sampled(const Curve& curve) {
  constexpr int kSamples = 90;
  constexpr double kFrom = 0.3, kTo = 1.75;
  std::vector<std::pair<double, double>> points;
  for (int i = 0; i <= kSamples; ++i) {
    const double l = kFrom + (kTo - kFrom) * i / kSamples;
    points.emplace_back(l, curve(l).value);
  }
  return points;
}

std::vector<std::pair<double, double>> overAngle(const MotionCurve& curve, const std::vector<double>& y,
                                                 double scale) {
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < y.size(); ++i) points.emplace_back(curve.angle_deg[i], scale * y[i]);
  return points;
}

std::string text(const QString& words) {
  return words.toStdString();
}

CurvePlot* makePlot(const QString& object_name) {
  auto* plot = new CurvePlot;
  plot->setObjectName(object_name);
  plot->setMinimumHeight(166);
  return plot;
}

}  // namespace

MuscleCurves::MuscleCurves(Explorer& explorer, QWidget* parent) : QWidget{parent}, explorer_{explorer} {
  setObjectName("muscle_curves");
  title_ = makeLabel({}, "heading");
  title_->setWordWrap(true);
  motion_ = new QComboBox;
  motion_->setObjectName("curve_motion");
  motion_->setAccessibleName(tr("Joint motion"));
  motion_->setMaxVisibleItems(20);
  motion_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  force_ = makePlot("force_length_plot");
  length_ = makePlot("length_angle_plot");
  arm_ = makePlot("moment_arm_plot");
  auto* all = new QWidget;
  auto* inner = new QVBoxLayout{all};
  inner->setContentsMargins(0, 0, 8, 0);
  inner->setSpacing(4);
  inner->addWidget(force_);
  inner->addWidget(motion_);
  inner->addWidget(length_);
  inner->addWidget(arm_);
  auto* scroll = new QScrollArea;
  scroll->setWidget(all);
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(14, 12, 2, 6);
  column->setSpacing(6);
  column->addWidget(title_);
  column->addWidget(scroll, 1);
  connect(motion_, &QComboBox::currentIndexChanged, this, &MuscleCurves::showMotion);
}

void MuscleCurves::fillMotions() {
  if (filled_for_ == explorer_.model().get() && motion_->count() > 0) return;
  filled_for_ = explorer_.model().get();
  curve_key_.clear();
  const QSignalBlocker block{motion_};
  motion_->clear();
  motion_->addItem(tr("Motion that shortens it most"));
  for (const auto& motion : explorer_.motions()) motion_->addItem(motionTitle(motion));
}

void MuscleCurves::refresh() {
  const int unit = explorer_.muscleIndex();
  if (explorer_.model()) fillMotions();
  title_->setText(unit < 0 ? tr("No muscle chosen")
                           : readableName(explorer_.model()->musculature.units[std::size_t(unit)].name));
  const QString hint = tr("Click a muscle in the model, or find it in the list.");
  if (unit < 0) {
    for (auto* plot : {force_, length_, arm_}) plot->setNothing(hint);
    return;
  }
  showForceLength(unit);
  showMotion();
}

void MuscleCurves::showForceLength(int unit) {
  const HillCurves curves{explorer_.model()->musculature.units[std::size_t(unit)].curves};
  const double ratio = explorer_.evaluation().normalized_fiber_length[unit];
  FigurePanel panel{text(tr("force / maximal force")),
                    {{text(tr("active")), sampled([&](double l) { return curves.active(l); })},
                     {text(tr("passive")), sampled([&](double l) { return curves.passive(l); }), LineRole::Alarm}},
                    {{text(tr("now %1").arg(figure(ratio, 2))), ratio}}};
  panel.from_zero = true;
  panel.highest = 1.25;
  force_->setPanel(std::move(panel), tr("fibre length / optimal"));
}

void MuscleCurves::showMotion() {
  const int unit = explorer_.muscleIndex();
  if (unit < 0) return;
  const Model& model = *explorer_.model();
  const auto& u = model.musculature.units[std::size_t(unit)];
  const JointMotion* motion = nullptr;
  if (const int index = motion_->currentIndex() - 1; index >= 0) {
    motion = &explorer_.motions()[std::size_t(index)];
  } else if (const auto functions = muscleFunctions(model.skeleton, u, explorer_.motions()); !functions.empty()) {
    motion = functions.front().motion;
  }
  if (!motion) {
    const QString none = tr("No joint motion of the table shortens this muscle.");
    length_->setNothing(none);
    arm_->setNothing(none);
    return;
  }
  if (const std::string key = u.name + ' ' + motion->name; key != curve_key_) {
    constexpr int kSamples = 61;
    curve_ = motionCurve(model.skeleton, u, *motion, kSamples);
    curve_key_ = key;
  }
  const double now_deg = explorer_.clinical()[model.skeleton.coordinateIndex(motion->coordinate)] / kRadPerDeg;
  const double low = std::min(motion->start_deg, motion->end_deg),
               high = std::max(motion->start_deg, motion->end_deg);
  std::vector<FigureMark> now;
  if (now_deg >= low && now_deg <= high) now.push_back({text(tr("now %1°").arg(figure(now_deg, 0))), now_deg});
  const QString x_title = tr("%1, degrees").arg(QString::fromStdString(motionWords(motion->coordinate, true)));
  auto limit = now;
  limit.push_back({text(tr("longest")), 1000 * longestLength_m(u), LineRole::Alarm, true});
  length_->setPanel(
      {text(tr("length of the path, mm")), {{{}, overAngle(curve_, curve_.length_m, 1000)}}, std::move(limit)},
      x_title);
  FigurePanel arm{text(tr("moment arm, mm")), {{{}, overAngle(curve_, curve_.moment_arm_m, 1000)}}, std::move(now)};
  arm.from_zero = true;
  arm_->setPanel(std::move(arm), x_title);
}

}  // namespace sinew
