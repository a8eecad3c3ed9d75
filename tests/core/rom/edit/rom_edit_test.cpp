#include "core/rom/edit/rom_edit.h"
#include "core/angle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/rom/edit/rom_edit_json.h"
#include "core/rom/edit/rom_edit_target.h"
#include "core/rom/maps/rom_map.h"
#include "core/rom/poses/pose_sampler.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/support/plain_model.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const Skeleton& skeleton() {
  static const Skeleton s = loadReferenceSkeleton(test::resourceDir());
  return s;
}
int jointOf(const char* name) {
  return skeleton().jointIndex(name);
}

RomTilt towards(const char* name, double deg) {
  return {.towards = name, .angle_rad = deg * kRadPerDeg};
}

/// Middles that are easy to calculate with: hinges at 50 degrees, twists at 0.1, cones about a direction of their
/// own.
RomCentres centres() {
  RomCentres c;
  for (const Joint& joint : skeleton().joints) {
    c.angle_rad.push_back(50 * kRadPerDeg);
    c.twist_rad.push_back(0.1);
    const bool ball = joint.type == JointType::Ball;
    const Eigen::Vector3d shaft =
        ball ? romMapFrame(skeleton(), static_cast<int>(&joint - skeleton().joints.data())).shaft_J
             : Eigen::Vector3d::UnitX();
    c.direction_J.push_back(rotationFromVector<double>(Eigen::Vector3d{0.2, -0.1, 0.5}) * shaft);
  }
  return c;
}
RomTransform transformOf(const RomEdits& edits) {
  return {skeleton(), centres(), edits};
}

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

