#include <gmock/gmock.h>

#include <numbers>

#include "core/foreign/foreign_evaluate.h"
#include "core/foreign/foreign_wrap.h"
#include "core/io/foreign/foreign_json.h"
#include "core/io/osim/osim_reader.h"
#include "tests/support/osim_text.h"

namespace sinew {
namespace {

using namespace test;
constexpr double kExact = 1e-12;
constexpr double kPi = std::numbers::pi;

TEST(ScalarFunction, ASimmSplineThroughACubicIsTheCubic) {
  const auto cubic = [](double x) { return 2 - x + 3 * x * x - 0.5 * x * x * x; };
  const std::vector<double> x = {-1, -0.2, 0.1, 1.3, 2};
  std::vector<double> y;
  for (const double v : x) y.push_back(cubic(v));
  const auto f = ScalarFunction::simmSpline(x, y);
  for (double v = -1; v <= 2; v += 0.05) {
    EXPECT_NEAR(f(v).value, cubic(v), kExact);
    EXPECT_NEAR(f(v).slope, -1 + 6 * v - 1.5 * v * v, 1e-11);
  }
}

TEST(ScalarFunction, ThreeKnotsAreAParabolaTwoALineAndEndsGoOnStraight) {
  const auto parabola = ScalarFunction::simmSpline({0, 1, 3}, {0, 1, 9});
  EXPECT_NEAR(parabola(2).value, 4, kExact);
  EXPECT_NEAR(parabola(5).value, 9 + 2 * 6, kExact);  // slope 6 at 3
  EXPECT_NEAR(parabola(-1).value, 0, kExact);         // slope 0 at 0
  const auto line = ScalarFunction::simmSpline({0, 2}, {1, 5});
  EXPECT_NEAR(line(-3).value, -5, kExact);
  EXPECT_NEAR(line(9).value, 19, kExact);
  EXPECT_NEAR(ScalarFunction::piecewiseLinear({0, 1, 2}, {0, 1, 0})(1.25).value, 0.75, kExact);
  EXPECT_NEAR(ScalarFunction::polynomial({1, 0, 2})(3).value, 11, kExact);
  EXPECT_NEAR(ScalarFunction::polynomial({1, 0, 2})(3).slope, 6, kExact);
  EXPECT_NEAR(ScalarFunction::polynomial({1, 0, 2}).times(-2)(3).value, -22, kExact);
}

/// One body on the ground.
ForeignModel bodyOn(const std::string& joint) {
  return osimFromText(osimDocument({.bodies = osimBody("b"), .joints = joint}), "test.osim");
}
Eigen::Matrix3d turn(const Eigen::Vector3d& axis, double angle) {
  return rotationAbout<double>(axis, angle);
}

TEST(ForeignJoints, EveryKindMovesAsOpenSimSays) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d xyz = turn(x, 0.3) * turn(y, -0.4) * turn(z, 0.5);
  struct Case {
    std::string kind;
    std::vector<std::string> coordinates;
    std::vector<double> q;
    Eigen::Matrix3d R;
    Eigen::Vector3d p;
    std::string more;
  };
  const std::vector<Case> cases = {
      {"WeldJoint", {}, {}, I, {0, 0, 0}, ""},
      {"PinJoint", {"a"}, {0.3}, turn(z, 0.3), {0, 0, 0}, ""},
      {"SliderJoint", {"a"}, {0.3}, I, {0.3, 0, 0}, ""},
      {"UniversalJoint", {"a", "b"}, {0.3, -0.4}, turn(x, 0.3) * turn(y, -0.4), {0, 0, 0}, ""},
      {"BallJoint", {"a", "b", "c"}, {0.3, -0.4, 0.5}, xyz, {0, 0, 0}, ""},
      {"GimbalJoint", {"a", "b", "c"}, {0.3, -0.4, 0.5}, xyz, {0, 0, 0}, ""},
      {"PlanarJoint", {"a", "b", "c"}, {0.3, -0.4, 0.5}, turn(z, 0.3), {-0.4, 0.5, 0}, ""},
      {"FreeJoint", {"a", "b", "c", "d", "e", "f"}, {0.3, -0.4, 0.5, 1, 2, 3}, xyz, {1, 2, 3}, ""},
      {"EllipsoidJoint",
       {"a", "b", "c"},
       {0.3, -0.4, 0.5},
       xyz,
       Eigen::Vector3d{1, 2, 3}.cwiseProduct(xyz * z),
       "<radii_x_y_z>1 2 3</radii_x_y_z>"}};
  for (const auto& c : cases) {
    const ForeignModel model =
        bodyOn(osimJoint(c.kind, "j", "/ground", "/bodyset/b", c.coordinates, c.more, "0 1 0"));
    EXPECT_TRUE(model.warnings.empty()) << c.kind;
    const Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(c.q.data(), std::ssize(c.q));
    const RigidTransform X = bodyPoses(model, q)[0];
    EXPECT_TRUE(X.linear().isApprox(c.R, kExact)) << c.kind;
    EXPECT_LT((X.translation() - c.p - Eigen::Vector3d{0, 1, 0}).norm(), kExact) << c.kind;
  }
}

const std::string kCustom =
    "<SpatialTransform>" +
    osimAxis("rotation1", "a", "0 0 -2", "<LinearFunction><coefficients>1 0.1</coefficients></LinearFunction>") +
    osimAxis("rotation2", "", "1 0 0", "<Constant><value>0.2</value></Constant>") +
    osimAxis("rotation3", "b", "0 1 0", "") +
    osimAxis("translation1", "a", "1 0 0",
             "<MultiplierFunction><function><SimmSpline><x>0 1 3</x><y>0 1 9</y></SimmSpline></function>"
             "<scale>2</scale></MultiplierFunction>") +
    osimAxis("translation2", "a b", "0 1 0", "<LinearFunction><coefficients>1 2 3</coefficients></LinearFunction>") +
    osimAxis("translation3", "b", "0 0 1",
             "<PolynomialFunction><coefficients>1 0 0</coefficients></PolynomialFunction>") +
    "</SpatialTransform>";

TEST(ForeignJoints, ACustomJointIsMadeOfFunctions) {
  const ForeignModel model = bodyOn(osimJoint("CustomJoint", "j", "/ground", "/bodyset/b", {"a", "b"}, kCustom));
  const RigidTransform X = bodyPoses(model, Eigen::Vector2d{2, 0.5})[0];
  EXPECT_LT((X.translation() - Eigen::Vector3d{2 * 4, 2 + 1 + 3, 0.25}).norm(), kExact);
  const Eigen::Matrix3d R = turn(-Eigen::Vector3d::UnitZ(), 2.1) * turn(Eigen::Vector3d::UnitX(), 0.2) *
                            turn(Eigen::Vector3d::UnitY(), 0.5);
  EXPECT_TRUE(X.linear().isApprox(R, kExact));
}

TEST(ForeignJoints, ABodyCanBeReachedBackwards) {
  // The joint's child is the ground: the body hangs on it the other way round.
  const ForeignModel model = bodyOn(osimJoint("PinJoint", "j", "/bodyset/b", "/ground", {"a"}, "", "0 1 0"));
  const RigidTransform X = bodyPoses(model, Eigen::VectorXd::Constant(1, 0.3))[0];
  EXPECT_TRUE(X.linear().isApprox(turn(Eigen::Vector3d::UnitZ(), -0.3), kExact));
  EXPECT_LT((X * Eigen::Vector3d{0, 1, 0}).norm(), kExact);
}

/// Thigh and shank on two pins, kneecap that follows the knee, and a muscle with points of every kind.
ForeignModel leg(const std::string& wraps = "", const std::string& wrap_objects = "") {
  const std::string moving =
      "<MovingPathPoint name=\"m\"><socket_parent_frame>/bodyset/shank</socket_parent_frame>"
      "<socket_x_coordinate>/jointset/knee/knee_angle</socket_x_coordinate>"
      "<socket_y_coordinate>/jointset/knee/knee_angle</socket_y_coordinate>"
      "<socket_z_coordinate>/jointset/knee/knee_angle</socket_z_coordinate>"
      "<x_location><SimmSpline><x>-2 -1 0 1</x><y>0.03 0.04 0.06 0.05</y></SimmSpline></x_location>"
      "<y_location><PiecewiseLinearFunction><x>-2 1</x><y>-0.04 -0.05</y></PiecewiseLinearFunction></y_location>"
      "<z_location><Constant><value>0.01</value></Constant></z_location></MovingPathPoint>";
  const std::string conditional =
      "<ConditionalPathPoint name=\"c\"><socket_parent_frame>/bodyset/thigh</socket_parent_frame>"
      "<location>0.06 -0.38 0</location><socket_coordinate>/jointset/knee/knee_angle</socket_coordinate>"
      "<range>-2 -1</range></ConditionalPathPoint>";
  return osimFromText(
      osimDocument(
          {.bodies = osimBody("thigh", wrap_objects) + osimBody("shank") + osimBody("patella"),
           .joints =
               osimJoint("PinJoint", "hip", "/ground", "/bodyset/thigh", {"hip_angle"}, "", "0 1 0") +
               osimJoint("PinJoint", "knee", "/bodyset/thigh", "/bodyset/shank", {"knee_angle"}, "", "0 -0.4 0") +
               osimJoint("PinJoint", "pf", "/bodyset/thigh", "/bodyset/patella", {"beta"}, "", "0.02 -0.4 0"),
           .constraints = "<CoordinateCouplerConstraint name=\"follow\"><coupled_coordinates_function><SimmSpline>"
                          "<x>-2 -1 0 1</x><y>-1.2 -0.7 0 0.6</y></SimmSpline></coupled_coordinates_function>"
                          "<independent_coordinate_names>knee_angle</independent_coordinate_names>"
                          "<dependent_coordinate_name>beta</dependent_coordinate_name>"
                          "<scale_factor>1.1</scale_factor></CoordinateCouplerConstraint>",
           .forces = osimMuscle("quad", osimPoint("/ground", "0.05 1.05 0") + conditional +
                                            osimPoint("/bodyset/patella", "0.03 0.02 0") + moving +
                                            osimPoint("/bodyset/shank", "0.03 -0.1 0")) +
                     osimMuscle("flexor",
                                osimPoint("/bodyset/thigh", "-0.05 -0.1 0.01") +
                                    osimPoint("/bodyset/shank", "-0.04 -0.1 -0.01"),
                                wraps)}),
      "leg.osim");
}

/// -dl/dq by central differences.
double differenceArm(const ForeignModel& model, int unit, int coordinate, ForeignPosture q) {
  constexpr double kStep = 1e-6;
  q[coordinate] += kStep;
  const double longer = foreignLength(model, unit, q);
  q[coordinate] -= 2 * kStep;
  return (foreignLength(model, unit, q) - longer) / (2 * kStep);
}

TEST(ForeignPaths, ConditionalPointsComeAndGoAndMovingPointsMove) {
  const ForeignModel model = leg();
  ForeignPosture q = defaultPosture(model);
  EXPECT_EQ(foreignPathPoints(model, 0, q).size(), 4u);
  q[1] = -1.5;
  const auto points = foreignPathPoints(model, 0, q);
  ASSERT_EQ(points.size(), 5u);
  EXPECT_LT((points[1] - Eigen::Vector3d{0.06, 0.62, 0}).norm(), kExact);
  const ForeignPosture all = coupledPosture(model, q);
  EXPECT_NEAR(all[2], 1.1 * ScalarFunction::simmSpline({-2, -1, 0, 1}, {-1.2, -0.7, 0, 0.6})(-1.5).value, kExact);
}

TEST(ForeignPaths, MomentArmsAreTheSlopesOfLengths) {
  const ForeignModel model = leg();
  for (const double knee : {-1.7, -0.9, -0.3, 0.4}) {
    ForeignPosture q = defaultPosture(model);
    q[0] = 0.3;
    q[1] = knee;
    for (int unit = 0; unit < 2; ++unit)
      for (int c = 0; c < 2; ++c)
        EXPECT_NEAR(foreignMomentArm(model, unit, c, q), differenceArm(model, unit, c, q), 1e-8);
    EXPECT_EQ(foreignMomentArm(model, 0, 2, q), 0);  // the kneecap does not move by itself
    EXPECT_TRUE(foreignMomentArms(model, q).row(0).head(2).isApprox(
        Eigen::RowVector2d{foreignMomentArm(model, 0, 0, q), foreignMomentArm(model, 0, 1, q)}));
  }
}

const std::string kCylinder =
    "<WrapObjectSet><objects><WrapCylinder name=\"roll\"><active>true</active><xyz_body_rotation>0 0 0"
    "</xyz_body_rotation><translation>0 -0.4 0</translation><quadrant>-x</quadrant><radius>0.05</radius>"
    "<length>0.2</length></WrapCylinder></objects></WrapObjectSet>";
const std::string kWrap =
    "<PathWrap name=\"w\"><wrap_object>roll</wrap_object><method>hybrid</method><range>-1 -1</range></PathWrap>";

TEST(ForeignWraps, APulleyHasItsRadiusAsMomentArm) {
  // The cylinder lies on the knee's axis; the muscle is level, so that its arm is the radius wherever it wraps.
  ForeignModel model = leg(kWrap, kCylinder);
  for (auto& point : model.paths[1].points) point.p_F[2].constant = 0;
  for (const double knee : {0.1, 0.3, 1.0, 2.0}) {
    ForeignPosture q = defaultPosture(model);
    q[1] = knee;
    EXPECT_NEAR(foreignMomentArm(model, 1, 1, q), 0.05 * -1, 1e-12) << knee;
  }
}

TEST(ForeignWraps, MomentArmsOverObstaclesAreTheSlopesOfLengths) {
  std::string sphere = kCylinder;
  sphere.replace(sphere.find("<radius>"), std::string::npos,
                 "<radius>0.05</radius></WrapSphere></objects></WrapObjectSet>");
  sphere.replace(sphere.find("WrapCylinder"), 12, "WrapSphere");
  for (const auto& [obstacle, tolerance_m] : {std::pair{kCylinder, 1e-8}, std::pair{sphere, 1e-6}}) {
    const ForeignModel model = leg(kWrap, obstacle);
    for (const double knee : {0.3, 0.9}) {
      ForeignPosture q = defaultPosture(model);
      q[1] = knee;
      ASSERT_EQ(foreignPathPoints(model, 1, q).size(), 4u);
      for (int c = 0; c < 2; ++c)
        EXPECT_NEAR(foreignMomentArm(model, 1, c, q), differenceArm(model, 1, c, q), tolerance_m);
    }
  }
}

TEST(ForeignWraps, LengthsAreThoseOfGeometry) {
  WrapObject roll{.name = "roll", .shape = WrapShape::Cylinder, .radii_m = {1, 1, 10}};
  // Two tangents of sqrt(3) and 60 deg of arc, climbing 3: the unrolled hypotenuse.
  const double flat = 2 * std::sqrt(3.0) + kPi / 3;
  const auto contact = wrapOver(roll, {-2, 0, 0}, {2, 0, 3});
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->length_m, std::hypot(flat, 3), kExact);
  EXPECT_FALSE(wrapOver(roll, {-2, 1.1, 0}, {2, 1.1, 0}));  // free
  EXPECT_FALSE(wrapOver(roll, {-0.5, 0, 0}, {2, 0, 0}));    // starts inside
  roll.side_axis = 1;
  roll.side_sign = -1;
  EXPECT_LT(wrapOver(roll, {-2, 0.5, 0}, {2, 0.5, 0})->p_OFirst.y(), 0);  // the long way, on its side
  WrapObject ball{.name = "ball", .shape = WrapShape::Ellipsoid, .radii_m = {1, 1, 1}};
  EXPECT_NEAR(wrapOver(ball, {-2, 0, 0}, {2, 0.0, 0})->length_m, flat, 1e-9);
  // Any direction: the angle between the ends less the two of the tangents.
  const Eigen::Vector3d s{-2, 0.2, 0.3}, e{1, 1.5, -0.6};
  const double angle = std::acos(s.normalized().dot(e.normalized()));
  const auto tangent = [](const Eigen::Vector3d& p) { return std::sqrt(p.squaredNorm() - 1); };
  const double arc = angle - std::acos(1 / s.norm()) - std::acos(1 / e.norm());
  EXPECT_NEAR(wrapOver(ball, s, e)->length_m, tangent(s) + tangent(e) + arc, 1e-9);
}

