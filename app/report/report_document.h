#pragma once
#include <QImage>
#include <filesystem>
#include <vector>

#include "app/report/radiograph_picture.h"
#include "clinical/report/report.h"

namespace sinew {

/// A picture of the fitted model.
struct ModelPlate {
  QImage image;
  QString title;
};

/// Everything that the pages show: text, tables and pictures.
struct ReportDocument {
  Report report;
  std::vector<RadiographPicture> radiographs;
  std::vector<ModelPlate> plates;  ///< front and side with mechanical axes, oblique with the muscles
};

/// Gathers it: figures, images, projected contours, 3-D pictures. @throws InputError as makeReport().
ReportDocument gatherReport(const Case& c, const std::filesystem::path& case_dir, const Model& reference,
                            const std::filesystem::path& resource_dir);

}  // namespace sinew
