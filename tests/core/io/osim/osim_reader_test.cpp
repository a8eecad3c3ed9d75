#include "core/io/osim/osim_reader.h"

#include <gmock/gmock.h>

#include <numbers>

#include "core/foreign/foreign_kinematics.h"
#include "tests/support/osim_text.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

using namespace test;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string complaint(const std::string& text) {
  try {
    osimFromText(text, "file.osim");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

OsimParts onePin() {
  return {.bodies = osimBody("a"),
          .joints = osimJoint("PinJoint", "j", "/ground", "/bodyset/a", {"q"}),
          .constraints = "",
          .forces = osimMuscle("m", osimPoint("/ground", "0 0.1 0") + osimPoint("/bodyset/a", "0.1 0 0"))};
}

TEST(OsimReader, ReadsBodiesMusclesAndRanges) {
  const ForeignModel model = osimFromText(osimDocument(onePin()), "file.osim");
  EXPECT_EQ(model.source, "OpenSim 40000");
  ASSERT_EQ(model.bodies.size(), 1u);
  EXPECT_EQ(model.bodies[0].mass_kg, 2);
  EXPECT_EQ(model.bodies[0].p_BCom, Eigen::Vector3d(0, -0.1, 0));
  EXPECT_EQ(model.bodies[0].inertia_B_kgm2.diagonal(), Eigen::Vector3d(0.01, 0.02, 0.03));
  EXPECT_EQ(model.coordinates[0].min, -2);
  EXPECT_EQ(model.musculature.units[0].max_isometric_force_N, 1000);
  EXPECT_EQ(model.musculature.units[0].tendon_slack_length_m, 0.2);
  EXPECT_NEAR(foreignLength(model, 0, Eigen::VectorXd::Zero(1)), std::sqrt(0.02), 1e-15);
  EXPECT_TRUE(model.warnings.empty());
}

/// Versions 2 and 3: the joint inside the body, places by <location>, coordinates in a set.
TEST(OsimReader, ReadsOldDocuments) {
  const std::string old =
      R"(<OpenSimDocument Version="20303"><Model name="old"><BodySet><objects>
      <Body name="ground"><mass>0</mass><Joint/></Body>
      <Body name="arm"><mass>1.5</mass><mass_center>0 0 0</mass_center>
        <inertia_xx>1</inertia_xx><inertia_yy>2</inertia_yy><inertia_zz>3</inertia_zz>
        <inertia_xy>0</inertia_xy><inertia_xz>0</inertia_xz><inertia_yz>0</inertia_yz>
        <Joint><CustomJoint name="shoulder"><parent_body>ground</parent_body>
          <location_in_parent>0 1 0</location_in_parent><orientation_in_parent>0 0 0.5</orientation_in_parent>
          <location>0.2 0 0</location><orientation>0 0 0</orientation>
          <CoordinateSet><objects><Coordinate name="elv"><motion_type>rotational</motion_type>
            <default_value>0.1</default_value><range>-1 2</range><locked>true</locked></Coordinate></objects></CoordinateSet>
          <SpatialTransform>
            <TransformAxis name="rotation1"><coordinates>elv</coordinates><axis>0 0 1</axis>
              <function><NaturalCubicSpline><x>-1 0 1 2</x><y>-1 0 1 2</y></NaturalCubicSpline></function></TransformAxis>
            <TransformAxis name="rotation2"><coordinates/><axis>0 1 0</axis><function><Constant><value>0</value></Constant></function></TransformAxis>
          </SpatialTransform></CustomJoint></Joint></Body>
      </objects></BodySet>
      <ForceSet><objects><Schutte1993Muscle name="biceps"><GeometryPath><PathPointSet><objects>
        <PathPoint name="a"><location>0 0 0</location><body>ground</body></PathPoint>
        <MovingPathPoint name="b"><body>arm</body>
          <x_location><LinearFunction><coefficients>0.1 0.2</coefficients></LinearFunction></x_location><x_coordinate>elv</x_coordinate>
          <y_location><Constant><value>0</value></Constant></y_location><y_coordinate>elv</y_coordinate>
          <z_location><Constant><value>0</value></Constant></z_location><z_coordinate>elv</z_coordinate></MovingPathPoint>
        <ConditionalPathPoint name="c"><body>arm</body><location>0.3 0 0</location><coordinate>elv</coordinate><range>0 1</range></ConditionalPathPoint>
        </objects></PathPointSet></GeometryPath><max_isometric_force>10</max_isometric_force>
        <optimal_fiber_length>0.1</optimal_fiber_length><tendon_slack_length>0.1</tendon_slack_length>
        <pennation_angle>0.2</pennation_angle></Schutte1993Muscle></objects></ForceSet></Model></OpenSimDocument>)";
  const ForeignModel model = osimFromText(old, "old.osim");
  ASSERT_EQ(model.bodies.size(), 1u);
  EXPECT_EQ(model.bodies[0].inertia_B_kgm2.diagonal(), Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(model.coordinates[0].locked);
  EXPECT_EQ(model.musculature.units[0].pennation_angle_at_optimal_rad, 0.2);
  const ForeignPosture q = defaultPosture(model);
  const RigidTransform X = bodyPoses(model, q)[0];
  const Eigen::Vector2d along{std::cos(0.6), std::sin(0.6)};
  EXPECT_LT((X.translation().head<2>() - Eigen::Vector2d(0, 1) + 0.2 * along).norm(), 1e-12);
  const auto points = foreignPathPoints(model, 0, q);
  ASSERT_EQ(points.size(), 3u);
  EXPECT_LT((points[1].head<2>() - Eigen::Vector2d(0, 1) - 0.01 * along).norm(), 1e-12);  // 0.2 + 0.1 * 0.1 - 0.2
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_THAT(model.warnings[0].message, HasSubstr("Schutte1993Muscle"));
}

TEST(OsimReader, ComplainsWithLineElementExpectedAndFound) {
  EXPECT_THAT(complaint("<a>\n<b>\n</a>"), AllOf(HasSubstr("file.osim: line 3"), HasSubstr("well-formed")));
  EXPECT_THAT(complaint(""), HasSubstr("well-formed XML"));
  EXPECT_THAT(complaint("<mujoco/>"), AllOf(HasSubstr("OpenSimDocument"), HasSubstr("<mujoco>")));
  EXPECT_THAT(complaint("<OpenSimDocument Version=\"10600\"/>"), HasSubstr("20000"));
  std::string text = osimDocument(onePin());
  const auto without = [&](const std::string& part, const std::string& instead) {
    std::string broken = text;
    broken.replace(broken.find(part), part.size(), instead);
    return complaint(broken);
  };
  EXPECT_THAT(without("<mass>2</mass>", "<mass>heavy</mass>"),
              AllOf(HasSubstr("line 4"), HasSubstr("Body 'a'/mass"), HasSubstr("'heavy'")));
  EXPECT_THAT(without("<socket_parent>/ground<", "<socket_parent>/bodyset/A<"), HasSubstr("nearest: a"));
  EXPECT_THAT(without("<location>0 0.1 0</location>", ""), HasSubstr("<location>"));
  EXPECT_THAT(without("<location>0 0.1 0<", "<location>0 0.1<"), HasSubstr("expected 3 numbers, found 2"));
  EXPECT_THAT(without("<optimal_fiber_length>0.1<", "<optimal_fiber_length>-0.1<"), HasSubstr("a number > 0"));
  EXPECT_THAT(without("<Coordinate name=\"q\">", "<Coordinate>"), HasSubstr("a name"));
}

TEST(OsimReader, NamesWhatIsNotUsed) {
  OsimParts parts = onePin();
  parts.bodies = osimBody("a",
                          "<WrapObjectSet><objects><WrapTorus name=\"ring\"/><WrapEllipsoid name=\"egg\">"
                          "<dimensions>1 2 3</dimensions></WrapEllipsoid></objects></WrapObjectSet>");
  parts.joints += osimJoint("ScapulothoracicJoint", "s", "/ground", "/bodyset/b", {"s1"});
  parts.bodies += osimBody("b") + osimBody("loose");
  parts.constraints = "<WeldConstraint name=\"w\"/>";
  parts.forces = "<CoordinateActuator name=\"motor\"/>" +
                 osimMuscle("m", osimPoint("/ground", "0 0.1 0") + osimPoint("/bodyset/a", "0.1 0 0"),
                            "<PathWrap><wrap_object>ring</wrap_object></PathWrap>"
                            "<PathWrap><wrap_object>egg</wrap_object></PathWrap>");
  std::string all;
  for (const auto& w : osimFromText(osimDocument(parts), "file.osim").warnings) all += w.message + "\n";
  EXPECT_THAT(all, AllOf(HasSubstr("m does not wrap over 'ring': WrapTorus"), HasSubstr("ellipsoid 'egg'"),
                         HasSubstr("ScapulothoracicJoint 's'"), HasSubstr("'loose'"), HasSubstr("WeldConstraint 'w'"),
                         HasSubstr("CoordinateActuator")));
}

/// Moment arms in cm by another evaluator (central differences of path lengths of the same file).
struct PublishedArm {
  const char* muscle;
  const char* coordinate;
  double angle_deg;  ///< in the file's sign
  double arm_cm;     ///< about the file's coordinate
};

void compare(const ForeignModel& model, const std::vector<PublishedArm>& arms) {
  constexpr double kPrinted_cm = 0.007;  // two decimals, and a step of 0.01 rad
  for (const auto& arm : arms) {
    ForeignPosture q = defaultPosture(model);
    const int c = model.coordinateIndex(arm.coordinate);
    q[c] = arm.angle_deg * std::numbers::pi / 180;
    EXPECT_NEAR(100 * foreignMomentArm(model, model.musculature.unitIndex(arm.muscle), c, q), arm.arm_cm, kPrinted_cm)
        << arm.muscle << " " << arm.angle_deg;
  }
}

TEST(OsimFiles, Gait2392HasItsMomentArms) {
  SINEW_NEEDS_EXTERNAL("models/gait2392_thelen2003muscle.osim");
  const ForeignModel model = readOsim(external_file);
  EXPECT_EQ(model.musculature.units.size(), 92u);
  EXPECT_EQ(model.coordinates.size(), 23u);
  compare(model, {{"iliacus_r", "hip_flexion_r", -15, 3.57},  {"iliacus_r", "hip_flexion_r", 0, 3.94},
                  {"iliacus_r", "hip_flexion_r", 30, 4.32},   {"iliacus_r", "hip_flexion_r", 60, 4.46},
                  {"iliacus_r", "hip_flexion_r", 90, 3.38},   {"sar_r", "hip_flexion_r", -15, 2.9},
                  {"sar_r", "hip_flexion_r", 0, 4.51},        {"sar_r", "hip_flexion_r", 30, 7.1},
                  {"sar_r", "hip_flexion_r", 60, 8.28},       {"sar_r", "hip_flexion_r", 90, 7.28},
                  {"bifemlh_r", "hip_flexion_r", -15, -4.48}, {"bifemlh_r", "hip_flexion_r", 0, -5.67},
                  {"bifemlh_r", "hip_flexion_r", 30, -6.59},  {"bifemlh_r", "hip_flexion_r", 60, -5.73},
                  {"bifemlh_r", "hip_flexion_r", 90, -3.61},  {"rect_fem_r", "knee_angle_r", -5, 4.84},
                  {"rect_fem_r", "knee_angle_r", -30, 4.96},  {"rect_fem_r", "knee_angle_r", -60, 3.99},
                  {"rect_fem_r", "knee_angle_r", -90, 2.69},  {"rect_fem_r", "knee_angle_r", -110, 2.16},
                  {"vas_int_r", "knee_angle_r", -5, 4.57},    {"vas_int_r", "knee_angle_r", -30, 4.47},
                  {"vas_int_r", "knee_angle_r", -60, 3.73},   {"vas_int_r", "knee_angle_r", -90, 2.77},
                  {"vas_int_r", "knee_angle_r", -110, 2.28},  {"vas_lat_r", "knee_angle_r", -5, 4.23},
                  {"vas_lat_r", "knee_angle_r", -30, 4.55},   {"vas_lat_r", "knee_angle_r", -60, 3.53},
                  {"vas_lat_r", "knee_angle_r", -90, 2.85},   {"bifemlh_r", "knee_angle_r", -5, -2.96},
                  {"bifemlh_r", "knee_angle_r", -30, -3.48},  {"bifemlh_r", "knee_angle_r", -60, -3.06},
                  {"bifemlh_r", "knee_angle_r", -90, -1.74},  {"bifemlh_r", "knee_angle_r", -110, -0.48},
                  {"semiten_r", "knee_angle_r", -5, -4.02},   {"semiten_r", "knee_angle_r", -30, -4.6},
                  {"semiten_r", "knee_angle_r", -60, -4.75},  {"semiten_r", "knee_angle_r", -90, -3.54},
                  {"semiten_r", "knee_angle_r", -110, -2.02}, {"sar_r", "knee_angle_r", -5, -0.06},
                  {"sar_r", "knee_angle_r", -30, -0.89},      {"sar_r", "knee_angle_r", -60, -1.6},
                  {"sar_r", "knee_angle_r", -90, -2},         {"sar_r", "knee_angle_r", -110, -1.99},
                  {"med_gas_r", "knee_angle_r", -5, -2.17},   {"med_gas_r", "knee_angle_r", -30, -2.09},
                  {"med_gas_r", "knee_angle_r", -60, -1.78},  {"med_gas_r", "knee_angle_r", -90, -1.41},
                  {"med_gas_r", "knee_angle_r", -110, -1.06}, {"med_gas_r", "ankle_angle_r", -30, -4.56},
                  {"med_gas_r", "ankle_angle_r", -15, -4.76}, {"med_gas_r", "ankle_angle_r", 0, -4.63},
                  {"med_gas_r", "ankle_angle_r", 15, -4.21},  {"soleus_r", "ankle_angle_r", -30, -4.76},
                  {"soleus_r", "ankle_angle_r", -15, -4.8},   {"soleus_r", "ankle_angle_r", 0, -4.53},
                  {"soleus_r", "ankle_angle_r", 15, -4},      {"tib_ant_r", "ankle_angle_r", -30, 3.44},
                  {"tib_ant_r", "ankle_angle_r", -15, 3.88},  {"tib_ant_r", "ankle_angle_r", 0, 4.2},
                  {"tib_ant_r", "ankle_angle_r", 15, 4.35}});
}

TEST(OsimFiles, Arm26HasItsMomentArms) {
  SINEW_NEEDS_EXTERNAL("models/arm26.osim");
  const ForeignModel model = readOsim(external_file);
  EXPECT_EQ(model.musculature.units.size(), 6u);
  compare(model, {{"BICshort", "r_elbow_flex", 20, 2.10},
                  {"BICshort", "r_elbow_flex", 45, 3.40},
                  {"BICshort", "r_elbow_flex", 60, 4.05},
                  {"BICshort", "r_elbow_flex", 90, 4.88},
                  {"BICshort", "r_elbow_flex", 110, 4.85},
                  {"BICshort", "r_elbow_flex", 130, 4.03},
                  {"BRA", "r_elbow_flex", 20, 1.36},
                  {"BRA", "r_elbow_flex", 45, 1.25},
                  {"BRA", "r_elbow_flex", 60, 1.67},
                  {"BRA", "r_elbow_flex", 90, 2.27},
                  {"BRA", "r_elbow_flex", 110, 2.40},
                  {"TRIlat", "r_elbow_flex", 20, -2.41},
                  {"TRIlat", "r_elbow_flex", 60, -2.12},
                  {"TRIlat", "r_elbow_flex", 90, -1.99}});
}

}  // namespace
}  // namespace sinew
