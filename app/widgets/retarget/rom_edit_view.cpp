#include "app/widgets/retarget/rom_edit_view.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QStackedWidget>
#include <QTableWidget>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>

#include "app/model/stage_text.h"
#include "app/scene/rom_patch.h"
#include "app/widgets/controls/colour_bar.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/range_bar.h"
#include "app/widgets/controls/theme.h"
#include "app/widgets/retarget/rom_edit_panel.h"
#include "app/widgets/views/edit_sphere.h"
#include "core/angle.h"

namespace sinew {
namespace {

constexpr int kFrame_ms = 15;

RangeBar::Range inDegrees(double low_rad, double high_rad) {
  return {low_rad / kRadPerDeg, high_rad / kRadPerDeg};
}

/// "zero" -> "as standing", "hip_flexion_r=90" -> "with hip flexion 90°".
QString heldInWords(const std::string& held) {
  if (held == "zero") return QObject::tr("as standing");
  QString words = QString::fromStdString(held);
  words.replace("_r=", " ").replace("_l=", " ").replace('=', ' ').replace('_', ' ');
  return QObject::tr("with %1°").arg(words);
}

}  // namespace

RomEditView::RomEditView(DesignDocument& document, RomEditPanel& panel, QWidget* parent)
    : QWidget{parent}, document_{document}, panel_{panel} {
  setObjectName("rom_edit_view");
  title_ = makeLabel({}, "heading");
  title_->setObjectName("rom_edit_title");
  error_ = makeLabel({}, "");
  error_->setObjectName("rom_edit_error");
  error_->setWordWrap(true);
  kinds_ = new QStackedWidget;
  kinds_->addWidget(makeSpheres());
  kinds_->addWidget(makeHinge());
  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(6);
  column->addWidget(title_);
  column->addWidget(kinds_, 1);
  column->addWidget(error_);
  column->addWidget(makeChanges());
  rows_ = column;

  soon_ = new QTimer{this};
  soon_->setSingleShot(true);
  soon_->setInterval(kFrame_ms);
  connect(soon_, &QTimer::timeout, this, &RomEditView::ask);
  connect(&study_, &RomEditStudy::answered, this, &RomEditView::showPicture);
  connect(&study_, &RomEditStudy::failed, error_, &QLabel::setText);
  connect(&panel_, &RomEditPanel::jointChosen, this, &RomEditView::askSoon);
  for (const auto signal : {&DesignDocument::changed, &DesignDocument::previewed})
    connect(&document_, signal, this, [this] {
      showCone();
      showTwist();
      showHinge();
      askSoon();
    });
}

QWidget* RomEditView::makeSpheres() {
  auto* box = new QWidget;
  wanted_ = new EditSphere{"rom_wanted"};
  before_ = new RomSphereView{"rom_before"};
  reached_ = new RomSphereView{"rom_reached"};
  wanted_->setCaption(tr("Wanted: drag the green balls. Blue line: before"));
  before_->setCaption(tr("Before"));
  reached_->setCaption(tr("Reached"));
  before_->turnWith(*wanted_);
  reached_->turnWith(*wanted_);
  twist_ = new RangeBar{"rom_twist_bar"};
  twist_->setAccessibleName(tr("Range of the twist"));
  twist_->setToolTip(
      tr("Range of turns about the bone's own shaft, over all directions: drag an end, or the piece between. Grey "
         "line: before"));
  twist_->setScale(-180, 180);
  bar_ = new ColourBar{ColourBar::Ground::Light};
  bar_->setToolTip(tr("How far the bone can turn about its own shaft when it points there"));
  auto* small = new QVBoxLayout;
  small->setSpacing(6);
  small->addWidget(before_, 1);
  small->addWidget(reached_, 1);
  auto* spheres = new QHBoxLayout;
  spheres->setSpacing(10);
  auto* left = new QVBoxLayout;
  left->setSpacing(4);
  left->addWidget(wanted_, 1);
  left->addWidget(bar_);
  spheres->addLayout(left, 3);
  spheres->addLayout(small, 2);
  auto* column = new QVBoxLayout{box};
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  column->addLayout(spheres, 1);
  column->addWidget(makeLabel(tr("Twist about the bone's shaft, degrees"), "small"));
  column->addWidget(twist_);

  connect(wanted_, &EditSphere::centrePulled, this, [this](const Eigen::Vector3d& direction_J) {
    if (!study_.picture()) return;
    const BallRange before = study_.picture()->ball_before;
    change(false, tr("Tilt of the cone"), [before, direction_J](RomEdit& e) { pullCentre(before, direction_J, e); });
  });
  connect(wanted_, &EditSphere::borderPulled, this, [this](const Eigen::Vector3d& direction_J) {
    if (!study_.picture() || !body_) return;
    const BallRange before = study_.picture()->ball_before;
    change(false, tr("Width of the cone"),
           [this, before, direction_J](RomEdit& e) { pullBorder(before, direction_J, body_->base->skeleton, e); });
  });
  connect(wanted_, &EditSphere::released, this, [this] {
    if (pulled_) change(true, tr("Cone"), std::exchange(pulled_, nullptr));
  });
  const auto twist = [this](bool keep) {
    return [this, keep](double low_deg, double high_deg) {
      if (!study_.picture() || !body_) return;
      const BallRange before = study_.picture()->ball_before;
      const auto& skeleton = body_->base->skeleton;
      const int sign = twistSign(skeleton, skeleton.jointIndex(panel_.joint()));
      change(keep, tr("Twist"),
             [=](RomEdit& e) { setTwist(before, low_deg * kRadPerDeg, high_deg * kRadPerDeg, sign, e); });
    };
  };
  connect(twist_, &RangeBar::dragged, this, twist(false));
  connect(twist_, &RangeBar::settled, this, twist(true));
  return box;
}

QWidget* RomEditView::makeHinge() {
  auto* card = new Card{tr("Range of the joint, degrees")};
  hinge_ = new RangeBar{"rom_hinge_bar"};
  hinge_->setAccessibleName(tr("Range of the joint"));
  hinge_->setToolTip(tr("Drag an end, or the piece between. Grey line above: before. Blue line below: reached"));
  hinge_words_ = makeLabel({}, "");
  hinge_words_->setObjectName("rom_hinge_words");
  hinge_words_->setWordWrap(true);
  auto* legend = makeLabel(tr("Grey: before · green: wanted · blue: stops of the body that is reached"), "small");
  card->content().addWidget(hinge_);
  card->content().addWidget(legend);
  card->content().addWidget(hinge_words_);
  auto* box = new QWidget;
  auto* column = new QVBoxLayout{box};
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(card);
  column->addStretch();
  const auto set = [this](bool keep) {
    return [this, keep](double low_deg, double high_deg) {
      if (!study_.picture()) return;
      const HingeRange before = study_.picture()->hinge_before;
      change(keep, tr("Range"),
             [=](RomEdit& e) { setHinge(before, low_deg * kRadPerDeg, high_deg * kRadPerDeg, e); });
    };
  };
  connect(hinge_, &RangeBar::dragged, this, set(false));
  connect(hinge_, &RangeBar::settled, this, set(true));
  return box;
}

QWidget* RomEditView::makeChanges() {
  auto* box = new QWidget;
  changes_title_ = makeLabel({}, "heading");
  changes_title_->setObjectName("rom_changes_title");
  changes_ = makeTable("rom_changes", {tr("Muscle"), tr("Length"), tr("Optimal fibre, mm"), tr("Tendon slack, mm")});
  changes_->setToolTip(tr("Muscles whose fibre and tendon changed for the edits, largest change first"));
  changes_->horizontalHeader()->setSectionResizeMode(QHeaderView::Fixed);
  changes_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
  changes_->horizontalHeader()->resizeSection(1, 90);
  changes_->horizontalHeader()->resizeSection(2, 140);
  changes_->horizontalHeader()->resizeSection(3, 140);
  changes_->verticalHeader()->setDefaultSectionSize(24);
  changes_->setMinimumHeight(126);
  auto* column = new QVBoxLayout{box};
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  column->addWidget(changes_title_);
  column->addWidget(changes_);
  connect(changes_, &QTableWidget::currentCellChanged, this, [this](int row) {
    if (row >= 0 && changes_->item(row, 0))
      emit muscleChosen(changes_->item(row, 0)->data(Qt::UserRole).toString().toStdString());
  });
  return box;
}

void RomEditView::setBody(std::shared_ptr<const SolvedBody> body, bool is_current) {
  const bool other = body != body_;
  current_ = is_current;
  body_ = std::move(body);
  if (!other) return;
  showChanges();
  askSoon();
}

void RomEditView::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  askSoon();
}

