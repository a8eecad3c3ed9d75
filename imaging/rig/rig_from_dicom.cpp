#include "imaging/rig/rig_from_dicom.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>

#include "imaging/rig/rig_uncertainty.h"

namespace sinew {
namespace {

constexpr double kDegree_rad = 0.017453292519943295;
constexpr double kMillimetre_m = 1e-3;
constexpr const char* kWhere = "geometry from DICOM";

const Eigen::Vector3d kAnterior{1, 0, 0}, kUp{0, 1, 0}, kRight{0, 0, 1};

[[noreturn]] void refuse(int view, const std::string& field, const std::string& expected, const std::string& found) {
  throw InputError{{std::string{kWhere} + ": image " + std::to_string(view + 1), field, expected, found}};
}

double needed(const std::optional<double>& value, int view, const std::string& name) {
  if (!value) refuse(view, name, "a number of millimetres > 0", "nothing");
  return *value;
}

/// The direction that a word of Patient Orientation names by its first letter; zero for others.
Eigen::Vector3d directionOf(const std::string& word) {
  switch (word.empty() ? ' ' : word[0]) {
    case 'A':
      return kAnterior;
    case 'P':
      return -kAnterior;
    case 'R':
      return kRight;
    case 'L':
      return -kRight;
    case 'H':
      return kUp;
    case 'F':
      return -kUp;
    default:
      return Eigen::Vector3d::Zero();
  }
}

std::string rowWord(const RadiographTags& tags) {
  return tags.patient_orientation.substr(0, tags.patient_orientation.find('\\'));
}

std::string columnWord(const RadiographTags& tags) {
  const auto slash = tags.patient_orientation.find('\\');
  return slash == std::string::npos ? std::string{} : tags.patient_orientation.substr(slash + 1);
}

/// Beam direction by the name of the view; zero if the name says nothing.
Eigen::Vector3d beamOfViewPosition(const RadiographTags& tags, Warnings& warnings) {
  const std::string& name = tags.view_position;
  if (name == "AP") return -kAnterior;
  if (name == "PA") return kAnterior;
  if (name == "LL") return -kRight;
  if (name == "RL") return kRight;
  if (name == "LAT" || name == "LATERAL") {
    warnings.push_back(
        {"lateral_side_assumed",
         "The lateral view does not say which side was at the detector; it is taken from the direction "
         "the patient faces. Check the side marker."});
    return directionOf(rowWord(tags)).dot(kAnterior) < 0 ? kRight : Eigen::Vector3d{-kRight};
  }
  return Eigen::Vector3d::Zero();
}

Eigen::Vector3d beamOfAngles(double primary_deg, double secondary_deg) {
  const double a = primary_deg * kDegree_rad, b = secondary_deg * kDegree_rad;
  return std::cos(b) * (std::cos(a) * kAnterior - std::sin(a) * kRight) + std::sin(b) * kUp;
}

Eigen::Vector3d beamDirection(const RadiographTags& tags, bool all_have_angles, int view, Warnings& warnings) {
  const Eigen::Vector3d named = beamOfViewPosition(tags, warnings);
  if (all_have_angles) {
    const Eigen::Vector3d turned =
        beamOfAngles(*tags.positioner_primary_angle_deg, tags.positioner_secondary_angle_deg.value_or(0));
    if (named.isZero() || named.dot(turned) > std::cos(30 * kDegree_rad)) return turned;
    warnings.push_back({"positioner_angle_ignored", "View " + std::to_string(view + 1) +
                                                        ": the positioner angles contradict View Position '" +
                                                        tags.view_position + "' and are not used."});
  }
  if (named.isZero())
    refuse(view, "View Position", "AP or PA for the first image, LL or RL for the second",
           tags.view_position.empty() ? "nothing" : "'" + tags.view_position + "'");
  return named;
}

/// Rows of R_CW: the axes of the image and the beam, expressed in W.
Eigen::Matrix3d viewAxes(const RadiographTags& tags, const Eigen::Vector3d& z, int view, Warnings& warnings) {
  const Eigen::Vector3d y = -(kUp - kUp.dot(z) * z).normalized();
  Eigen::Vector3d x = y.cross(z);  // as seen from the source
  const std::string column = columnWord(tags);
  if (!column.empty() && directionOf(column).dot(y) < 0.5)
    refuse(view, "Patient Orientation", "rows running towards the feet (F)", "'" + column + "'");

  Eigen::Vector3d stated = directionOf(rowWord(tags));
  if (stated.isZero()) {
    const bool frontal = std::abs(z.dot(kAnterior)) > std::abs(z.dot(kRight));
    stated = frontal ? Eigen::Vector3d{-kRight} : x;
    warnings.push_back(
        {"patient_orientation_assumed",
         "View " + std::to_string(view + 1) + " does not state Patient Orientation; taken as " +
             (frontal ? "the patient's left on the right of the image." : "seen from the X-ray source.") +
             " Check the side marker."});
  }
  if (std::abs(stated.dot(x)) < 0.3)
    refuse(view, "Patient Orientation", "columns running across the beam", "'" + rowWord(tags) + "'");
  if (stated.dot(x) < 0) x = -x;  // stored mirrored: a left-handed view frame
  Eigen::Matrix3d R_CW;
  R_CW << x.transpose(), y.transpose(), z.transpose();
  return R_CW;
}

bool isPatientPlane(PixelScaleSource source) {
  return source == PixelScaleSource::Fiducial || source == PixelScaleSource::Geometry ||
         source == PixelScaleSource::Declared;
}

SlotScan slotScan(const Radiograph& image, int view, Warnings& warnings) {
  SlotScan s;
  const double isocenter_mm =
      needed(image.tags.distance_source_to_isocenter_mm, view, "Distance Source to Isocenter");
  s.source_to_isocenter_m = isocenter_mm * kMillimetre_m;
  if (image.spacing && isPatientPlane(image.spacing->source)) {
    s.column_spacing_m = image.spacing->column_mm * kMillimetre_m;
    s.row_spacing_m = image.spacing->row_mm * kMillimetre_m;
  } else {
    const double detector_mm =
        needed(image.tags.distance_source_to_detector_mm, view, "Pixel Spacing, or Distance Source to Detector");
    if (detector_mm < isocenter_mm)
      refuse(view, "Distance Source to Detector", "no less than to the isocentre",
             std::to_string(detector_mm) + " mm");
    const double column_mm = needed(image.tags.imager_column_mm, view, "Pixel Spacing, or Imager Pixel Spacing");
    s.column_spacing_m = column_mm * isocenter_mm / detector_mm * kMillimetre_m;
    s.row_spacing_m = needed(image.tags.imager_row_mm, view, "Imager Pixel Spacing") * kMillimetre_m;
    warnings.push_back(
        {"slot_scan_spacing_from_detector", "View " + std::to_string(view + 1) +
                                                ": the pixel size in the isocentre plane is computed from "
                                                "the detector's; the file does not state it."});
  }
  s.u0_px = 0.5 * (image.width_px - 1);
  s.v0_px = 0.5 * (image.height_px - 1);
  return s;
}

void requireSameRows(std::span<const Radiograph> images, std::span<const RigView> views, Warnings& warnings) {
  const Radiograph& a = images[0];
  const double spacing_m = std::get<SlotScan>(views[0].projection).row_spacing_m;
  bool one_frame = true;
  for (std::size_t i = 1; i < images.size(); ++i) {
    const Radiograph& b = images[i];
    if (a.height_px != b.height_px)
      throw InputError{{kWhere, "Rows", "the same in all images of a slot scan",
                        std::to_string(a.height_px) + " and " + std::to_string(b.height_px)}};
    const double other_m = std::get<SlotScan>(views[i].projection).row_spacing_m;
    if (std::abs(spacing_m - other_m) > 1e-4 * spacing_m)
      throw InputError{
          {kWhere, "row spacing", "the same in all images of a slot scan",
           std::to_string(spacing_m / kMillimetre_m) + " and " + std::to_string(other_m / kMillimetre_m) + " mm"}};
    one_frame &= a.tags.frame_of_reference_uid == b.tags.frame_of_reference_uid;
  }
  if (!one_frame)
    warnings.push_back({"different_frame_of_reference",
                        "The images do not share a frame of reference: were they scanned together?"});
}

/// Distance source - patient [m], the middle of where he can stand, and the pinhole of a flat detector placed as the
/// tags say.
std::pair<double, ConeBeam> nominalConeBeam(const Radiograph& image, int view) {
  const RadiographTags& t = image.tags;
  const double detector_mm = needed(t.distance_source_to_detector_mm, view, "Distance Source to Detector");
  std::optional<double> patient_mm = t.distance_source_to_patient_mm;
  if (!patient_mm && t.estimated_magnification) patient_mm = detector_mm / *t.estimated_magnification;
  const double table_mm = needed(patient_mm, view, "Distance Source to Patient");
  if (table_mm >= detector_mm)
    refuse(view, "Distance Source to Patient", "less than to the detector", std::to_string(table_mm) + " mm");
  const double source_mm = table_mm - 0.5 * kObjectDepth_m / kMillimetre_m;
  if (source_mm <= 0)
    refuse(view, "Distance Source to Patient", "more than the depth of a patient", std::to_string(table_mm) + " mm");
  ConeBeam c;
  if (t.imager_column_mm && t.imager_row_mm) {
    c.fx_px = detector_mm / *t.imager_column_mm;
    c.fy_px = detector_mm / *t.imager_row_mm;
  } else if (image.spacing && isPatientPlane(image.spacing->source)) {
    c.fx_px = source_mm / image.spacing->column_mm;
    c.fy_px = source_mm / image.spacing->row_mm;
  } else {
    refuse(view, "Imager Pixel Spacing", "a size > 0", "nothing");
  }
  c.cx_px = 0.5 * (image.width_px - 1);
  c.cy_px = 0.5 * (image.height_px - 1);
  return {source_mm * kMillimetre_m, c};
}

void requireOnePatient(std::span<const Radiograph> images, Warnings& warnings) {
  const auto differ = [&](std::string RadiographTags::*field) {
    const std::string* first = nullptr;
    for (const auto& image : images) {
      const std::string& value = image.tags.*field;
      if (value.empty()) continue;
      if (first && value != *first) return true;
      first = &value;
    }
    return false;
  };
  if (differ(&RadiographTags::patient_id) || differ(&RadiographTags::patient_birth_date))
    throw InputError{{kWhere, "patient", "the same in all images", "different ones"}};
  if (differ(&RadiographTags::study_instance_uid))
    warnings.push_back({"different_study", "The images are of different studies: was the posture the same?"});
}

/// Projection and pose of one image.
View viewOf(const Radiograph& image, bool angles, bool scan, int index, Warnings& warnings) {
  const Eigen::Vector3d beam = beamDirection(image.tags, angles, index, warnings);
  View view;
  view.R_CW = viewAxes(image.tags, beam, index, warnings);
  view.width_px = image.width_px;
  view.height_px = image.height_px;
  if (scan) {
    view.projection = slotScan(image, index, warnings);
  } else {
    const auto [source_m, pinhole] = nominalConeBeam(image, index);
    view.projection = pinhole;
    view.p_CW = {0, 0, source_m};
  }
  return view;
}

/// A frontal view first (view 1 of every table), and a lateral one among the others: of two, the second.
void requireUsefulRoles(std::span<const RigView> views) {
  const auto looksFrontal = [](const RigView& v) { return std::abs(v.R_CW(2, 0)) > std::abs(v.R_CW(2, 2)); };
  if (!looksFrontal(views[0])) refuse(0, "view", "a frontal one (AP or PA) first", "a lateral one");
  if (std::ranges::none_of(views, std::not_fn(looksFrontal)))
    refuse(1, "view", views.size() == 2 ? "a lateral one (LL or RL) second" : "a lateral one (LL or RL) among them",
           "a frontal one");
}

void requireDifferentBeams(std::span<const RigView> views) {
  for (std::size_t i = 0; i < views.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (views[i].R_CW.row(2).dot(views[k].R_CW.row(2)) > std::cos(5 * kDegree_rad))
        refuse(int(i), "view",
               "another direction than image " + std::to_string(k + 1) +
                   " (how two views of one direction stand to each other is in no attribute: calibrate "
                   "them, or import a rig)",
               "the same");
}

}  // namespace

BiplanarRig rigFromDicom(std::span<const Radiograph> images) {
  if (images.size() < 2) throw InputError{{kWhere, "images", "two or more", std::to_string(images.size())}};
  const auto everyImage = [&](auto has) { return std::ranges::all_of(images, [&](auto& i) { return has(i.tags); }); };
  const bool angles = everyImage([](auto& t) { return t.positioner_primary_angle_deg.has_value(); });
  const bool scan = everyImage([](auto& t) { return t.distance_source_to_isocenter_mm.has_value(); });
  BiplanarRig rig;
  rig.views.clear();
  Warnings& warnings = rig.calibration.warnings;
  requireOnePatient(images, warnings);
  for (int i = 0; i < int(images.size()); ++i) {
    RigView view{viewOf(images[std::size_t(i)], angles, scan, i, warnings), ViewRole::Other, scan ? 0 : i};
    view.role = roleOfBeam(view);
    rig.views.push_back(view);
  }
  requireUsefulRoles(rig.views);
  if (scan) {
    requireSameRows(images, rig.views, warnings);
  } else {
    requireDifferentBeams(rig.views);
    warnings.push_back(
        {"uncalibrated",
         "The geometry comes from nominal distances and angles alone. The distance to the patient is that to the "
         "table or bucky; the bones are taken to stand up to 0.3 m before it, so all lengths may be wrong together "
         "by "
         "3-5 % and more, as their intervals say. Calibrate with a phantom, or import a rig, for millimetres."});
  }
  if (std::sin(angleBetweenViews_rad(rig)) < std::sin(60 * kDegree_rad))
    warnings.push_back({"views_not_orthogonal", "The two beams are less than 60 deg apart: depth is less certain."});
  rig.patient_aligned = true;
  rig.calibration.method = scan ? "dicom_slot_scan" : "dicom_nominal";
  rig.calibration.id = geometryId(rig.views);
  return rig;
}

}  // namespace sinew
