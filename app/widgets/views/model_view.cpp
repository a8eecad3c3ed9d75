#include "app/widgets/views/model_view.h"

#include <QGuiApplication>
#include <QHBoxLayout>
#include <QImage>
#include <QStackedLayout>
#include <QToolButton>
#include <QVBoxLayout>

#include "app/widgets/controls/theme.h"
#include "app/widgets/views/vtk_view.h"

namespace sinew {
namespace {

constexpr StandardView kViews[] = {StandardView::Front, StandardView::Right, StandardView::Back,
                                   StandardView::Oblique};

}  // namespace

bool platformHasOpenGl() {
  const QString platform = QGuiApplication::platformName();
  return platform != "offscreen" && platform != "minimal" && platform != "vnc" && platform != "linuxfb";
}

ModelView::ModelView(const QString& object_name, bool with_muscles, QWidget* parent)
    : QWidget{parent}, with_muscles_{with_muscles}, muscles_{with_muscles} {
  setObjectName(object_name);
  auto* strip = new QWidget;
  strip->setProperty("role", "view_strip");
  strip->setAttribute(Qt::WA_StyledBackground);
  auto* tools = new QHBoxLayout{strip};
  tools->setContentsMargins(12, 4, 6, 4);
  tools->setSpacing(4);
  tools->addStretch();
  buildTools(*tools, object_name);

  auto* area = new QWidget;
  area->setStyleSheet("background: " + colour::kView.name());
  stack_ = new QStackedLayout{area};
  placeholder_ = makeLabel({}, "small");
  placeholder_->setAlignment(Qt::AlignCenter);
  placeholder_->setWordWrap(true);
  placeholder_->setMargin(24);
  stack_->addWidget(placeholder_);
  if (platformHasOpenGl()) {
    vtk_ = new VtkView;
    vtk_->setObjectName(object_name + "_canvas");
    vtk_->setAccessibleName(tr("Three-dimensional model"));
    scene_ = std::make_unique<ModelScene>(vtk_->renderer());
    scene_->setBackdrop(Backdrop::Dark);
    stack_->addWidget(vtk_);
    connect(vtk_, &VtkView::clicked, this, [this](double x_px, double y_px) {
      if (const auto pick = scene_->pick(x_px, y_px)) emit picked(pick->name);
    });
  } else {
    still_ = new QLabel;
    still_->setAlignment(Qt::AlignCenter);
    stack_->addWidget(still_);
  }
  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(strip);
  column->addWidget(area, 1);
}

ModelView::~ModelView() {
  scene_.reset();  // before the renderer it draws into
}

void ModelView::buildTools(QHBoxLayout& tools, const QString& object_name) {
  const auto layer = [&](const QString& name, const QString& text, const QString& tip, bool& shown,
                         SceneLayer which) {
    auto* button = new QToolButton;
    button->setObjectName(object_name + "_" + name);
    button->setText(text);
    button->setProperty("words", true);
    // The style sheet's least width of a button is that of an icon.
    button->setStyleSheet(QString{"min-width: %1px;"}.arg(button->fontMetrics().horizontalAdvance(text)));
    button->setToolTip(tip);
    button->setAccessibleName(tip);
    button->setCheckable(true);
    button->setChecked(shown);
    connect(button, &QToolButton::toggled, this, [this, &shown, which](bool on) {
      shown = on;
      if (scene_) scene_->setVisible(which, on);
      redraw();
    });
    tools.addWidget(button);
    return button;
  };
  layer("bones", tr("Bones"), tr("Show bones"), bones_, SceneLayer::Bones);
  if (with_muscles_) layer("muscles", tr("Muscles"), tr("Show muscles"), muscles_, SceneLayer::Muscles);
  axes_button_ = layer("axes", tr("Axes"), tr("Show mechanical axes"), axes_, SceneLayer::MechanicalAxes);
  layer("landmarks", tr("Points"), tr("Show landmarks"), landmarks_, SceneLayer::Landmarks);
  tools.addSpacing(8);
  const char* names[] = {"front", "side", "back", "oblique"};
  const char* icons[] = {"view-front", "view-side", "view-back", "fit"};
  const QString tips[] = {tr("From the front"), tr("From the right"), tr("From the back"),
                          tr("Oblique view, all in sight")};
  for (int i = 0; i < 4; ++i) {
    auto* button = makeToolButton(object_name + "_" + names[i], icons[i], tips[i], this, colour::kViewText);
    connect(button, &QToolButton::clicked, this, [this, i] { lookFrom(i); });
    tools.addWidget(button);
  }
}

void ModelView::setModel(std::shared_ptr<const Model> model, const Posture& posture, const QString& placeholder) {
  placeholder_->setText(placeholder);
  stack_->setCurrentIndex(model ? 1 : 0);
  const bool other_model = model != model_;
  const bool other_posture = posture.size() != posture_.size() || posture != posture_;
  if (!other_model && !other_posture) return;
  model_ = std::move(model);
  posture_ = posture;
  if (!model_) return;
  if (scene_) {
    if (other_model) scene_->setModel(model_);
    scene_->setPosture(posture_);
    scene_->setVisible(SceneLayer::Bones, bones_);
    scene_->setVisible(SceneLayer::Muscles, muscles_);
    scene_->setVisible(SceneLayer::MechanicalAxes, axes_);
    scene_->setVisible(SceneLayer::Landmarks, landmarks_);
    if (!framed_) scene_->lookFrom(kViews[standard_view_]);
    framed_ = true;
  }
  redraw();
}

void ModelView::select(const std::string& name) {
  if (!scene_) return;
  scene_->select(name);
  redraw();
}

void ModelView::showRom(const std::optional<RomMap>& map, double widest_rad) {
  if (!scene_ || !model_) return;
  scene_->setRom(map, widest_rad);
  redraw();
}

void ModelView::show(const Posture& posture, const std::string& selected,
                     const std::optional<MuscleScalars>& scalars) {
  if (!model_) return;
  posture_ = posture;
  scalars_ = scalars;
  if (scene_) scene_->show(posture, selected, scalars);
  redraw();
}

void ModelView::fit() {
  if (scene_ && model_) scene_->fitAll();
  redraw();
}

void ModelView::withoutAxes() {
  axes_button_->setChecked(false);
  axes_button_->hide();
}

void ModelView::lookFrom(int standard_view) {
  standard_view_ = standard_view;
  if (scene_ && model_) scene_->lookFrom(kViews[standard_view]);
  redraw();
}

void ModelView::redraw() {
  if (!model_) return;
  if (vtk_) {
    vtk_->requestRender();
  } else if (still_) {
    ModelPicture wanted{std::max(64, still_->width()),
                        std::max(64, still_->height()),
                        kViews[standard_view_],
                        Backdrop::Dark,
                        muscles_,
                        axes_,
                        landmarks_,
                        scalars_,
                        {1, false},
                        {},
                        {}};
    const RgbImage image = renderModel(*model_, posture_, wanted);
    still_->setPixmap(QPixmap::fromImage(
        QImage{image.rgb.data(), image.width_px, image.height_px, 3 * image.width_px, QImage::Format_RGB888}));
  }
}

}  // namespace sinew