TEST(ForeignModelFile, JsonGivesTheSameModelBack) {
  const ForeignModel model = leg(kWrap, kCylinder);
  const std::string text = jsonText(foreignModelToJson(model));
  const Json json = parseJson(text, "test");
  const ForeignModel back = foreignModelFromJson(JsonReader{json, "test"});
  EXPECT_EQ(jsonText(foreignModelToJson(back)), text);
  ForeignPosture q = defaultPosture(model);
  q[1] = -1.2;
  EXPECT_EQ(foreignLengths(back, q), foreignLengths(model, q));
  Json broken = json;
  broken["muscles"][0]["points"][0]["body"] = "nowhere";
  EXPECT_THROW(foreignModelFromJson(JsonReader{broken, "test"}), InputError);
  Json unordered = json;
  std::swap(unordered["joints"][0], unordered["joints"][1]);  // the shank before the thigh
  EXPECT_THROW(foreignModelFromJson(JsonReader{unordered, "test"}), InputError);
  Json twice = json;
  twice["coordinates"][1]["name"] = twice["coordinates"][0]["name"];
  EXPECT_THROW(foreignModelFromJson(JsonReader{twice, "test"}), InputError);
}

TEST(ForeignEvaluate, ForcesFollowFromLengthsAndArms) {
  const ForeignModel model = leg();
  ForeignPosture q = defaultPosture(model);
  q[1] = -1.0;
  const PostureEvaluation e = evaluatePosture(model, q);
  EXPECT_EQ(e.length_m, foreignLengths(model, q));
  EXPECT_TRUE(e.passive_torque.isApprox(e.moment_arm_m.transpose() * e.passive_force_N));
  const MotionCurve curve = motionCurve(model, 0, foreignMotion(model, "knee_angle=-90:0"), 5);
  EXPECT_EQ(curve.angle_deg.front(), -90);
  EXPECT_EQ(curve.angle_deg.back(), 0);
  q[1] = -kPi / 4;
  EXPECT_NEAR(curve.moment_arm_m[2], foreignMomentArm(model, 0, 1, q), kExact);
  EXPECT_THROW(foreignMotion(model, "beta"), InputError);
  EXPECT_THROW(foreignMotion(model, "knee_angl"), InputError);
  EXPECT_THROW(foreignMotion(model, "knee_angle=0"), InputError);
}

}  // namespace
}  // namespace sinew