void RomEditView::askSoon() {
  if (!soon_->isActive()) soon_->start();
}

void RomEditView::ask() {
  if (!reference_ || !body_ || !isVisible() || panel_.joint().empty()) return;
  const bool ball = panel_.isBall();
  kinds_->setCurrentIndex(ball ? 0 : 1);
  rows_->setStretch(1, ball ? 1 : 0);  // of a hinge the muscles get the room that spheres need
  rows_->setStretch(3, ball ? 0 : 1);
  changes_->setMaximumHeight(ball ? 126 : QWIDGETSIZE_MAX);
  kinds_->setMaximumHeight(ball ? QWIDGETSIZE_MAX : 224);
  title_->setText(tr("Range of motion: %1").arg(readableName(panel_.joint())));
  study_.ask(reference_, body_, panel_.joint(), document_.current().rom);
}

RomEdit RomEditView::currentEdit() const {
  const RomEdit* found = findEdit(document_.current().rom, panel_.joint());
  return found ? *found : RomEdit{.joint = panel_.joint()};
}

void RomEditView::change(bool keep, const QString& what, const std::function<void(RomEdit&)>& change) {
  const auto apply = [&, joint = panel_.joint()](RetargetDesign& d) {
    change(editOf(d.rom, joint));
    dropIdentities(d.rom);
    checkRomEdits(body_->base->skeleton, d.rom, "range of motion");
  };
  if (keep) {
    pulled_ = nullptr;
    document_.edit(tr("%1: %2").arg(readableName(panel_.joint()), what.toLower()), apply);
  } else {
    pulled_ = change;
    document_.preview(apply);
  }
}

