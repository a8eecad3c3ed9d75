#pragma once
#include <QImage>
#include <QString>
#include <filesystem>

#include "app/plot/ink.h"
#include "clinical/case/case.h"
#include "core/model/bone_contours.h"

namespace sinew {

/// A radiograph as the report shows it: picture, fitted contours, side letters, scale.
struct RadiographPicture {
  QImage image;                       ///< reduced
  double reduction = 1;               ///< pixels of the picture per pixel of the radiograph
  std::vector<BoneContour> contours;  ///< pixels of the radiograph
  QString title;                      ///< "Frontal, 2024-05-01"
  QString left_letter, right_letter;  ///< what lies towards the edges of the picture: "R", "L", "anterior", ...
  double px_per_100_mm = 0;           ///< at the patient's depth, vertical; 0 = unknown
};

/// `bones` posed by X_WB are drawn into the case's view. @throws InputError for an unreadable image.
RadiographPicture radiographPicture(const Case& c, const std::filesystem::path& case_dir, int view,
                                    const std::vector<BoneMesh>& bones, const Skeleton& skeleton,
                                    const std::vector<RigidTransform>& X_WB);

/// Draws it as large as the box allows, centred, the title above.
void drawRadiograph(Ink& ink, const QRectF& box_mm, const RadiographPicture& picture);

}  // namespace sinew
