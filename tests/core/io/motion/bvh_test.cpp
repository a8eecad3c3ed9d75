#include "core/io/motion/bvh.h"

#include <gmock/gmock.h>

#include <numbers>
#include <random>

#include "core/error.h"
#include "core/io/motion/bvh_poses.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

using testing::HasSubstr;

constexpr double kDeg = std::numbers::pi / 180;

const Skeleton& skeleton() {
  static const Skeleton loaded = loadReferenceSkeleton(test::resourceDir());
  return loaded;
}

const std::string kTwoBones = R"(HIERARCHY
ROOT hip
{
  OFFSET 1 2 3
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT knee
  {
    OFFSET 0 -4 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 -3 0
    }
  }
}
MOTION
Frames: 2
Frame Time: 0.01
1 2 3 0 0 0 0 0 0
5 6 7 0 0 90 0 90 0
)";

TEST(Bvh, PosesByHand) {
  const BvhMotion motion = parseBvh(kTwoBones, "two.bvh");
  ASSERT_EQ(motion.joints.size(), 3u);
  EXPECT_EQ(motion.joints[2].name, "knee_end");
  EXPECT_DOUBLE_EQ(motion.frame_time_s, 0.01);
  const auto rest = bvhPoses(motion, -1);
  EXPECT_LT((rest[2].translation() - Eigen::Vector3d{1, -5, 3}).norm(), 1e-12);
  // The root turns by 90 about Y: X is now -Z, Z is now X. The knee turns by 90 about the root's X: down goes back.
  const auto moved = bvhPoses(motion, 1);
  EXPECT_LT((moved[0].translation() - Eigen::Vector3d{5, 6, 7}).norm(), 1e-12);
  EXPECT_LT((moved[1].translation() - Eigen::Vector3d{5, 2, 7}).norm(), 1e-12);
  EXPECT_LT((moved[2].translation() - Eigen::Vector3d{2, 2, 7}).norm(), 1e-12);
}

TEST(Bvh, TextGoesBothWays) {
  const BvhMotion motion = parseBvh(kTwoBones, "two.bvh");
  const BvhMotion back = parseBvh(bvhText(motion), "again");
  ASSERT_EQ(back.joints.size(), motion.joints.size());
  for (std::size_t i = 0; i < back.joints.size(); ++i) {
    EXPECT_EQ(back.joints[i].name, motion.joints[i].name);
    EXPECT_EQ(back.joints[i].parent, motion.joints[i].parent);
    EXPECT_EQ(back.joints[i].offset, motion.joints[i].offset);
  }
  EXPECT_EQ(back.channels, motion.channels);
}

std::string complaintAfter(const std::string& from, const std::string& to) {
  std::string text = kTwoBones;
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  try {
    parseBvh(text.replace(at, from.size(), to), "two.bvh");
  } catch (const InputError& error) {
    EXPECT_EQ(std::string{error.what()}.find('\n'), std::string::npos);
    return error.what();
  }
  return "accepted";
}

TEST(Bvh, RefusesBrokenFilesInOneLine) {
  EXPECT_THAT(complaintAfter("HIERARCHY", "BVH"), HasSubstr("two.bvh: line 1: expected 'HIERARCHY', found 'BVH'"));
  EXPECT_THAT(complaintAfter("OFFSET 0 -4 0", "OFFSET 0 x 0"), HasSubstr("line 8: expected a number, found 'x'"));
  EXPECT_THAT(complaintAfter("CHANNELS 3 Zrotation", "CHANNELS 3 Wrotation"),
              HasSubstr("line 9: expected a channel (Xposition .. Zrotation), found 'Wrotation'"));
  EXPECT_THAT(complaintAfter("Frames: 2", "Frames: -2"),
              HasSubstr("line 17: expected a number of frames, found '-2'"));
  EXPECT_THAT(complaintAfter("Frames: 2", "Frames: 9000000"), HasSubstr("so a longer file"));
  EXPECT_THAT(complaintAfter("0 90 0\n", "0 90"),
              HasSubstr("expected value 9 of 9 of frame 2, found the end of the file"));
  EXPECT_THAT(complaintAfter("0 90 0\n", "0 90 0 1\n"), HasSubstr("expected the end of the file after 2 frames"));
  EXPECT_THAT(complaintAfter("5 6 7", "5 nan 7"),
              HasSubstr("line 20: expected value 2 of 9 of frame 2, found 'nan'"));
  EXPECT_THAT(complaintAfter("    End Site", "    Stop"), HasSubstr("expected JOINT, End Site or }, found 'Stop'"));
}

TEST(Bvh, RefusesChainsThatNeverEnd) {
  std::string text = "HIERARCHY\nROOT a\n";
  for (int i = 0; i < 5000; ++i) text += "{ OFFSET 0 0 0 CHANNELS 0 JOINT a\n";
  EXPECT_THROW(parseBvh(text, "deep.bvh"), InputError);
}

