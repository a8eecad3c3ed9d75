#include "clinical/synthetic/synthetic_rig.h"

#include <cmath>

#include "core/angle.h"
#include "core/random_source.h"
#include "imaging/rig/rig_uncertainty.h"

namespace sinew {
namespace {

/// Rows are the view's axes in the world: u, v, beam. Hung so that v runs down and u as the orientation says.
Eigen::Matrix3d viewAxes(const FilmGeometry& film) {
  Eigen::Matrix3d R_CW;
  const Eigen::RowVector3d down = -Eigen::RowVector3d::UnitY();
  const Eigen::RowVector3d left = -Eigen::RowVector3d::UnitZ(), forward = Eigen::RowVector3d::UnitX();
  if (film.view_position == "AP")
    R_CW << left, down, -forward;
  else if (film.view_position == "PA")
    R_CW << left, down, forward;  // mirrored, to be read like AP: a left-handed view frame
  else if (film.view_position == "LL")
    R_CW << forward, down, left;  // the left side at the detector
  else
    R_CW << (forward + left).normalized(), down, (left - forward).normalized();  // LPO: left and back at the detector
  return R_CW;
}

View nominalView(const FilmGeometry& film, SyntheticRig kind) {
  View view;
  view.width_px = film.width_px;
  view.height_px = film.height_px;
  view.R_CW = viewAxes(film);
  const double u0 = (film.width_px - 1) / 2.0, v0 = (film.height_px - 1) / 2.0;
  if (kind == SyntheticRig::ConeBeam) {
    const double f_px = film.source_to_detector_mm / film.pixel_mm;
    view.projection = ConeBeam{.fx_px = f_px, .fy_px = f_px, .cx_px = u0, .cy_px = v0};
    view.p_CW = {0, 0, 1e-3 * film.source_to_isocenter_mm};
  } else {
    view.projection =
        SlotScan{1e-3 * film.source_to_isocenter_mm, 1e-3 * film.pixel_mm, 1e-3 * film.pixel_mm, u0, v0};
  }
  return view;
}

}  // namespace

std::string nameOf(SyntheticRig kind) {
  return kind == SyntheticRig::ConeBeam ? "cone-beam" : "slot-scan";
}

std::vector<FilmGeometry> filmGeometry(SyntheticRig kind, int binning, int views) {
  require(views == 2 || (views == 3 && kind == SyntheticRig::ConeBeam), "two views, or three cone beams");
  // Long-leg stand: three detector panels of 0.43 m and a little, 0.28 mm pixels; isocentre 0.25 / 0.35 m before it.
  std::vector<FilmGeometry> films{{"AP", "L\\F", 0.28, 3000, 2750, 1536, 4864, {}},
                                  {"LL", "A\\F", 0.28, 3000, 2650, 1536, 4864, {}}};
  // Distances of the common slot scanner (987 and 918 mm to the isocentre, about 1.3 m to the detectors).
  if (kind == SyntheticRig::SlotScan)
    films = {{"PA", "L\\F", 0.25, 1300, 987, 1800, 7400, {}}, {"LL", "A\\F", 0.25, 1300, 918, 1800, 7400, {}}};
  if (views == 3) {
    films.push_back({"LPO", "AL\\F", 0.28, 3000, 2700, 2048, 4864, 135});
    films[0].primary_angle_deg = 180;
    films[1].primary_angle_deg = 90;
  }
  for (auto& film : films) {
    film.pixel_mm *= binning;
    film.width_px /= binning;
    film.height_px /= binning;
  }
  return films;
}

double floorHeight_m(SyntheticRig kind) {
  return kind == SyntheticRig::ConeBeam ? -0.585 : -0.89;
}

BiplanarRig nominalRig(SyntheticRig kind, int binning, int views) {
  const auto films = filmGeometry(kind, binning, views);
  BiplanarRig rig;
  rig.views.clear();
  for (int i = 0; i < int(films.size()); ++i) {
    RigView view{nominalView(films[std::size_t(i)], kind), ViewRole::Other, kind == SyntheticRig::SlotScan ? 0 : i};
    view.role = roleOfBeam(view);
    rig.views.push_back(view);
  }
  rig.calibration.method = kind == SyntheticRig::ConeBeam ? "dicom_nominal" : "dicom_slot_scan";
  return rig;
}

BiplanarRig drawTrueRig(SyntheticRig kind, std::uint64_t seed, int binning, int views) {
  BiplanarRig rig = nominalRig(kind, binning, views);
  if (kind == SyntheticRig::SlotScan) return rig;
  const auto films = filmGeometry(kind, binning, views);
  RandomSource random{seed, 11};
  for (std::size_t i = 0; i < films.size(); ++i) {
    View& view = rig.views[i];
    const auto small = [&](double sd) { return sd * random.truncatedNormal(); };
    const Eigen::Vector3d turn_rad{small(0.2 * kRadPerDeg), small(0.2 * kRadPerDeg), small(0.3 * kRadPerDeg)};
    view.R_CW = rotationFromVector<double>(turn_rad) * view.R_CW;
    view.p_CW += Eigen::Vector3d{small(0.004), small(0.004), small(0.008)};
    auto& beam = std::get<ConeBeam>(view.projection);
    beam.fx_px = beam.fy_px = beam.fx_px + small(8 / films[i].pixel_mm);
    beam.cx_px += small(3 / films[i].pixel_mm);
    beam.cy_px += small(4 / films[i].pixel_mm);
  }
  rig.calibration.method = "synthetic_truth";
  return rig;
}

void setGeometryTags(Radiograph& film, const FilmGeometry& geometry, SyntheticRig kind) {
  RadiographTags& tags = film.tags;
  tags.view_position = geometry.view_position;
  tags.patient_orientation = geometry.patient_orientation;
  tags.positioner_primary_angle_deg = geometry.primary_angle_deg;
  tags.distance_source_to_detector_mm = geometry.source_to_detector_mm;
  // A machine knows its bucky, not the patient; he stands in the middle of where rigFromDicom() expects him.
  const double table_mm = geometry.source_to_isocenter_mm + 0.5e3 * kObjectDepth_m;
  tags.distance_source_to_patient_mm = kind == SyntheticRig::SlotScan ? geometry.source_to_isocenter_mm : table_mm;
  tags.imager_column_mm = tags.imager_row_mm = geometry.pixel_mm;
  if (kind == SyntheticRig::SlotScan) {
    const double magnification = geometry.source_to_detector_mm / geometry.source_to_isocenter_mm;
    tags.imager_column_mm = geometry.pixel_mm * magnification;  // the fan magnifies across the slot only
    tags.distance_source_to_isocenter_mm = geometry.source_to_isocenter_mm;
    film.spacing = PixelSpacing{geometry.pixel_mm, geometry.pixel_mm, PixelScaleSource::Geometry};
  } else {
    tags.estimated_magnification = geometry.source_to_detector_mm / table_mm;
    film.spacing = PixelSpacing{geometry.pixel_mm, geometry.pixel_mm, PixelScaleSource::ImagerAtDetector};
  }
}

}  // namespace sinew
