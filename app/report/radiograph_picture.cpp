#include "app/report/radiograph_picture.h"

#include <algorithm>
#include <cmath>

#include "clinical/case/case_io.h"
#include "imaging/radiograph/radiograph.h"

namespace sinew {
namespace {

constexpr int kMaxPictureHeight_px = 1500;

QImage greyImage(const Radiograph& radiograph) {
  const auto pixels = displayPixels(radiograph, radiograph.window_center, radiograph.window_width, false);
  const QImage view{pixels.data(), radiograph.width_px, radiograph.height_px, radiograph.width_px,
                    QImage::Format_Grayscale8};
  if (radiograph.height_px <= kMaxPictureHeight_px) return view.copy();
  return view.scaledToHeight(kMaxPictureHeight_px, Qt::SmoothTransformation)
      .convertToFormat(QImage::Format_Grayscale8);
}

/// Direction of a patient axis in the image: +1 towards larger u, -1 towards smaller, 0 if it points along the ray.
int directionInImage(const View& view, const Eigen::Vector3d& p_W, const Eigen::Vector3d& axis_W) {
  const auto a = project(view, p_W), b = project(view, Eigen::Vector3d{p_W + 0.1 * axis_W});
  if (!a || !b) return 0;
  const Eigen::Vector2d d = *b - *a;
  return std::abs(d.x()) > 0.5 * (std::abs(d.y()) + 1) ? (d.x() > 0 ? 1 : -1) : 0;
}

void nameSides(RadiographPicture& picture, const View& view, const RigidTransform& X_WPelvis) {
  const Eigen::Vector3d p_W = X_WPelvis.translation();
  const auto name = [&](const Eigen::Vector3d& axis_W, const char* positive, const char* negative) {
    const int direction = directionInImage(view, p_W, axis_W);
    if (direction == 0) return;
    picture.right_letter = direction > 0 ? positive : negative;
    picture.left_letter = direction > 0 ? negative : positive;
  };
  // The picture's horizontal axis is mostly one of the two.
  const Eigen::Vector3d along_u = view.R_CW.row(0);
  const Eigen::Vector3d right = X_WPelvis.linear().col(2), forward = X_WPelvis.linear().col(0);
  if (std::abs(along_u.dot(right)) > std::abs(along_u.dot(forward)))
    name(right, "R", "L");
  else
    name(forward, "ant.", "post.");
}

const RigidTransform* pelvisPose(const Skeleton& skeleton, const std::vector<RigidTransform>& X_WB) {
  for (std::size_t i = 0; i < skeleton.segments.size(); ++i)
    if (skeleton.segments[i].name == "pelvis") return &X_WB[i];
  return nullptr;
}

}  // namespace

RadiographPicture radiographPicture(const Case& c, const std::filesystem::path& case_dir, int view,
                                    const std::vector<BoneMesh>& bones, const Skeleton& skeleton,
                                    const std::vector<RigidTransform>& X_WB) {
  const auto& entry = c.images.at(std::size_t(view));
  const Radiograph radiograph = readRadiograph(checkedFile(entry.file, case_dir), entry.declared_spacing_mm);
  const View& geometry = c.rig->views[std::size_t(view)];
  RadiographPicture picture;
  picture.image = greyImage(radiograph);
  picture.reduction = double(picture.image.height()) / radiograph.height_px;
  picture.contours = boneContours(bones, X_WB, geometry);
  picture.title = QString::fromStdString(viewTitle(c.rig->views, view)) + " radiograph";
  if (const auto* pelvis = pelvisPose(skeleton, X_WB)) {
    nameSides(picture, geometry, *pelvis);
    const Eigen::Vector3d p_W = pelvis->translation();
    const auto a = project(geometry, p_W),
               b = project(geometry, Eigen::Vector3d{p_W - 0.1 * pelvis->linear().col(1)});
    if (a && b) picture.px_per_100_mm = (*b - *a).norm();
  }
  return picture;
}

void drawRadiograph(Ink& ink, const QRectF& box_mm, const RadiographPicture& picture) {
  constexpr double kTitle_mm = 3.2;
  const double scale = std::min(box_mm.width() / picture.image.width(),
                                (box_mm.height() - kTitle_mm) / picture.image.height());  // mm a picture pixel
  const QSizeF size{scale * picture.image.width(), scale * picture.image.height()};
  const QRectF frame{box_mm.center().x() - size.width() / 2, box_mm.top() + kTitle_mm, size.width(), size.height()};
  ink.text({box_mm.left(), box_mm.top(), box_mm.width(), kTitle_mm}, picture.title,
           {.size_mm = 2.1, .bold = true, .align = Qt::AlignHCenter, .wrap = false});
  ink.image(frame, picture.image);
  ink.clipTo(frame);
  const double px_mm = scale * picture.reduction;  // mm a pixel of the radiograph
  for (const auto& contour : picture.contours)
    for (const auto& line : contour.lines) {
      std::vector<QPointF> points;
      // A pixel's centre has whole coordinates: its corner is half a pixel before.
      for (const auto& p : line)
        points.emplace_back(frame.left() + (p.x() + 0.5) * px_mm, frame.top() + (p.y() + 0.5) * px_mm);
      const bool left = contour.bone.ends_with("_l");
      ink.polyline(points, 0.14, left ? shade::kLeft : shade::kRight, left ? Qt::DashLine : Qt::SolidLine);
    }
  ink.unclip();
  const Ink::TextStyle letter{.size_mm = 2.6, .bold = true, .colour = Qt::white, .wrap = false};
  auto right = letter;
  right.align = Qt::AlignRight | Qt::AlignTop;
  ink.text(frame.adjusted(0.8, 0.6, -0.8, 0), picture.left_letter, letter);
  ink.text(frame.adjusted(0.8, 0.6, -0.8, 0), picture.right_letter, right);
  if (picture.px_per_100_mm > 0) {
    const double length = picture.px_per_100_mm * px_mm, x = frame.right() - 1.6, y = frame.bottom() - 1.5;
    ink.fill({x - 3.2, y - std::max(length, 11.0) - 0.5, 4, std::max(length, 11.0) + 1}, Qt::black);
    ink.line({x, y - length}, {x, y}, 0.35, Qt::white);
    ink.verticalText({x - 3.0, y - std::max(length, 11.0) / 2 - 8, 2.6, 16}, "100 mm",
                     {.size_mm = 2.0, .colour = Qt::white});
  }
}

}  // namespace sinew
