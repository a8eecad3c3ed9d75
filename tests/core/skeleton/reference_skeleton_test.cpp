// Every figure of the reference skeleton's specification: joint centres, masses, inertias, limits, axes.
#include <gtest/gtest.h>

#include <numbers>

#include "core/skeleton/clinical_angles.h"
#include "tests/support/postures.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

using Eigen::Vector3d;

constexpr double kDeg = std::numbers::pi / 180;

const Skeleton& reference() {
  static const Skeleton skeleton = loadReferenceSkeleton(test::resourceDir());
  return skeleton;
}

/// Right side or midline; `sides` of them exist.
struct BodyRow {
  const char *name, *joint;
  JointType type;
  const char* parent;  ///< "" = world
  Vector3d p_PJ, p_W;  ///< origin in the parent and in the world at the zero posture [m]
  double mass_kg;
  Vector3d p_BCom, inertia_kgm2;
};

const std::vector<BodyRow>& bodies() {
  using enum JointType;
  static const std::vector<BodyRow> rows = {
      {"pelvis", "root", Free, "", {0, 0.927, 0}, {0, 0.927, 0}, 8.154, {-0.020, 0.057, 0}, {0.0655, 0.0596, 0.0526}},
      {"femur_r",
       "hip_r",
       Ball,
       "pelvis",
       {0, 0, 0.086},
       {0, 0.927, 0.086},
       10.337,
       {0, -0.173, 0},
       {0.1994, 0.0409, 0.1994}},
      {"tibia_r",
       "knee_r",
       Revolute,
       "femur_r",
       {0, -0.422, 0},
       {0, 0.505, 0.086},
       3.161,
       {0, -0.189, 0},
       {0.0386, 0.0064, 0.0371}},
      {"foot_r",
       "ankle_r",
       Ball,
       "tibia_r",
       {0, -0.430, 0},
       {0, 0.075, 0.086},
       1.000,
       {0.056, -0.045, 0},
       {0.0010, 0.0044, 0.0040}},
      {"lumbar",
       "lumbosacral",
       Ball,
       "pelvis",
       {-0.026, 0.104, 0},
       {-0.026, 1.031, 0},
       11.921,
       {0.035, 0.143, 0},
       {0.1286, 0.1213, 0.0812}},
      {"thorax",
       "thoracolumbar",
       Ball,
       "lumbar",
       {-0.018, 0.185, 0},
       {-0.044, 1.216, 0},
       9.928,
       {0.020, 0.159, 0},
       {0.1483, 0.1256, 0.0596}},
      {"neck",
       "cervicothoracic",
       Ball,
       "thorax",
       {0.006, 0.270, 0},
       {-0.038, 1.486, 0},
       1.095,
       {0.010, 0.060, 0},
       {0.0022, 0.0018, 0.0022}},
      {"head",
       "atlantooccipital",
       Revolute,
       "neck",
       {0.018, 0.118, 0},
       {-0.020, 1.604, 0},
       3.971,
       {0.018, 0.038, 0},
       {0.0215, 0.0160, 0.0232}},
      {"scapula_r",
       "girdle_r",
       Ball,
       "thorax",
       {0.055, 0.200, 0.025},
       {0.011, 1.416, 0.025},
       0.861,
       {-0.070, -0.030, 0.090},
       {0.0018, 0.0022, 0.0018}},
      {"humerus_r",
       "shoulder_r",
       Ball,
       "scapula_r",
       {-0.055, -0.025, 0.150},
       {-0.044, 1.391, 0.175},
       1.978,
       {0, -0.167, 0},
       {0.0128, 0.0039, 0.0114}},
      {"ulna_r",
       "elbow_r",
       Revolute,
       "humerus_r",
       {0, -0.290, 0},
       {-0.044, 1.101, 0.175},
       1.183,
       {0, -0.118, 0},
       {0.0065, 0.0013, 0.0060}},
      {"hand_r",
       "wrist_r",
       Ball,
       "ulna_r",
       {0, -0.258, 0},
       {-0.044, 0.843, 0.175},
       0.445,
       {0, -0.068, 0},
       {0.0013, 0.0005, 0.0009}}};
  return rows;
}

struct CoordinateRow {
  const char *name, *joint;
  Vector3d axis;
  double normal_min_deg, normal_max_deg, athlete_min_deg, athlete_max_deg;
};