void RomEditView::showCone() {
  const auto& picture = study_.picture();
  if (!picture || !body_ || !picture->is_ball || picture->joint != panel_.joint()) return;
  wanted_->setCone(edited(picture->ball_before, currentEdit(), body_->base->skeleton));
}

void RomEditView::showTwist() {
  const auto& picture = study_.picture();
  if (!picture || !body_ || !picture->is_ball || picture->joint != panel_.joint()) return;
  const BallRange now = edited(picture->ball_before, currentEdit(), body_->base->skeleton);
  twist_->setBefore(inDegrees(picture->ball_before.twist_low_rad, picture->ball_before.twist_high_rad));
  twist_->setRange(inDegrees(now.twist_low_rad, now.twist_high_rad));
}

void RomEditView::showHinge() {
  const auto& picture = study_.picture();
  if (!picture || picture->is_ball || picture->joint != panel_.joint()) return;
  const HingeRange now = edited(picture->hinge_before, currentEdit());
  hinge_->setScale(std::floor(std::min(picture->hinge_before.low_rad, -0.3) / kRadPerDeg / 30 - 1) * 30,
                   std::ceil(std::max(picture->hinge_before.high_rad, 0.3) / kRadPerDeg / 30 + 1) * 30);
  hinge_->setBefore(inDegrees(picture->hinge_before.low_rad, picture->hinge_before.high_rad));
  hinge_->setRange(inDegrees(now.low_rad, now.high_rad));
  const RangeBar::Range reached = inDegrees(picture->hinge_reached.low_rad, picture->hinge_reached.high_rad);
  hinge_->setReached(&reached);
  const auto words = [](const RangeBar::Range& r) {
    return QObject::tr("%1° to %2°").arg(figure(r.low_deg, 1), figure(r.high_deg, 1));
  };
  hinge_words_->setText(tr("Before %1, wanted %2, reached %3")
                            .arg(words(inDegrees(picture->hinge_before.low_rad, picture->hinge_before.high_rad)),
                                 words(hinge_->range()), words(reached)));
}