/// Postures of an adult, all joints in motion, arms below the horizontal or not.
std::vector<Posture> somePostures() {
  std::mt19937_64 random{11};
  std::vector<Posture> postures;
  for (int n = 0; n < 6; ++n) {
    Eigen::VectorXd clinical = Eigen::VectorXd::Zero(skeleton().coordinateCount());
    for (int i = 0; i < clinical.size(); ++i) {
      const Coordinate& c = skeleton().coordinates[i];
      const double t = std::generate_canonical<double, 53>(random);
      clinical[i] = c.translational             ? t
                    : c.name.starts_with("pel") ? t - 0.5
                                                : 0.6 * std::lerp(c.normal_min_rad, c.normal_max_rad, t);
    }
    // A bent knee and elbow: with straight ones the file cannot tell where the limb is turned about itself.
    postures.push_back(postureFromClinical(skeleton(), clinical));
  }
  return postures;
}

TEST(ImportMotion, FindsThePosturesThatMadeTheFile) {
  const auto truth = somePostures();
  const BvhMotion written = motionFromPostures(skeleton(), truth, 0.01);
  const MotionImport import = importMotion(parseBvh(bvhText(written), "truth.bvh"), "truth.bvh", skeleton());
  ASSERT_EQ(import.poses.size(), truth.size());
  EXPECT_NEAR(import.scale, 0.01, 1e-6);  // the file is in centimetres
  EXPECT_LT(import.worst_deg, 0.05) << import.worst_segment;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const auto X = segmentPoses(skeleton(), truth[i]), Y = segmentPoses(skeleton(), import.poses.posture(i));
    for (std::size_t s = 0; s < X.size(); ++s) {
      EXPECT_LT((X[s].translation() - Y[s].translation()).norm(), 1e-3)
          << skeleton().segments[s].name;                                                      // a millimetre
      EXPECT_LT((X[s].linear() - Y[s].linear()).norm(), 0.01) << skeleton().segments[s].name;  // half a degree
    }
  }
}

TEST(ImportMotion, ABentKneeBendsOurKneeAlone) {
  BvhMotion motion = motionFromPostures(skeleton(), {zeroPosture(skeleton())}, 0.01);
  const auto knee = std::ranges::find(motion.joints, "RightLeg", &BvhJoint::name);
  const auto before = importMotion(motion, "a.bvh", skeleton()).poses.posture(0);
  motion.channels(knee->first_channel + 1, 0) += 40;  // X to the left: a positive turn takes the shank back
  const auto after = importMotion(motion, "b.bvh", skeleton()).poses.posture(0);
  const int index = skeleton().coordinateIndex("knee_flexion_r");
  EXPECT_NEAR((after[index] - before[index]) / kDeg, 40, 0.2);
  EXPECT_NEAR(after[skeleton().coordinateIndex("knee_flexion_l")],
              before[skeleton().coordinateIndex("knee_flexion_l")], 1e-3);
  EXPECT_LT((after - before).head(9).norm(), 0.02);  // root and hip stay
}

TEST(ImportMotion, NamesTheJointsThatAreMissing) {
  try {
    importMotion(parseBvh(kTwoBones, "two.bvh"), "two.bvh", skeleton());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                testing::AllOf(HasSubstr("two.bvh: joints"), HasSubstr("RightUpLeg"), HasSubstr("LeftHand")));
  }
}

/// Recorded motion of another skeleton: a person walks upright, knees bend one way, feet stay near the floor.
TEST(ImportMotion, AWalkLooksLikeWalking) {
  SINEW_NEEDS_EXTERNAL("motion/walk.bvh");
  const MotionImport import = importMotion(loadBvh(external_file), "walk.bvh", skeleton(), {.step = 4});
  EXPECT_EQ(import.frames, 132);
  ASSERT_EQ(import.poses.size(), 33u);
  EXPECT_LT(import.rms_deg, 5);  // hinges of ours against ball joints of theirs
  const auto range = [&](const char* name) {
    double low = 1e9, high = -1e9;
    for (std::size_t i = 0; i < import.poses.size(); ++i) {
      const double value = clinicalFromPosture(skeleton(), import.poses.posture(i))[skeleton().coordinateIndex(name)];
      low = std::min(low, value), high = std::max(high, value);
    }
    return std::pair{low / kDeg, high / kDeg};
  };
  for (const std::string side : {"_r", "_l"}) {
    const auto knee = range(("knee_flexion" + side).c_str());  // published gait: 0-10 to 60-65
    EXPECT_LT(knee.first, 25);
    EXPECT_GT(knee.second, 40);
    EXPECT_LT(knee.second, 85);
    const auto hip = range(("hip_flexion" + side).c_str());  // -10 to 30
    EXPECT_GT(hip.second - hip.first, 25);
    EXPECT_LT(hip.second - hip.first, 65);
  }
  for (const std::size_t i : {std::size_t{0}, import.poses.size() - 1}) {
    const auto X = segmentPoses(skeleton(), import.poses.posture(i));
    EXPECT_GT(X[skeleton().segmentIndex("head")].linear()(1, 1), 0.8);  // head up
  }
}

}  // namespace
}  // namespace sinew