/// Where the specification gives a range for a limit (lumbar extension 15-30), its middle was chosen.
const std::vector<CoordinateRow>& coordinates() {
  static const Vector3d forearm = Vector3d{0, 0.246, 0.020}.normalized(), X{1, 0, 0}, Y{0, 1, 0}, Z{0, 0, 1};
  static const std::vector<CoordinateRow> rows = {
      {"hip_flexion_r", "hip_r", Z, -20, 120, -45, 150},
      {"hip_adduction_r", "hip_r", X, -45, 30, -85, 40},
      {"hip_internal_rotation_r", "hip_r", Y, -45, 45, -70, 60},
      {"knee_flexion_r", "knee_r", -Z, 0, 140, -10, 160},
      {"ankle_dorsiflexion_r", "ankle_r", Z, -50, 20, -90, 35},
      {"ankle_inversion_r", "ankle_r", X, -20, 35, -30, 50},
      {"ankle_internal_rotation_r", "ankle_r", Y, -15, 15, -25, 25},
      {"lumbar_flexion", "lumbosacral", -Z, -20, 55, -55, 75},
      {"lumbar_lateral_flexion", "lumbosacral", X, -20, 20, -35, 35},
      {"lumbar_rotation", "lumbosacral", -Y, -7, 7, -15, 15},
      {"thorax_flexion", "thoracolumbar", -Z, -20, 30, -40, 45},
      {"thorax_lateral_flexion", "thoracolumbar", X, -25, 25, -40, 40},
      {"thorax_rotation", "thoracolumbar", -Y, -35, 35, -55, 55},
      {"neck_flexion", "cervicothoracic", -Z, -55, 40, -70, 55},
      {"neck_lateral_flexion", "cervicothoracic", X, -40, 40, -60, 60},
      {"neck_rotation", "cervicothoracic", -Y, -75, 75, -95, 95},
      {"head_flexion", "atlantooccipital", -Z, -20, 15, -30, 25},
      {"girdle_elevation_r", "girdle_r", -X, -8, 35, -15, 50},
      {"girdle_protraction_r", "girdle_r", Y, -25, 20, -35, 35},
      {"girdle_posterior_tilt_r", "girdle_r", Z, -5, 40, -15, 60},
      {"shoulder_flexion_r", "shoulder_r", Z, -50, 120, -90, 140},
      {"shoulder_adduction_r", "shoulder_r", X, -120, 30, -140, 50},
      {"shoulder_internal_rotation_r", "shoulder_r", Y, -90, 70, -120, 100},
      {"elbow_flexion_r", "elbow_r", Z, 0, 145, -15, 160},
      {"forearm_pronation_r", "wrist_r", forearm, -85, 80, -100, 100},
      {"wrist_flexion_r", "wrist_r", Z, -70, 78, -100, 105},
      {"wrist_ulnar_deviation_r", "wrist_r", X, -20, 35, -35, 50}};
  return rows;
}

/// Calls check(row, name, is_left) for the row itself and, where it is sided, for the left.
template <class Row, class Check>
void onBothSides(const std::vector<Row>& rows, const Check& check) {
  for (const Row& row : rows) {
    const std::string name = row.name;
    check(row, name, false);
    if (name.ends_with("_r")) check(row, std::string{withoutSide(name)} + "_l", true);
  }
}

std::string ofSide(std::string name, bool left) {
  if (left && name.ends_with("_r")) name.back() = 'l';
  return name;
}

TEST(ReferenceSkeletonFigures, BodiesAndJointsAreThoseOfTheSpecification) {
  const Skeleton& s = reference();
  const auto X_WB = segmentPoses(s, zeroPosture(s));
  std::size_t seen = 0;
  onBothSides(bodies(), [&](const BodyRow& row, const std::string& name, bool left) {
    ++seen;
    const auto side = [&](const Vector3d& p) { return left ? mirrored(p) : p; };
    const int i = s.segmentIndex(name);
    const Segment& segment = s.segments[static_cast<std::size_t>(i)];
    const Joint& joint = s.joints[static_cast<std::size_t>(s.jointIndex(ofSide(row.joint, left)))];
    EXPECT_EQ(joint.child, i) << name;
    EXPECT_EQ(joint.type, row.type) << name;
    EXPECT_EQ(joint.parent < 0 ? "" : s.segments[static_cast<std::size_t>(joint.parent)].name,
              ofSide(row.parent, left))
        << name;
    EXPECT_LT((joint.X_PJ.translation() - side(row.p_PJ)).norm(), 1e-12) << name;
    EXPECT_LT((X_WB[static_cast<std::size_t>(i)].translation() - side(row.p_W)).norm(), 1e-12) << name;
    EXPECT_DOUBLE_EQ(segment.mass_kg, row.mass_kg) << name;
    EXPECT_LT((segment.p_BCom - side(row.p_BCom)).norm(), 1e-12) << name;
    EXPECT_LT((segment.inertia_B_kgm2 - Eigen::Matrix3d{row.inertia_kgm2.asDiagonal()}).norm(), 1e-12) << name;
  });
  EXPECT_EQ(seen, 19u);
}

