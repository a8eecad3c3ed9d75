#include "app/widgets/retarget/characters_view.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>

#include "app/model/stage_text.h"
#include "app/widgets/controls/controls.h"
#include "app/widgets/controls/theme.h"
#include "core/retarget/prepared/reference.h"

namespace sinew {
namespace {

constexpr StandardView kLooks[] = {StandardView::Front, StandardView::Oblique, StandardView::Right,
                                   StandardView::Back};
constexpr int kHeight_px = 1000;

}  // namespace

QImage captioned(const Lineup& lineup, const std::vector<QString>& names) {
  const RgbImage& drawn = lineup.image;
  const QImage bodies{drawn.rgb.data(), drawn.width_px, drawn.height_px, 3 * drawn.width_px, QImage::Format_RGB888};
  const int caption_px = drawn.height_px / 14;
  QImage all{drawn.width_px, drawn.height_px + caption_px, QImage::Format_RGB32};
  all.fill(Qt::white);
  QPainter painter{&all};
  painter.setRenderHint(QPainter::TextAntialiasing);
  painter.drawImage(0, 0, bodies);
  painter.setPen(QPen{colour::kBorder, 2});
  painter.setCompositionMode(QPainter::CompositionMode_Darken);  // the ground lies behind the feet
  painter.drawLine(0, lineup.ground_px, all.width(), lineup.ground_px);
  painter.setCompositionMode(QPainter::CompositionMode_SourceOver);
  QFont font = painter.font();
  font.setPixelSize(drawn.height_px / 30);
  font.setWeight(QFont::DemiBold);
  painter.setFont(font);
  painter.setPen(colour::kText);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const int width_px = painter.fontMetrics().horizontalAdvance(names[i]) + 8;
    painter.drawText(QRect{lineup.centre_px[i] - width_px / 2, drawn.height_px, width_px, caption_px},
                     Qt::AlignCenter, names[i]);
  }
  return all;
}

LineupLabel::LineupLabel(QWidget* parent) : QWidget{parent} {
  setObjectName("lineup_picture");
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  setMinimumHeight(200);
}

void LineupLabel::setPicture(const QImage& picture) {
  picture_ = picture;
  update();
}

void LineupLabel::paintEvent(QPaintEvent*) {
  QPainter painter{this};
  painter.setPen(QPen{colour::kLine, 1});
  painter.setBrush(Qt::white);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.drawRoundedRect(QRectF{rect()}.adjusted(0.5, 0.5, -0.5, -0.5), 8, 8);
  if (picture_.isNull()) return;
  constexpr int kMargin_px = 14;
  const double ratio = devicePixelRatioF();
  const QRect room = rect().adjusted(kMargin_px, kMargin_px, -kMargin_px, -kMargin_px);
  QImage scaled = picture_.scaled(room.size() * ratio, Qt::KeepAspectRatio, Qt::SmoothTransformation);
  scaled.setDevicePixelRatio(ratio);
  const QSizeF size = QSizeF{scaled.size()} / ratio;
  painter.drawImage(QPointF{room.center().x() - size.width() / 2, room.center().y() - size.height() / 2}, scaled);
}

