#include "imaging/rig/rig_from_dicom.h"

#include <gmock/gmock.h>

#include <Eigen/Dense>

#include "imaging/rig/triangulate.h"
#include "tests/imaging/rigs.h"

namespace sinew {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;

Radiograph image(const std::string& view_position, const std::string& orientation) {
  Radiograph r;
  r.width_px = 1801;
  r.height_px = 8001;
  r.tags.view_position = view_position;
  r.tags.patient_orientation = orientation;
  r.tags.patient_id = "A";
  return r;
}

Radiograph slotImage(const std::string& view_position, const std::string& orientation, double source_mm) {
  Radiograph r = image(view_position, orientation);
  r.spacing = PixelSpacing{0.185, 0.179, PixelScaleSource::Geometry};
  r.tags.distance_source_to_isocenter_mm = source_mm;
  r.tags.distance_source_to_detector_mm = 1300;
  return r;
}

Radiograph coneImage(const std::string& view_position, const std::string& orientation) {
  Radiograph r = image(view_position, orientation);
  r.tags.imager_column_mm = r.tags.imager_row_mm = 0.3;
  r.tags.distance_source_to_detector_mm = 1800;
  r.tags.distance_source_to_patient_mm = 1500;
  return r;
}

BiplanarRig rigOf(const Radiograph& a, const Radiograph& b) {
  return rigFromDicom(std::array{a, b});
}

std::string errorOf(const Radiograph& a, const Radiograph& b) {
  try {
    rigOf(a, b);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(RigFromDicom, SlotScanByHand) {
  const BiplanarRig rig = rigOf(slotImage("AP", "L\\F", 987), slotImage("LL", "A\\F", 918));
  EXPECT_EQ(rig.calibration.method, "dicom_slot_scan");
  EXPECT_TRUE(rig.patient_aligned);
  EXPECT_THAT(rig.calibration.warnings, testing::IsEmpty());
  // 100 mm anterior, 200 mm up, 50 mm to the right. AP: the source is in front, so anterior is nearer to it.
  const Eigen::Vector3d p{0.1, 0.2, 0.05};
  const Eigen::Vector2d frontal = *project(rig.views[0], p), lateral = *project(rig.views[1], p);
  EXPECT_NEAR(frontal.x(), 900 - 50 * 987 / (987 - 100.0) / 0.185, 1e-9);  // the right side lies left in the image
  EXPECT_NEAR(lateral.x(), 900 + 100 * 918 / (918 - 50.0) / 0.185, 1e-9);  // LL: the source is on the right side
  EXPECT_NEAR(frontal.y(), 4000 - 200 / 0.179, 1e-9);
  EXPECT_NEAR(lateral.y(), frontal.y(), 1e-9);
}

TEST(RigFromDicom, EveryPairOfNamedViewsIsConsistent) {
  struct Named {
    const char *position, *orientation;
    double determinant;
    Eigen::Vector3d u_W;
  };
  const Named frontals[] = {{"AP", "L\\F", 1, {0, 0, -1}},
                            {"PA", "L\\F", -1, {0, 0, -1}},  // hung like AP: mirrored
                            {"PA", "R\\F", 1, {0, 0, 1}},
                            {"AP", "", 1, {0, 0, -1}},
                            {"PA", "", -1, {0, 0, -1}}};
  const Named laterals[] = {{"LL", "A\\F", 1, {1, 0, 0}},
                            {"LL", "P\\F", -1, {-1, 0, 0}},
                            {"RL", "P\\F", 1, {-1, 0, 0}},
                            {"RL", "", 1, {-1, 0, 0}}};
  const Eigen::Vector3d p{0.04, -0.3, 0.11};
  for (const auto& f : frontals)
    for (const auto& l : laterals) {
      const BiplanarRig rig = rigOf(coneImage(f.position, f.orientation), coneImage(l.position, l.orientation));
      EXPECT_NEAR(rig.views[0].R_CW.determinant(), f.determinant, 1e-12) << f.position << f.orientation;
      EXPECT_NEAR(rig.views[1].R_CW.determinant(), l.determinant, 1e-12) << l.position << l.orientation;
      EXPECT_LT((rig.views[0].R_CW.row(0).transpose() - f.u_W).norm(), 1e-12);
      EXPECT_LT((rig.views[1].R_CW.row(0).transpose() - l.u_W).norm(), 1e-12);
      const auto point = triangulate(rig, std::vector{test::see(rig, 0, p), test::see(rig, 1, p)});
      ASSERT_TRUE(point);
      EXPECT_LT((point->p_WL - p).norm(), 1e-10);
      EXPECT_EQ(std::string{f.orientation}.empty() || std::string{l.orientation}.empty(),
                std::any_of(rig.calibration.warnings.begin(), rig.calibration.warnings.end(),
                            [](const Warning& w) { return w.code == "patient_orientation_assumed"; }));
    }
}

TEST(RigFromDicom, NominalConeBeamByHand) {
  const BiplanarRig rig = rigOf(coneImage("PA", "R\\F"), coneImage("LL", "A\\F"));
  EXPECT_EQ(rig.calibration.method, "dicom_nominal");
  EXPECT_THAT(rig.calibration.warnings, Contains(Field(&Warning::code, "uncalibrated")));
  // PA: the source is behind. It is 1.5 m to the bucky, and the patient's middle is taken 0.15 m before that.
  const Eigen::Vector2d uv = *project(rig.views[0], Eigen::Vector3d{0.1, 0.2, 0.05});
  EXPECT_NEAR(uv.x(), 900 + 6000 * 0.05 / 1.45, 1e-9);
  EXPECT_NEAR(uv.y(), 4000 - 6000 * 0.2 / 1.45, 1e-9);
}

TEST(RigFromDicom, PositionerAnglesTurnTheBeam) {
  Radiograph f = coneImage("PA", "R\\F"), l = coneImage("LL", "A\\F");
  f.tags.positioner_primary_angle_deg = 10;
  f.tags.positioner_secondary_angle_deg = 5;
  l.tags.positioner_primary_angle_deg = 95;
  BiplanarRig rig = rigOf(f, l);
  const double degree = M_PI / 180;
  const Eigen::Vector3d beam{std::cos(5 * degree) * std::cos(10 * degree), std::sin(5 * degree),
                             -std::cos(5 * degree) * std::sin(10 * degree)};
  EXPECT_LT((rig.views[0].R_CW.row(2).transpose() - beam).norm(), 1e-12);
  EXPECT_NEAR(rig.views[0].R_CW.determinant(), 1, 1e-12);
  EXPECT_GT(rig.views[0].R_CW.row(1).dot(Eigen::Vector3d{0, -1, 0}), 0.99);
  f.tags.view_position = l.tags.view_position = "";  // the angles alone say it too
  EXPECT_LT((rigOf(f, l).views[0].R_CW.row(2).transpose() - beam).norm(), 1e-12);

  l = coneImage("LL", "A\\F");
  l.tags.positioner_primary_angle_deg = 0;  // a fixed stand writes zero into both
  rig = rigOf(coneImage("PA", "R\\F"), l);
  EXPECT_LT((rig.views[1].R_CW.row(2).transpose() - Eigen::Vector3d{0, 0, -1}).norm(), 1e-12);
  f.tags.view_position = "PA";
  rig = rigOf(f, l);
  EXPECT_THAT(rig.calibration.warnings, Contains(Field(&Warning::code, "positioner_angle_ignored")));
}

TEST(RigFromDicom, AThirdObliqueViewByItsAngle) {
  std::array images{coneImage("AP", "L\\F"), coneImage("LL", "A\\F"), coneImage("", "AL\\F")};
  const double angles_deg[] = {180, 90, 135};
  for (std::size_t i = 0; i < 3; ++i) images[i].tags.positioner_primary_angle_deg = angles_deg[i];
  const BiplanarRig rig = rigFromDicom(images);
  ASSERT_EQ(rig.views.size(), 3u);
  EXPECT_EQ(rig.views[0].role, ViewRole::FrontalAP);
  EXPECT_EQ(rig.views[1].role, ViewRole::LateralLeft);
  EXPECT_EQ(rig.views[2].role, ViewRole::Oblique);
  EXPECT_NE(rig.views[1].exposure, rig.views[2].exposure);
  const double half = std::sqrt(0.5);
  EXPECT_LT((rig.views[2].R_CW.row(2).transpose() - Eigen::Vector3d{-half, 0, -half}).norm(), 1e-12);
  EXPECT_LT((rig.views[2].R_CW.row(0).transpose() - Eigen::Vector3d{half, 0, -half}).norm(), 1e-12);
  const Eigen::Vector3d p{0.04, -0.3, 0.11};
  const auto point = triangulate(rig, std::vector{test::see(rig, 0, p), test::see(rig, 2, p)});
  ASSERT_TRUE(point);
  EXPECT_LT((point->p_WL - p).norm(), 1e-10);
}

TEST(RigFromDicom, StitchedPartsHaveNoNominalGeometry) {
  const std::array images{coneImage("AP", "L\\F"), coneImage("LL", "A\\F"), coneImage("AP", "L\\F")};
  EXPECT_THROW(rigFromDicom(images), InputError);
}

TEST(RigFromDicom, SlotScanSpacingFromTheDetector) {
  Radiograph f = slotImage("AP", "L\\F", 987), l = slotImage("LL", "A\\F", 918);
  for (Radiograph* r : {&f, &l}) {
    r->spacing.reset();
    r->tags.imager_column_mm = 0.254;
    r->tags.imager_row_mm = 0.179;
  }
  const BiplanarRig rig = rigOf(f, l);
  EXPECT_NEAR(std::get<SlotScan>(rig.views[0].projection).column_spacing_m, 0.254e-3 * 987 / 1300, 1e-12);
  EXPECT_NEAR(std::get<SlotScan>(rig.views[0].projection).row_spacing_m, 0.179e-3, 1e-12);
  EXPECT_THAT(rig.calibration.warnings, Contains(Field(&Warning::code, "slot_scan_spacing_from_detector")));
}

TEST(RigFromDicom, RefusesPairsThatAreNone) {
  const Radiograph f = slotImage("AP", "L\\F", 987), l = slotImage("LL", "A\\F", 918);
  EXPECT_THAT(errorOf(l, f), HasSubstr("image 1: view: expected a frontal one"));
  EXPECT_THAT(errorOf(f, f), HasSubstr("image 2: view: expected a lateral one"));
  Radiograph other = l;
  other.height_px = 8000;
  EXPECT_THAT(errorOf(f, other), HasSubstr("Rows: expected the same"));
  other = l;
  other.spacing->row_mm = 0.2;
  EXPECT_THAT(errorOf(f, other), HasSubstr("row spacing"));
  other = l;
  other.tags.patient_id = "B";
  EXPECT_THAT(errorOf(f, other), HasSubstr("patient: expected the same in all images, found different ones"));
  other = l;
  other.spacing.reset();
  EXPECT_THAT(errorOf(f, other), HasSubstr("image 2: Pixel Spacing, or Imager Pixel Spacing"));
  other = l;
  other.tags.view_position = "";
  EXPECT_THAT(errorOf(f, other), HasSubstr("image 2: View Position"));
  other = l;
  other.tags.patient_orientation = "A\\H";
  EXPECT_THAT(errorOf(f, other), HasSubstr("rows running towards the feet"));
  other = l;
  other.tags.patient_orientation = "R\\F";
  EXPECT_THAT(errorOf(f, other), HasSubstr("across the beam"));
  Radiograph cone = coneImage("AP", "L\\F");
  cone.tags.distance_source_to_detector_mm.reset();
  EXPECT_THAT(errorOf(cone, coneImage("LL", "A\\F")), HasSubstr("Distance Source to Detector"));
}

}  // namespace
}  // namespace sinew