void RomEditView::showPicture() {
  const auto& picture = study_.picture();
  if (!picture || picture->joint != panel_.joint()) return;
  if (picture->is_ball) {
    const Eigen::Vector3d shaft_J = picture->before->frame.shaft_J;
    bar_->setScale(tr("Twist range, degrees"), 0, picture->widest_rad / kRadPerDeg, 0, false, false,
                   [](double t) { return romColour(t, 1); });
    before_->setMap(*picture->before, picture->widest_rad, shaft_J);
    before_->setCaption(tr("Before: %1 of %2 cells").arg(picture->before->validCount()).arg(RomMap::kCells));
    wanted_->setMap(*picture->wanted, picture->widest_rad, shaft_J);
    wanted_->setOutline(picture->before);
    if (picture->reached) {
      reached_->setMap(*picture->reached, picture->widest_rad, shaft_J);
      reached_->setOutline(picture->wanted);
      reached_->setCaption(tr("Reached: %1 cells. Blue line: wanted").arg(picture->reached->validCount()));
      error_->setText(tr("Wanted %1 cells; %2 differ from what is reached: %3 % of all, %4 % of those free in either "
                         "(all other joints as standing).")
                          .arg(picture->wanted->validCount())
                          .arg(picture->error.differing())
                          .arg(figure(100 * picture->error.ofAll(), 2), figure(100 * picture->error.ofUnion(), 1)));
    } else {
      reached_->setCaption(tr("Reached: being solved …"));
      error_->setText(tr("Wanted %1 cells of %2.").arg(picture->wanted->validCount()).arg(RomMap::kCells));
    }
    showCone();
    showTwist();
  } else {
    error_->setText(solvedError());
    showHinge();
  }
}

QString RomEditView::solvedError() const {
  if (!body_ || !body_->rom || !current_) return {};
  QStringList parts;
  for (const RomEditCells& c : body_->rom->cells)
    if (c.joint == panel_.joint())
      parts << tr("%1 of %2 degrees differ %3").arg(c.differing_in_stops).arg(c.cells).arg(heldInWords(c.held));
  return parts.isEmpty() ? QString{} : tr("Wanted against reached, muscles and stops: %1.").arg(parts.join(", "));
}

void RomEditView::showChanges() {
  changes_->setRowCount(0);
  if (!body_ || !body_->rom) {
    changes_title_->setText(body_ && !body_->rom_problem.isEmpty() ? body_->rom_problem
                                                                   : tr("No muscle has changed: no range is edited"));
    return;
  }
  auto changed = body_->rom->changed;
  std::ranges::sort(changed, std::greater{}, [](const RomEditChange& c) { return std::abs(c.length_factor - 1); });
  changes_title_->setText(tr("%1 of %2 muscles changed their length for these edits")
                              .arg(changed.size())
                              .arg(body_->model->musculature.units.size()));
  changes_->setRowCount(int(changed.size()));
  for (int row = 0; row < int(changed.size()); ++row) {
    const RomEditChange& c = changed[std::size_t(row)];
    const auto& before = body_->base->musculature.unit(c.unit);
    const auto& after = body_->model->musculature.unit(c.unit);
    const auto lengths = [](double before_m, double after_m) {
      return QStringLiteral("%1 → %2").arg(figure(1000 * before_m, 1), figure(1000 * after_m, 1));
    };
    setCell(*changes_, row, 0, readableName(c.unit))->setData(Qt::UserRole, QString::fromStdString(c.unit));
    setCell(*changes_, row, 1, QStringLiteral("× ") + figure(c.length_factor, 3), kNumber);
    setCell(*changes_, row, 2, lengths(before.optimal_fiber_length_m, after.optimal_fiber_length_m), kNumber);
    setCell(*changes_, row, 3, lengths(before.tendon_slack_length_m, after.tendon_slack_length_m), kNumber);
  }
}

}  // namespace sinew
