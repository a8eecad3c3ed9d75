#include "app/widgets/views/rom_sphere_view.h"

#include <QImage>
#include <QPixmap>
#include <QVBoxLayout>

#include "app/scene/rom_sphere.h"
#include "app/widgets/controls/theme.h"
#include "app/widgets/views/model_view.h"
#include "app/widgets/views/vtk_view.h"

namespace sinew {

RomSphereView::RomSphereView(const QString& object_name, QWidget* parent) : QWidget{parent} {
  setObjectName(object_name);
  caption_ = makeLabel({}, "");
  caption_->setObjectName(object_name + "_caption");
  caption_->setWordWrap(true);
  auto* column = new QVBoxLayout{this};
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(2);
  column->addWidget(caption_);
  if (platformHasOpenGl()) {
    vtk_ = new VtkView;
    vtk_->setObjectName(object_name + "_canvas");
    scene_ = std::make_unique<RomSphereScene>(vtk_->renderer());
    scene_->lookFromTheFront();
    column->addWidget(vtk_, 1);
  } else {
    still_ = new QLabel;
    still_->setAlignment(Qt::AlignCenter);
    column->addWidget(still_, 1);
  }
  setMinimumHeight(150);
}

RomSphereView::~RomSphereView() {
  scene_.reset();  // before the renderer it draws into
}

void RomSphereView::setCaption(const QString& caption) {
  caption_->setText(caption);
  if (vtk_) vtk_->setAccessibleName(caption);
}

void RomSphereView::setMap(const RomMap& map, double widest_rad, const Eigen::Vector3d& shaft_J) {
  const bool other_joint = !map_ || map_->joint != map.joint;
  map_ = map;
  widest_rad_ = widest_rad;
  shaft_J_ = shaft_J;
  if (scene_) {
    scene_->setMap(map, widest_rad);
    scene_->setShaft(shaft_J);
    if (other_joint) scene_->lookFromTheFront();
  }
  redraw();
}

void RomSphereView::setShaft(const Eigen::Vector3d& shaft_J) {
  shaft_J_ = shaft_J;
  if (scene_ && map_) scene_->setShaft(shaft_J);
  redraw();
}

void RomSphereView::setOutline(const std::optional<RomMap>& map) {
  outline_ = map;
  if (scene_) scene_->setOutline(map);
  redraw();
}

void RomSphereView::setHandles(const std::optional<RomHandles>& handles) {
  handles_ = handles;
  if (scene_) scene_->setHandles(handles);
  redraw();
}

void RomSphereView::turnWith(RomSphereView& other) {
  if (vtk_ && other.vtk_) vtk_->shareCameraWith(*other.vtk_);
}

void RomSphereView::redraw() {
  if (!map_) return;
  if (vtk_) {
    vtk_->requestRender();
  } else if (still_) {
    RomPicture wanted;
    wanted.width_px = std::max(64, still_->width());
    wanted.height_px = std::max(64, still_->height());
    wanted.widest_rad = widest_rad_;
    wanted.colour_bar = false;
    wanted.shaft_J = shaft_J_;
    wanted.outline = outline_;
    wanted.handles = handles_;
    wanted.quality = {1, false};
    const RgbImage image = renderRomSphere(*map_, wanted);
    still_->setPixmap(QPixmap::fromImage(
        QImage{image.rgb.data(), image.width_px, image.height_px, 3 * image.width_px, QImage::Format_RGB888}));
  }
}

}  // namespace sinew
