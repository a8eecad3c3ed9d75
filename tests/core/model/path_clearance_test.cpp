#include "core/model/path_clearance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/model/bone_contacts.h"
#include "core/rom/poses/range_postures.h"
#include "tests/support/plain_model.h"

namespace sinew {
namespace {

constexpr double kRadius_m = 0.05;
constexpr double kFacets_m = 0.001;  // an ellipsoid of 20 rings lies this much inside the true one

/// Ball about the knee centre, and a muscle from the femur to the tibia that passes it at a distance in front.
Model ballAndMuscle(double distance_m) {
  Model model = test::plainModel();
  const Skeleton& s = model.skeleton;
  auto bones = std::make_shared<std::vector<BoneMesh>>();
  bones->push_back({"ball_r", s.segmentIndex("tibia_r"),
                    test::ellipsoid(Eigen::Vector3d::Constant(kRadius_m), Eigen::Vector3d::Zero(), 20)});
  model.bones = bones;
  MusculotendonUnit unit = model.musculature.units.front();
  unit.path = {{PathPointRole::Origin, {test::anchorOn(s, "femur_r", {distance_m, -0.2, 0})}, "femur", ""},
               {PathPointRole::Insertion, {test::anchorOn(s, "tibia_r", {distance_m, -0.2, 0})}, "tibia", ""}};
  model.musculature.units = {unit};
  return model;
}

TEST(PathClearance, DepthIsThatOfTheStraightPathInTheBall) {
  for (const double distance_m : {0.0, 0.02, 0.045, 0.06}) {
    const Model model = ballAndMuscle(distance_m);
    const std::vector<Posture> standing{zeroPosture(model.skeleton)};
    const auto found = measurePenetration(model, BoneDistances{model}, standing, {.step_m = 0.0005});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].depth_m, std::max(0.0, kRadius_m - distance_m), kFacets_m) << distance_m;
    EXPECT_EQ(found[0].bone, distance_m < kRadius_m ? "ball_r" : "");
  }
}

TEST(PathClearance, TheDeepestPostureIsNamed) {
  const Model model = ballAndMuscle(0.06);  // clear when straight, through the ball when bent
  std::vector<Posture> postures(3, zeroPosture(model.skeleton));
  const int knee = model.skeleton.coordinateIndex("knee_flexion_r");
  postures[1][knee] = -0.6;
  postures[2][knee] = 0.6;
  const auto found = measurePenetration(model, BoneDistances{model}, postures);
  EXPECT_NEAR(found[0].depth_m, kRadius_m - 0.0046, kFacets_m);  // the chord passes the centre at 4.6 mm
  EXPECT_EQ(found[0].posture, 2);
  EXPECT_EQ(found[0].path_segment, 0);
}

TEST(PathClearance, BonesThatAUnitDoesNotSpanDoNotCount) {
  Model model = ballAndMuscle(0.02);
  auto bones = std::make_shared<std::vector<BoneMesh>>(*model.bones);
  bones->front().segment = model.skeleton.segmentIndex("hand_r");
  for (auto& v : bones->front().mesh.vertices) v.y() += 0.34;  // at the knee when the arm hangs
  model.bones = bones;
  const std::vector<Posture> standing{zeroPosture(model.skeleton)};
  EXPECT_EQ(measurePenetration(model, BoneDistances{model}, standing)[0].depth_m, 0);
}

TEST(BoneContacts, NameThePosturesInWhichNoPathCouldPass) {
  Model model = ballAndMuscle(0.06);
  const Skeleton& s = model.skeleton;
  const int femur = s.segmentIndex("femur_r"), tibia = s.segmentIndex("tibia_r");
  std::vector<Posture> postures(3, zeroPosture(s));
  postures[1][s.coordinateIndex("knee_flexion_r")] = 1.5;
  postures[2][s.coordinateIndex("knee_flexion_r")] = 0.8;
  const Eigen::Vector3d middle_T{0, -0.1, 0};
  const auto inFemur = [&](const Posture& q) -> Eigen::Vector3d {
    const auto X_WB = segmentPoses(s, q);
    return X_WB[std::size_t(femur)].inverse() * (X_WB[std::size_t(tibia)] * middle_T);
  };
  auto bones = std::make_shared<std::vector<BoneMesh>>();
  const auto ball = [&](const char* name, int segment, const Eigen::Vector3d& centre) {
    bones->push_back({name, segment, test::ellipsoid(Eigen::Vector3d::Constant(0.02), centre, 20)});
  };
  ball("shank_r", tibia, middle_T);
  ball("behind_r", femur, inFemur(postures[1]) + Eigen::Vector3d{0, 0.01, 0});  // met by the bent knee only
  ball("joint_r", femur, inFemur(postures[0]) + Eigen::Vector3d{0, 0.03, 0});   // met when standing
  model.bones = bones;
  const BoneDistances distances{model};
  BoneContacts contacts{model, distances, postures};
  EXPECT_EQ(contacts.posturesWithBonesApart(model.musculature.units.front()), (std::vector<int>{0, 2}));
}

TEST(PathClearance, AttachmentsAreMeasuredFromTheSurfaceOfTheirSegment) {
  const Model model =
      test::plainModel();  // ends 60 mm in front of an ellipsoid of half thickness 25 mm at its middle
  for (const auto& a : measureAttachments(model, BoneDistances{model})) {
    EXPECT_TRUE(a.origin_bone.starts_with("femur"));
    EXPECT_GT(a.origin_m, 0.035 - kFacets_m);
    EXPECT_LT(a.origin_m, 0.05);
  }
}

/// What is asked of the reference: ends within 3 mm of a bone, paths less than 2 mm inside in every posture that a
/// body can take. Where bones run into one another no posture is, and no path outside both.
TEST(PathClearance, ReferenceMusclesEndOnBonesAndRunOutsideThem) {
  const Model model = loadReferenceModel(test::resourceDir());
  const BoneDistances bones{model};
  for (std::size_t u = 0; const auto& a : measureAttachments(model, bones)) {
    const std::string& name = model.musculature.units[u++].name;
    EXPECT_LE(std::abs(a.origin_m), 0.003) << name;
    EXPECT_LE(std::abs(a.insertion_m), 0.003) << name;
  }
  const auto postures = rangePostures(model.skeleton, 15, 40);
  const auto found = measurePenetration(model, bones, postures);
  const auto clear = std::ranges::count_if(found, [](const PathPenetration& p) { return p.depth_m < 0.002; });
  std::printf("in all postures, bones in one another or not, %td of %zu units stay less than 2 mm inside any bone\n",
              clear, found.size());
  BoneContacts contacts{model, bones, postures};
  Model alone = model;
  for (std::size_t u = 0; u < found.size(); ++u) {
    const MusculotendonUnit& unit = model.musculature.units[u];
    EXPECT_LT(found[u].depth_m, 0.012) << unit.name;
    if (found[u].depth_m < 0.002 || unit.name.ends_with("_l")) continue;
    std::vector<Posture> possible;
    for (const int k : contacts.posturesWithBonesApart(unit)) possible.push_back(postures[std::size_t(k)]);
    EXPECT_GT(possible.size(), postures.size() * 7 / 10) << unit.name;
    alone.musculature.units = {unit};
    EXPECT_LT(measurePenetration(alone, bones, possible)[0].depth_m, 0.002) << unit.name;
  }
}

}  // namespace
}  // namespace sinew
