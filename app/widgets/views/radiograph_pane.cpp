#include "app/widgets/views/radiograph_pane.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "app/model/stage_text.h"
#include "app/model/workspace.h"
#include "app/widgets/controls/theme.h"

namespace sinew {

std::pair<double, double> greyRange(const Radiograph& radiograph, double low, double high) {
  std::vector<std::size_t> count(65536, 0);
  std::size_t total = 0;
  for (std::size_t i = 0; i < radiograph.pixels->size(); i += 7, ++total) ++count[(*radiograph.pixels)[i]];
  const auto quantile = [&](double share) {
    std::size_t sum = 0;
    for (std::size_t grey = 0; grey < count.size(); ++grey)
      if ((sum += count[grey]) > 0 && sum >= std::size_t(share * double(total))) return double(grey);
    return 65535.0;
  };
  return {quantile(low), quantile(high)};
}

RadiographPane::RadiographPane(Workspace& workspace, int view, bool full_tools, QWidget* parent)
    : QWidget{parent}, workspace_{workspace}, place_{view}, index_{view} {
  const QString prefix = view == 0 ? "frontal_" : "lateral_";
  auto* strip = new QWidget;
  strip->setProperty("role", "view_strip");
  strip->setAttribute(Qt::WA_StyledBackground);
  auto* tools = new QHBoxLayout{strip};
  tools->setContentsMargins(12, 4, 6, 4);
  tools->setSpacing(4);
  title_ = makeLabel(view == 0 ? tr("Frontal") : tr("Lateral"), "heading");
  chooser_ = new QComboBox;
  chooser_->setObjectName(prefix + "chooser");
  chooser_->setAccessibleName(tr("View shown here"));
  chooser_->setToolTip(tr("View shown here"));
  chooser_->hide();
  connect(chooser_, &QComboBox::activated, this, &RadiographPane::setViewIndex);
  tools->addWidget(title_);
  tools->addWidget(chooser_);
  tools->addStretch();
  if (full_tools) {
    presets_ = new QComboBox;
    presets_->setObjectName(prefix + "preset");
    presets_->setAccessibleName(tr("Grey-scale preset"));
    presets_->setToolTip(tr("Grey-scale preset"));
    presets_->addItems({tr("From file"), tr("Bone"), tr("Soft tissue"), tr("Full range"), tr("By hand")});
    center_ = new QSpinBox;
    width_ = new QSpinBox;
    for (auto [box, name, tip] : {std::tuple{center_, "center", tr("Window centre [grey value]")},
                                  std::tuple{width_, "width", tr("Window width [grey value]")}}) {
      box->setObjectName(prefix + "window_" + name);
      box->setRange(box == width_ ? 2 : -65535, 131070);
      box->setKeyboardTracking(false);
      box->setButtonSymbols(QAbstractSpinBox::NoButtons);
      box->setFixedWidth(62);
      box->setToolTip(tip);
      box->setAccessibleName(tip);
      connect(box, &QSpinBox::valueChanged, this, [this] { setWindow(center_->value(), width_->value()); });
    }
    tools->addWidget(presets_);
    tools->addSpacing(4);
    tools->addWidget(makeLabel(tr("C"), "small"));
    tools->addWidget(center_);
    tools->addWidget(makeLabel(tr("W"), "small"));
    tools->addWidget(width_);
    tools->addSpacing(4);
    connect(presets_, &QComboBox::activated, this, &RadiographPane::applyPreset);
  }
  invert_ = makeToolButton(prefix + "invert", "invert", tr("Invert grey scale (I)"), strip, colour::kViewText);
  invert_->setCheckable(true);
  auto* fit = makeToolButton(prefix + "fit", "fit", tr("Fit to window (F)"), strip, colour::kViewText);
  auto* one = makeToolButton(prefix + "one_to_one", "one-to-one", tr("One image pixel per screen pixel (1)"), strip,
                             colour::kViewText);
  for (auto* button : {invert_, fit, one}) tools->addWidget(button);

  view_ = new RadiographView;
  view_->setObjectName(prefix + "view");
  view_->setAccessibleName(view == 0 ? tr("Frontal radiograph") : tr("Lateral radiograph"));
  readout_ = makeLabel({}, "small");
  readout_->setObjectName(prefix + "readout");
  auto* foot = new QWidget;
  foot->setProperty("role", "view_strip");
  foot->setAttribute(Qt::WA_StyledBackground);
  foot->setStyleSheet("border-radius: 0; border-bottom-left-radius: 8px; border-bottom-right-radius: 8px;");
  auto* foot_line = new QHBoxLayout{foot};
  foot_line->setContentsMargins(12, 3, 12, 3);
  foot_line->addWidget(readout_);
  readout_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  readout_->setMinimumHeight(18);

  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(strip);
  column->addWidget(view_, 1);
  column->addWidget(foot);

  connect(fit, &QToolButton::clicked, view_, &RadiographView::fit);
  connect(one, &QToolButton::clicked, view_, &RadiographView::oneToOne);
  connect(invert_, &QToolButton::clicked, this, [this](bool on) {
    DisplayWindow next = workspace_.view().window(slot());
    next.invert = on;
    workspace_.view().setWindow(slot(), next);
  });
  connect(view_, &RadiographView::displayChanged, this,
          [this](const DisplayWindow& display) { workspace_.view().setWindow(slot(), display); });
  connect(view_, &RadiographView::hovered, this, &RadiographPane::readPixel);
  connect(view_, &RadiographView::left, this, [this] { showWindow(); });
  connect(view_, &RadiographView::zoomChanged, this, [this] { showWindow(); });
  connect(&workspace_.view(), &ViewState::windowChanged, this, [this](int changed) {
    if (changed == slot()) showWindow();
  });
}

int RadiographPane::slot() const {
  return ViewState::slotOf(index_, phantom_);
}

void RadiographPane::setPhantom(bool on) {
  phantom_ = on;
  refreshTitle();
}

void RadiographPane::setViewIndex(int view) {
  if (view == index_) return;
  index_ = view;
  refresh();
  view_->fit();
  emit viewChanged();
}

void RadiographPane::refreshTitle() {
  const Case& c = workspace_.document().current();
  const int count = std::max(2, int(c.images.size()));
  if (index_ >= count) index_ = place_;  // that view was removed
  const QString suffix = phantom_ ? tr(" · phantom") : QString{};
  title_->setText(viewTitle(c, index_) + suffix);
  const QSignalBlocker block{chooser_};
  chooser_->clear();
  for (int view = 0; view < count; ++view) chooser_->addItem(viewTitle(c, view) + suffix);
  chooser_->setCurrentIndex(index_);
  chooser_->setVisible(count > 2);
  title_->setVisible(count <= 2);
  view_->setAccessibleName(tr("%1 radiograph").arg(viewTitle(c, index_)));
}

void RadiographPane::refresh() {
  const Case& c = workspace_.document().current();
  refreshTitle();
  std::shared_ptr<const Radiograph> radiograph;
  QString placeholder = tr("No %1 radiograph yet").arg(viewTitle(c, index_).toLower());
  std::optional<CaseImage> image;
  const std::size_t index = std::size_t(index_);
  if (phantom_ && c.phantom && index < c.phantom->images.size())
    image = CaseImage{c.phantom->images[index], {}};
  else if (!phantom_ && index < c.images.size())
    image = c.images[index];
  if (image) {
    try {
      radiograph = workspace_.images().image(*image, workspace_.document().folder());
    } catch (const InputError& error) {
      placeholder = QString::fromUtf8(error.what());
    }
  }
  view_->setPlaceholder(placeholder);
  view_->setRadiograph(radiograph);
  // A frontal view is read as if facing the patient: the patient's right is on the viewer's left. World X is
  // anterior.
  if (c.rig && c.rig->patient_aligned && radiograph && index < c.rig->views.size()) {
    const auto& R_CW = c.rig->views[index].R_CW;
    const Eigen::Vector3d u_W = R_CW.row(0);  // image right, in the world
    if (std::abs(u_W.z()) > std::abs(u_W.x()))
      view_->setOrientation(u_W.z() > 0 ? tr("L") : tr("R"), u_W.z() > 0 ? tr("R") : tr("L"));
    else
      view_->setOrientation(u_W.x() > 0 ? tr("P") : tr("A"), u_W.x() > 0 ? tr("A") : tr("P"));
  } else {
    view_->setOrientation({}, {});
  }
  showWindow();
}

void RadiographPane::showWindow() {
  const DisplayWindow display = workspace_.view().window(slot());
  view_->setDisplay(display);
  invert_->setChecked(display.invert);
  const Radiograph* r = view_->radiograph();
  if (center_) {
    const QSignalBlocker block_center{center_}, block_width{width_};
    center_->setValue(int(std::lround(view_->windowCenter())));
    width_->setValue(int(std::lround(view_->windowWidth())));
    if (!display.center && !display.width)
      presets_->setCurrentIndex(0);
    else if (presets_->currentIndex() == 0)
      presets_->setCurrentIndex(4);
  }
  if (r)
    readout_->setText(tr("%1 × %2 px · zoom %3 %")
                          .arg(r->width_px)
                          .arg(r->height_px)
                          .arg(100 * view_->zoom() * devicePixelRatioF(), 0, 'f', 0));
  else
    readout_->clear();
}

void RadiographPane::readPixel(const QPointF& uv_px) {
  const Radiograph& r = *view_->radiograph();
  const int u = std::clamp(int(std::lround(uv_px.x())), 0, r.width_px - 1);
  const int v = std::clamp(int(std::lround(uv_px.y())), 0, r.height_px - 1);
  QString text = tr("u %1  v %2 px · grey %3").arg(u).arg(v).arg(r.at(u, v));
  if (r.spacing && r.spacing->source != PixelScaleSource::None)
    text += tr(" · %1, %2 mm").arg(u * r.spacing->column_mm, 0, 'f', 1).arg(v * r.spacing->row_mm, 0, 'f', 1);
  readout_->setText(text);
}

void RadiographPane::setWindow(double center, double width) {
  DisplayWindow next = workspace_.view().window(slot());
  next.center = center;
  next.width = width;
  if (presets_) presets_->setCurrentIndex(4);
  workspace_.view().setWindow(slot(), next);
}

void RadiographPane::applyPreset(int index) {
  const Radiograph* r = view_->radiograph();
  if (!r || index == 4) return;
  if (index == 0) {
    DisplayWindow next;
    next.invert = workspace_.view().window(slot()).invert;
    workspace_.view().setWindow(slot(), next);
    return;
  }
  // Dense parts hold the larger grey values unless the file is MONOCHROME1.
  static constexpr std::pair<double, double> kShares[] = {{0, 0}, {0.55, 0.999}, {0.02, 0.75}, {0, 1}};
  auto [low, high] = kShares[index];
  if (r->monochrome1) std::tie(low, high) = std::pair{1 - high, 1 - low};
  const auto [from, to] = greyRange(*r, low, high);
  setWindow((from + to) / 2, std::max(2.0, to - from));
  presets_->setCurrentIndex(index);
}

}  // namespace sinew