TEST(ReferenceSkeletonFigures, CoordinatesHaveTheirAxesOrderAndLimits) {
  const Skeleton& s = reference();
  std::size_t seen = 6;  // of the root
  onBothSides(coordinates(), [&](const CoordinateRow& row, const std::string& name, bool left) {
    ++seen;
    const Coordinate& c = s.coordinates[static_cast<std::size_t>(s.coordinateIndex(name))];
    EXPECT_EQ(s.joints[static_cast<std::size_t>(c.joint)].name, ofSide(row.joint, left)) << name;
    EXPECT_LT((c.axis - (left ? mirroredAxis(row.axis) : row.axis)).norm(), 1e-12) << name;
    EXPECT_NEAR(c.normal_min_rad, row.normal_min_deg * kDeg, 1e-12) << name;
    EXPECT_NEAR(c.normal_max_rad, row.normal_max_deg * kDeg, 1e-12) << name;
    EXPECT_NEAR(c.athlete_min_rad, row.athlete_min_deg * kDeg, 1e-12) << name;
    EXPECT_NEAR(c.athlete_max_rad, row.athlete_max_deg * kDeg, 1e-12) << name;
  });
  EXPECT_EQ(seen, 50u);
  // Grood & Suntay: flexion, then adduction or lateral flexion, then axial; the forearm's twist comes first.
  for (std::size_t i = 0; i + 1 < coordinates().size(); ++i)
    if (coordinates()[i].joint == std::string{coordinates()[i + 1].joint}) {
      EXPECT_EQ(s.coordinateIndex(coordinates()[i].name) + 1, s.coordinateIndex(coordinates()[i + 1].name));
    }
}

TEST(ReferenceSkeletonFigures, FramesAreParallelToTheWorldSaveThoseOfTheForearmAndHand) {
  const Skeleton& s = reference();
  const auto X_WB = segmentPoses(s, zeroPosture(s));
  for (std::size_t i = 0; i < s.segments.size(); ++i) {
    const std::string_view name = withoutSide(s.segments[i].name);
    if (name == "radius" || name == "hand") {
      // Supinated axes turned by 90 deg into mid position: thumb (Z) forward, palm (X) inwards.
      const double inwards = s.segments[i].name.ends_with("_r") ? -1 : 1;
      EXPECT_GT((X_WB[i].linear() * Vector3d::UnitX()).z() * inwards, 0.99) << s.segments[i].name;
      EXPECT_GT(std::abs((X_WB[i].linear() * Vector3d::UnitZ()).x()), 0.99) << s.segments[i].name;
    } else {
      EXPECT_LT((X_WB[i].linear() - Eigen::Matrix3d::Identity()).norm(), 1e-12) << s.segments[i].name;
    }
  }
}

TEST(ReferenceSkeletonFigures, DrivenBodiesAreThoseOfTheSpecification) {
  const Skeleton& s = reference();
  const auto X_WB = segmentPoses(s, zeroPosture(s));
  for (const std::size_t left : {0, 1}) {
    const PatellaDriver& patella = s.patellae[left];
    EXPECT_EQ(s.segments[static_cast<std::size_t>(patella.segment)].name, left ? "patella_l" : "patella_r");
    EXPECT_DOUBLE_EQ(patella.radius_m, 0.046);
    EXPECT_NEAR(patella.start_rad, 12.5 * kDeg, 1e-12);
    const std::vector<double> flexion_deg = {0, 15, 30, 45, 60, 75, 90, 110, 130, 150};
    const std::vector<double> arm_cm = {4.6, 4.7, 4.6, 4.2, 3.7, 3.1, 2.6, 2.2, 2.0, 1.9};
    ASSERT_EQ(patella.knee_flexion_rad.size(), flexion_deg.size());
    for (std::size_t i = 0; i < flexion_deg.size(); ++i) {
      EXPECT_NEAR(patella.knee_flexion_rad[i], flexion_deg[i] * kDeg, 1e-12);
      EXPECT_NEAR(patella.quadriceps_arm_m[i], arm_cm[i] / 100, 1e-12);
    }
    const Vector3d knee = X_WB[static_cast<std::size_t>(s.segmentIndex(left ? "tibia_l" : "tibia_r"))].translation();
    const Vector3d centre = X_WB[static_cast<std::size_t>(patella.segment)].translation() - knee;
    EXPECT_LT((centre - 0.046 * Vector3d{std::cos(12.5 * kDeg), std::sin(12.5 * kDeg), 0}).norm(), 1e-12);

    const RadiusDriver& radius = s.radii[left];
    EXPECT_EQ(s.segments[static_cast<std::size_t>(radius.segment)].name, left ? "radius_l" : "radius_r");
    const Vector3d head{0, -0.012, left ? -0.020 : 0.020};
    EXPECT_LT((radius.p_UR - head).norm(), 1e-12);
    const Vector3d axis = Vector3d{0, 0.246, 0.020}.normalized();
    EXPECT_LT((radius.axis_U - (left ? mirroredAxis(axis) : axis)).norm(), 1e-12);
  }
}

