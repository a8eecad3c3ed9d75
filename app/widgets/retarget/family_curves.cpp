#include "app/widgets/retarget/family_curves.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "app/model/explorer/muscle_text.h"
#include "app/model/stage_text.h"
#include "app/widgets/controls/curve_plot.h"
#include "app/widgets/controls/theme.h"
#include "core/posture/evaluate.h"
#include "core/posture/muscle_role.h"
#include "core/retarget/prepared/reference.h"
#include "core/skeleton/motion_words.h"

namespace sinew {
namespace {

using Points = std::vector<std::pair<double, double>>;

CurvePlot* makePlot(const QString& object_name, const QString& spoken) {
  auto* plot = new CurvePlot;
  plot->setObjectName(object_name);
  plot->setAccessibleName(spoken);
  plot->setMinimumHeight(168);
  return plot;
}

Points overAngle(const MotionCurve& curve, const std::vector<double>& y, double scale) {
  Points points;
  for (std::size_t i = 0; i < y.size(); ++i) points.emplace_back(curve.angle_deg[i], scale * y[i]);
  return points;
}

}  // namespace

FamilyCurves::FamilyCurves(QWidget* parent) : QWidget{parent} {
  setObjectName("family_curves");
  title_ = makeLabel({}, "heading");
  title_->setObjectName("family_title");
  title_->setWordWrap(true);
  motion_ = new QComboBox;
  motion_->setObjectName("family_motion");
  motion_->setAccessibleName(tr("Joint motion"));
  motion_->setToolTip(tr("Joint motion that the curves go over"));
  motion_->setMaxVisibleItems(20);
  motion_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  length_ = makePlot("family_length", tr("Length over the joint motion"));
  arm_ = makePlot("family_arm", tr("Moment arm over the joint motion"));
  torque_ = makePlot("family_torque", tr("Torque over the joint motion"));
  auto* all = new QWidget;
  auto* inner = new QVBoxLayout{all};
  inner->setContentsMargins(0, 0, 6, 0);
  inner->setSpacing(2);
  for (auto* plot : {length_, arm_, torque_}) inner->addWidget(plot);
  auto* scroll = new QScrollArea;
  scroll->setWidget(all);
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(12, 10, 2, 4);
  column->setSpacing(6);
  column->addWidget(title_);
  auto* indented = new QHBoxLayout;
  indented->setContentsMargins(0, 0, 10, 0);
  indented->addWidget(motion_);
  column->addLayout(indented);
  column->addWidget(scroll, 1);
  connect(motion_, &QComboBox::currentIndexChanged, this, &FamilyCurves::draw);
}

void FamilyCurves::show(std::shared_ptr<const RetargetReference> reference, std::shared_ptr<const Model> naive,
                        std::shared_ptr<const SolvedBody> body, const std::string& unit) {
  const bool first = reference != reference_;
  reference_ = std::move(reference);
  naive_ = std::move(naive);
  body_ = std::move(body);
  unit_ = unit;
  if (first) fillMotions();
  draw();
}

void FamilyCurves::fillMotions() {
  const QSignalBlocker block{motion_};
  motion_->clear();
  motion_->addItem(tr("Motion that shortens it most"));
  if (reference_)
    for (const auto& motion : reference_->motions()) motion_->addItem(motionTitle(motion));
}

const JointMotion* FamilyCurves::chosenMotion() const {
  const auto& motions = reference_->motions();
  if (const int index = motion_->currentIndex() - 1; index >= 0) return &motions[std::size_t(index)];
  const Model& model = reference_->model();
  const auto functions = muscleFunctions(model.skeleton, model.musculature.unit(unit_), motions);
  return functions.empty() ? nullptr : functions.front().motion;
}

void FamilyCurves::draw() {
  title_->setText(unit_.empty() ? tr("No muscle chosen") : readableName(unit_));
  const auto nothing = [&](const QString& why) {
    for (auto* plot : {length_, arm_, torque_}) plot->setNothing(why);
  };
  if (!reference_ || unit_.empty())
    return nothing(tr("Click a muscle in the model or in the list below to compare it with the reference."));
  const JointMotion* motion = chosenMotion();
  if (!motion) return nothing(tr("No joint motion of the table shortens this muscle."));

  constexpr int kSamples = 49;
  struct Body {
    QString name;
    const Model* model;
    LineRole role;
  };
  std::vector<Body> bodies{{tr("reference"), &reference_->model(), LineRole::Before}};
  const bool is_reference = naive_ && naive_->shape == reference_->model().shape;
  // A naive body that has its masses and strengths, if there is one: torques then compare with the retargeted.
  if (body_ && !is_reference)
    bodies.push_back({tr("naive"), body_->naive.get(), LineRole::Second});
  else if (naive_ && !is_reference)
    bodies.push_back({tr("naive"), naive_.get(), LineRole::Second});
  if (body_)
    bodies.push_back({is_reference ? tr("this body") : tr("retargeted"), body_->model.get(), LineRole::First});
  const auto panel = [](const QString& y_label) { return FigurePanel{y_label.toStdString()}; };
  FigurePanel length = panel(tr("length, % of that at the start")), arm = panel(tr("moment arm, mm")),
              torque = panel(tr("torque at full activation, N m"));
  arm.from_zero = torque.from_zero = true;
  for (const Body& body : bodies) {
    const MotionCurve curve =
        motionCurve(body.model->skeleton, body.model->musculature.unit(unit_), *motion, kSamples);
    const double middle = curve.length_m[0] > 0 ? 100 / curve.length_m[0] : 0;
    length.curves.push_back({body.name.toStdString(), overAngle(curve, curve.length_m, middle), body.role});
    arm.curves.push_back({{}, overAngle(curve, curve.moment_arm_m, 1000), body.role});
    torque.curves.push_back({{}, overAngle(curve, curve.full_torque_Nm, 1), body.role});
  }
  const QString x_title = tr("%1, degrees").arg(QString::fromStdString(motionWords(motion->coordinate, true)));
  length_->setPanel(std::move(length), x_title);
  arm_->setPanel(std::move(arm), x_title);
  torque_->setPanel(std::move(torque), x_title);
}

}  // namespace sinew