TEST(RomEdit, AHingeScalesAboutItsMiddleAndShifts) {
  const int knee = jointOf("knee_r");
  const RomTransform t = transformOf({{.joint = "knee_r", .range_factor = 0.8, .shift_rad = 10 * kRadPerDeg}});
  // [0, 100] becomes [20, 100]: 40 instead of 50 to either side of 60.
  EXPECT_NEAR(t.hingeInverse(knee, 0), 20 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(t.hingeInverse(knee, 100 * kRadPerDeg), 100 * kRadPerDeg, 1e-12);
  // The paper's T(theta) = s (theta - phi) + phi + t, s = 1 / 0.8, t = -10 / 0.8.
  for (const double deg : {-20.0, 0.0, 33.0, 140.0})
    EXPECT_NEAR(t.hinge(knee, deg * kRadPerDeg), ((deg - 50) / 0.8 + 50 - 12.5) * kRadPerDeg, 1e-12);
}

TEST(RomEdit, ABallJointScalesItsConeAboutItsMiddleThenTilts) {
  const int hip = jointOf("hip_r");
  const Eigen::Vector3d centre = centres().direction_J[hip];
  const RomTransform t = transformOf({{.joint = "hip_r", .cone_factor = 0.5, .tilt = towards("forward", 30)}});
  const Eigen::Vector3d tilted = rotationAbout<double>(Eigen::Vector3d::UnitZ(), 30 * kRadPerDeg) * centre;
  EXPECT_NEAR(angleBetween(t.direction(hip, tilted).value(), centre), 0, 1e-9);
  // 20 degrees off the new middle ask the reference at 40 off the old one.
  const Eigen::Vector3d aside = rotationAbout<double>(tilted.unitOrthogonal(), 20 * kRadPerDeg) * tilted;
  EXPECT_NEAR(angleBetween(t.direction(hip, aside).value(), centre), 40 * kRadPerDeg, 1e-9);
  // Beyond 90 degrees the image would be beyond half a turn: outside.
  EXPECT_FALSE(t.direction(hip, -tilted).has_value());
  // Nothing is said about the twist.
  EXPECT_EQ(t.twist(hip, 0.7), 0.7);
}

TEST(RomEdit, TheInverseTakesPosturesBack) {
  const RomTransform t = transformOf({{.joint = "hip_r", .cone_factor = 0.7, .tilt = towards("outward", 12)},
                                      {.joint = "hip_r", .twist_factor = 0.8, .twist_shift_rad = 0.2},
                                      {.joint = "shoulder_l", .cone_factor = 0.9, .twist_factor = 0.9},
                                      {.joint = "elbow_r", .range_factor = 0.6, .shift_rad = -0.1}});
  for (const Posture& q : normalPostures(skeleton(), 40)) {
    const auto back = t.apply(t.inverse(q));
    ASSERT_TRUE(back.has_value());
    EXPECT_TRUE(back->isApprox(q, 1e-9)) << (*back - q).cwiseAbs().maxCoeff();
    const Posture moved = t.inverse(q);
    for (const Coordinate& c : skeleton().coordinates) {
      const int i = skeleton().coordinateIndex(c.name);
      EXPECT_TRUE(t.changes(c.joint) || moved[i] == q[i]) << c.name;
    }
  }
}

TEST(RomEdit, EditsComposeAboutTheMiddleThatThoseBeforeThemLeft) {
  const RomEdits narrow = {
      {.joint = "hip_r", .cone_factor = 0.8, .tilt = towards("forward", 20), .twist_factor = 0.5}};
  RomEdits back = narrow;
  back.push_back({.joint = "hip_r", .tilt = towards("forward", -20)});
  back.push_back({.joint = "hip_r", .cone_factor = 1 / 0.8, .twist_factor = 2});
  const RomTransform nothing = transformOf(back);
  for (const Posture& q : normalPostures(skeleton(), 10))
    EXPECT_TRUE(nothing.inverse(q).isApprox(q, 1e-9));  // within the range: nothing was cut off
  // A shift moves the middle about which the next edit scales.
  const RomTransform two =
      transformOf({{.joint = "knee_r", .shift_rad = 10 * kRadPerDeg}, {.joint = "knee_r", .range_factor = 0.5}});
  const RomTransform one = transformOf({{.joint = "knee_r", .range_factor = 0.5, .shift_rad = 10 * kRadPerDeg}});
  EXPECT_NEAR(two.hinge(jointOf("knee_r"), 0.3), one.hinge(jointOf("knee_r"), 0.3), 1e-12);
}

TEST(RomEdit, WhatIsWantedIsTheReferencesAnswerAtT) {
  const Model model = loadReferenceModel(test::resourceDir());
  const RomTransform t = transformOf({{.joint = "hip_r", .cone_factor = 0.63, .tilt = towards("forward", 30)},
                                      {.joint = "knee_r", .shift_rad = 5 * kRadPerDeg}});
  const Posture held = postureFromDegrees(model.skeleton, {{"knee_flexion_r", 60}});
  const RomMap wanted = editedRomMap(model, t, "hip_r", held);
  const Joint& hip = model.skeleton.joints[jointOf("hip_r")];
  int valid = 0, differing = 0;
  for (int i = 0; i < RomMap::kCells; i += 13) {
    Posture q = held;
    q.segment<3>(hip.first_coordinate) = vectorFromRotation(wanted.R_JB(i / 1296, i / 36 % 36, i % 36));
    const auto v = editedValidity(model, t, q);
    valid += wanted.valid[i];
    differing += (v && v->valid) != bool(wanted.valid[i]);
  }
  EXPECT_GT(valid, 10);
  EXPECT_EQ(differing, 0);
}

TEST(RomEdit, NamesOfTiltsMeanTheSameOnEitherSide) {
  for (const char* name : {"forward", "outward", "hip_flexion", "hip_adduction"}) {
    const Eigen::Vector3d right = tiltVector_J(skeleton(), jointOf("hip_r"), towards(name, 10), "test");
    const Eigen::Vector3d left = tiltVector_J(skeleton(), jointOf("hip_l"), towards(name, 10), "test");
    EXPECT_TRUE(left.isApprox(mirroredAxis(right), 1e-12)) << name;
  }
  const Eigen::Vector3d forward = tiltVector_J(skeleton(), jointOf("hip_r"), towards("forward", 10), "test");
  EXPECT_TRUE(
      forward.isApprox(tiltVector_J(skeleton(), jointOf("hip_r"), towards("hip_flexion", 10), "test"), 1e-12));
  EXPECT_EQ(twistSign(skeleton(), jointOf("hip_r")), -twistSign(skeleton(), jointOf("hip_l")));
}

TEST(RomEdit, WhatCannotBeDoneIsSaid) {
  const auto check = [](const RomEdit& e) { return [e] { checkRomEdits(skeleton(), {e}, "edits"); }; };
  EXPECT_THAT(check({.joint = "hipr"}), ThrowsMessage<InputError>(AllOf(HasSubstr("edits"), HasSubstr("hip_r"))));
  EXPECT_THAT(check({.joint = "root"}), ThrowsMessage<InputError>(HasSubstr("a joint of the model")));
  EXPECT_THAT(check({.joint = "knee_r", .cone_factor = 0.5}), ThrowsMessage<InputError>(HasSubstr("hinge")));
  EXPECT_THAT(check({.joint = "hip_r", .shift_rad = 0.1}), ThrowsMessage<InputError>(HasSubstr("ball joint")));
  EXPECT_THAT(check({.joint = "hip_r", .cone_factor = 0}), ThrowsMessage<InputError>(HasSubstr("0.05 to 5")));
  EXPECT_THAT(check({.joint = "hip_r", .cone_factor = std::nan("")}),
              ThrowsMessage<InputError>(HasSubstr("0.05 to 5")));
  EXPECT_THAT(check({.joint = "hip_r", .tilt = towards("forwards", 10)}),
              ThrowsMessage<InputError>(HasSubstr("forward")));
  // The arm hangs down: nothing can be tilted that way.
  EXPECT_THAT(check({.joint = "shoulder_r", .tilt = towards("down", 10)}),
              ThrowsMessage<InputError>(HasSubstr("outward")));
  EXPECT_THAT(check({.joint = "hip_r", .tilt = {.angle_rad = 0.1}}), ThrowsMessage<InputError>(HasSubstr("axis")));
}

TEST(RomEditFile, EditsComeBackAsTheyWere) {
  const test::TemporaryFolder folder;
  const RomEdits edits = {{.joint = "hip_r", .cone_factor = 0.63, .tilt = towards("forward", 30)},
                          {.joint = "shoulder_l", .twist_factor = 1.1, .twist_shift_rad = 0.123456789},
                          {.joint = "hip_l", .tilt = {.axis_J = {0, 0.6, 0.8}, .angle_rad = -0.3}},
                          {.joint = "knee_r", .range_factor = 0.8, .shift_rad = -10 * kRadPerDeg}};
  saveRomEdits(edits, folder / "edits.json");
  EXPECT_EQ(loadRomEdits(folder / "edits.json", skeleton()), edits);
}

TEST(RomEditFile, ABadFileIsAnsweredWithWhereAndWhat) {
  const auto read = [](const std::string& edits) {
    return [=] {
      const Json json = parseJson(R"({"format": "sinew.rom_edits", "version": 1, "edits": )" + edits + "}", "e.json");
      romEditsFromJson(JsonReader{json, "e.json"}, skeleton());
    };
  };
  EXPECT_NO_THROW(read("[]")());
  for (const auto& [text, answer] : std::vector<std::pair<std::string, std::string>>{
           {R"([{"joint": "hip"}])", "hip_r"},
           {R"([{"joint": "hip_r", "cones": 1}])", "cones"},
           {R"([{"joint": "hip_r", "cone": "narrow"}])", "cone"},
           {R"([{"cone": 1}])", "joint"},
           {R"([{"joint": "hip_r", "tilt": {"deg": 3}}])", "towards"},
           {R"([{"joint": "hip_r", "tilt": {"about": [0, 0, 0], "deg": 3}}])", "axis"},
           {R"([{"joint": "hip_r", "tilt": {"towards": "forwrd", "deg": 3}}])", "forward"},
           {R"([{"joint": "knee_r", "scale": -1}])", "scale"},
           {R"([{"joint": "hip_r", "scale": 0.5}])", "ball joint"}})
    EXPECT_THAT(read(text), ThrowsMessage<InputError>(AllOf(HasSubstr("e.json"), HasSubstr(answer)))) << text;
  const Json other = parseJson(R"({"format": "sinew.model", "version": 1, "edits": []})", "e.json");
  EXPECT_THROW(romEditsFromJson(JsonReader{other, "e.json"}, skeleton()), InputError);
}

}  // namespace
}  // namespace sinew
