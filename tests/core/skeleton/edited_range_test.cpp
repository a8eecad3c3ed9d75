#include <gtest/gtest.h>

#include "core/angle.h"
#include "core/foreign/foreign_from_model.h"
#include "core/foreign/length_deviation.h"
#include "core/model/skeleton_json.h"
#include "core/rom/edit/rom_edit_solve.h"
#include "core/rom/edit/rom_edit_target.h"
#include "core/rom/maps/coordinate_range.h"
#include "core/rom/poses/pose_sampler.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

/// Without muscles: the stops alone.
const Model& bare() {
  static const Model model = [] {
    Model m = loadReferenceModel(test::resourceDir());
    m.musculature.units.clear();
    return m;
  }();
  return model;
}

RomTransform transformOf(const RomEdits& edits) {
  static const PoseSet poses = [] {
    const RomPreset preset = loadRomPreset(test::resourceDir(), kDefaultPreset, bare().skeleton);
    const ClinicalTests norms = loadClinicalTests(test::resourceDir(), bare().skeleton);
    return sampledPoseSet(bare().skeleton, preset, norms.tests, {.count = 2000});
  }();
  static const RomCentres centres = romCentres(bare().skeleton, poses.stream());
  return {bare().skeleton, centres, edits};
}

Model edited(const Model& before, const RomEdits& edits) {
  Model after = before;
  for (const RomEdit& e : edits) {
    const int joint = before.skeleton.jointIndex(e.joint);
    after.skeleton.joints[joint].edited = transformOf(edits).editedRange(joint);
  }
  return after;
}

const RomEdits kNarrowShoulder = {{.joint = "shoulder_r", .cone_factor = 0.7, .twist_factor = 0.8}};
const RomEdits kTiltedHip = {{.joint = "hip_r", .cone_factor = 0.63, .tilt = {"forward", {}, 30 * kRadPerDeg}}};

TEST(EditedRange, IsTheRangeBeforeAtT) {
  for (const RomEdits& edits : {kNarrowShoulder, kTiltedHip}) {
    const std::string& joint = edits.front().joint;
    const Posture zero = zeroPosture(bare().skeleton);
    const RomMap before = romMap(bare(), joint, zero), after = romMap(edited(bare(), edits), joint, zero),
                 wanted = editedRomMap(bare(), transformOf(edits), joint, zero);
    EXPECT_EQ(compare(after, wanted).differing(), 0) << joint;
    EXPECT_GT(after.validCount(), 0);
    EXPECT_LT(after.validCount(), before.validCount());  // both are narrower than before
  }
}

TEST(EditedRange, EditsOfAnEditedRangeCompose) {
  // V~(q) = V(T1(T2(q))). A tilt has no middle, so that both ways of saying it are the same.
  const RomEdits tilt = {{.joint = "hip_r", .tilt = {"outward", {}, 12 * kRadPerDeg}}};
  const RomEdits both = {kTiltedHip.front(), tilt.front()};
  Model twice = edited(bare(), kTiltedHip);
  const RomCentres centres{std::vector<double>(bare().skeleton.joints.size()),
                           std::vector<double>(bare().skeleton.joints.size()),
                           std::vector<Eigen::Vector3d>(bare().skeleton.joints.size(), Eigen::Vector3d::UnitX())};
  const int hip = bare().skeleton.jointIndex("hip_r");
  const Model once = twice;
  twice.skeleton.joints[hip].edited = RomTransform{once.skeleton, centres, tilt}.editedRange(hip);
  EXPECT_EQ(twice.skeleton.joints[hip].edited.steps.size(), 2u);
  const Posture zero = zeroPosture(bare().skeleton);
  EXPECT_EQ(compare(romMap(twice, "hip_r", zero), romMap(edited(bare(), both), "hip_r", zero)).differing(), 0);
}

TEST(EditedRange, MarginsAndClinicalRangesAskTheSame) {
  const Model model = edited(bare(), kNarrowShoulder);
  const Eigen::VectorXd clinical = Eigen::VectorXd::Zero(model.skeleton.coordinateCount());
  const int flexion = model.skeleton.coordinateIndex("shoulder_flexion_r");
  const Joint& shoulder = model.skeleton.joints[model.skeleton.jointIndex("shoulder_r")];
  const CoordinateRange range = muscleInducedRange(model, clinical, flexion);
  const CoordinateRange before = muscleInducedRange(bare(), clinical, flexion);
  ASSERT_FALSE(range.isEmpty());
  EXPECT_LT(range.high_rad, before.high_rad - 10 * kRadPerDeg);
  EXPECT_EQ(range.high_unit, -1);
  const auto valid = [&](double flexion_rad) {
    Eigen::VectorXd at = clinical;
    at[flexion] = flexion_rad;
    const Posture q = postureFromClinical(model.skeleton, at);
    const bool holds = validity(model.skeleton, model.musculature, q).valid;
    EXPECT_EQ(holds,
              ballStopMargin_rad(model.skeleton, shoulder,
                                 rotationFromVector<double>(q.segment<3>(shoulder.first_coordinate))) >= -1e-5);
    return holds;
  };
  EXPECT_TRUE(valid(range.high_rad));
  EXPECT_FALSE(valid(range.high_rad + 0.1 * kRadPerDeg));  // the end is found to 0.01 degrees
}

TEST(EditedRange, IsStoredWithTheSkeleton) {
  const Skeleton skeleton = edited(bare(), kTiltedHip).skeleton;
  const Json json = skeletonToJson(skeleton);
  const Skeleton back = skeletonFromJson(JsonReader{json, "skeleton"});
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
    EXPECT_EQ(back.joints[j].edited, skeleton.joints[j].edited) << skeleton.joints[j].name;
  EXPECT_FALSE(back.joints[std::size_t(skeleton.jointIndex("hip_r"))].edited.steps.empty());
  EXPECT_FALSE(skeletonToJson(bare().skeleton)["joints"][1].contains("edited_range"));
}

TEST(EditedRange, AnExportSaysThatItHasTheBox) {
  Model model = edited(loadReferenceModel(test::resourceDir()), kTiltedHip);
  model.musculature.units.resize(1);
  const LengthDeviation deviation = lengthDeviation(model, foreignFromModel(model));
  EXPECT_EQ(deviation.boxed_ranges, std::vector<std::string>{"hip_r"});
  EXPECT_NE(summaryText(deviation).find("edited ranges are exported as the box"), std::string::npos);
}

}  // namespace
}  // namespace sinew