CharactersView::CharactersView(QWidget* parent) : QWidget{parent} {
  setObjectName("characters_view");
  look_ = new QComboBox;
  look_->setObjectName("characters_look");
  look_->setAccessibleName(tr("Seen from"));
  look_->setToolTip(tr("Side from which the bodies are seen"));
  look_->addItems({tr("From the front"), tr("Oblique"), tr("From the right"), tr("From the back")});
  muscles_ = new QCheckBox{tr("Muscles")};
  muscles_->setObjectName("characters_muscles");
  muscles_->setToolTip(tr("Draw the muscles"));
  muscles_->setChecked(true);
  with_present_ = new QCheckBox{tr("With the present body")};
  with_present_->setObjectName("characters_present");
  with_present_->setToolTip(tr("Show the body that is being shaped at the end of the line"));
  save_ = makeButton("characters_save", tr("Save picture …"), "export", tr("Save this picture as PNG"));
  save_->setEnabled(false);
  progress_ = new QProgressBar;
  progress_->setObjectName("characters_progress");
  progress_->setAccessibleName(tr("Progress"));
  progress_->setRange(0, 1000);
  progress_->setTextVisible(false);
  progress_->setFixedWidth(160);
  cancel_ = makeButton("characters_cancel", tr("Cancel"), {}, tr("Stop retargeting the characters"));
  words_ = makeLabel({}, "small");
  words_->setObjectName("characters_words");
  label_ = new LineupLabel;
  auto* tools = new QHBoxLayout;
  tools->setSpacing(12);
  tools->addWidget(look_);
  tools->addWidget(muscles_);
  tools->addWidget(with_present_);
  tools->addStretch();
  tools->addWidget(words_);
  tools->addWidget(progress_);
  tools->addWidget(cancel_);
  tools->addWidget(save_);
  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(10);
  column->addLayout(tools);
  column->addWidget(label_, 1);
  for (QWidget* w : {static_cast<QWidget*>(progress_), static_cast<QWidget*>(cancel_)}) w->hide();

  connect(look_, &QComboBox::activated, this, &CharactersView::draw);
  connect(muscles_, &QCheckBox::toggled, this, &CharactersView::draw);
  connect(with_present_, &QCheckBox::toggled, this, &CharactersView::draw);
  connect(save_, &QPushButton::clicked, this, &CharactersView::savePicture);
  connect(cancel_, &QPushButton::clicked, &study_, &CharacterStudy::cancel);
  connect(&study_.runner(), &JobRunner::progressed, this,
          [this](double fraction, const QString& name) { showBusy(tr("Retargeting: %1").arg(name), fraction); });
  connect(&study_, &CharacterStudy::failed, this, [this](const QString& message) {
    showBusy({}, 1);
    words_->setText(message.isEmpty() ? tr("Cancelled. Open the characters again to go on.") : message);
  });
  connect(&study_, &CharacterStudy::ready, this, &CharactersView::draw);
  connect(&drawing_.runner(), &JobRunner::ended, this, [this](JobRunner::Ending ending, const QString& message) {
    if (ending == JobRunner::Ending::Failed) emit problem(message);
  });
}

void CharactersView::open(std::shared_ptr<const RetargetReference> reference,
                          const std::filesystem::path& resource_dir) {
  if (!reference || !study_.characters().empty() || study_.isBusy()) return;
  showBusy(tr("Retargeting the characters"), 0);
  study_.ask(std::move(reference), resource_dir);
}

void CharactersView::setPresent(std::shared_ptr<const Model> model, const QString& name) {
  if (model == present_) return;
  present_ = std::move(model);
  present_name_ = name;
  if (with_present_->isChecked() && isVisible()) draw();
}

void CharactersView::showBusy(const QString& words, double fraction) {
  words_->setText(words);
  progress_->setVisible(fraction < 1);
  cancel_->setVisible(fraction < 1);
  progress_->setValue(int(1000 * fraction));
}

void CharactersView::draw() {
  if (study_.characters().empty()) return;
  std::vector<std::shared_ptr<const Model>> models;
  std::vector<QString> names;
  for (const Character& c : study_.characters()) {
    models.push_back(c.model);
    names.push_back(c.name == "human" ? tr("Reference") : readableName(c.name));
  }
  if (with_present_->isChecked() && present_) {
    models.push_back(present_);
    names.push_back(present_name_);
  }
  showBusy({}, 1);
  words_->setText(tr("Drawing …"));
  const StandardView view = kLooks[std::max(0, look_->currentIndex())];
  drawing_.post(tr("Drawing"),
                [this, models, names, view, muscles = muscles_->isChecked()](const Job&) -> JobRunner::Finish {
                  std::vector<LineupBody> bodies;
                  for (const auto& model : models) bodies.push_back({model, standingOnGround(*model)});
                  LineupPicture wanted;
                  wanted.height_px = kHeight_px;
                  wanted.view = view;
                  wanted.muscles = muscles;
                  const Lineup lineup = renderLineup(bodies, wanted);
                  return [this, names, picture = captioned(lineup, names)] {
                    picture_ = picture;
                    label_->setPicture(picture_);
                    save_->setEnabled(true);
                    words_->setText(tr("All to one scale; colours stand for muscle groups"));
                  };
                });
}

void CharactersView::savePicture() {
  const auto file = askForNewFile(this, tr("Picture of the characters"), "characters.png", tr("Pictures (*.png)"));
  if (file.empty()) return;
  if (picture_.save(QString::fromStdString(file.string()), "PNG"))
    emit notice(tr("Saved: %1").arg(QString::fromStdString(file.filename().string())));
  else
    emit problem(tr("%1: cannot be written").arg(QString::fromStdString(file.string())));
}

}  // namespace sinew