TEST(ReferenceSkeletonFigures, WholeBodyHasTheMassAndCentreOfMassOfTheSpecification) {
  const Skeleton& s = reference();
  const auto X_WB = segmentPoses(s, zeroPosture(s));
  double mass_kg = 0;
  Vector3d moment = Vector3d::Zero();
  for (std::size_t i = 0; i < s.segments.size(); ++i) {
    mass_kg += s.segments[i].mass_kg;
    moment += s.segments[i].mass_kg * (X_WB[i] * s.segments[i].p_BCom);
  }
  EXPECT_NEAR(mass_kg, 73.0, 0.005);  // masses are given to a gram
  const Vector3d centre = moment / mass_kg;
  EXPECT_NEAR(centre.y(), 0.983, 0.0005);
  EXPECT_NEAR(centre.x(), -0.009, 0.0005);
  EXPECT_NEAR(centre.z(), 0, 1e-12);
}

/// Joints that turn as a sequence, with the middle angle of the sequence at `middle_deg`.
Eigen::VectorXd withMiddleAngles(Eigen::VectorXd clinical, double middle_deg) {
  for (const Joint& joint : reference().joints)
    if (joint.type != JointType::Revolute)
      clinical[joint.first_coordinate + joint.coordinate_count - 2] = middle_deg * kDeg;
  return clinical;
}

TEST(ClinicalView, IsInvertibleUpToTheGimbalLimit) {
  const Skeleton& s = reference();
  std::mt19937_64 random{41};
  // Near the limit an error of the rotation, 1e-16, is divided by the cosine of the middle angle.
  for (const auto& [middle_deg, tolerance] :
       {std::pair{0.0, 1e-12}, {45.0, 1e-12}, {80.0, 1e-11}, {89.0, 1e-10}, {89.99, 1e-8}})
    for (const double sign : {1.0, -1.0})
      for (int trial = 0; trial < 20; ++trial) {
        const Eigen::VectorXd clinical = withMiddleAngles(test::randomClinical(s, random), sign * middle_deg);
        const Eigen::VectorXd back = clinicalFromPosture(s, postureFromClinical(s, clinical));
        EXPECT_LT((back - clinical).cwiseAbs().maxCoeff(), tolerance) << sign * middle_deg;
      }
}

/// At the limit, and beyond it, other angles may name the posture, but it is the same posture.
TEST(ClinicalView, KeepsThePostureAtAndBeyondTheGimbalLimit) {
  const Skeleton& s = reference();
  std::mt19937_64 random{43};
  for (const double middle_deg : {90.0, -90.0, 95.0, -100.0, 105.0, -140.0})
    for (int trial = 0; trial < 20; ++trial) {
      const Posture q = postureFromClinical(s, withMiddleAngles(test::randomClinical(s, random), middle_deg));
      const Eigen::VectorXd clinical = clinicalFromPosture(s, q);
      ASSERT_TRUE(clinical.allFinite());
      const auto X = segmentPoses(s, q), Y = segmentPoses(s, postureFromClinical(s, clinical));
      for (std::size_t i = 0; i < X.size(); ++i)
        EXPECT_LT((X[i].matrix() - Y[i].matrix()).norm(), 1e-6) << s.segments[i].name << " " << middle_deg;
    }
}

}  // namespace
}  // namespace sinew
