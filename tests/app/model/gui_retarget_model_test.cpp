// The state behind the retargeting workspace, without a window.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <set>

#include "app/model/retarget/body_solver.h"
#include "app/model/retarget/design_files.h"
#include "app/model/retarget/factor_form.h"
#include "app/model/retarget/live_body.h"
#include "app/model/retarget/rom_edit_study.h"
#include "app/model/retarget/rom_handles.h"
#include "app/model/retarget/shape_form.h"
#include "core/angle.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/retarget.h"
#include "core/rom/poses/pose_sampler.h"
#include "tests/app/gui_support.h"
#include "tests/support/plain_model.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using test::waitUntil;
using ::testing::HasSubstr;

constexpr double kHalfStep_rad = 0.25 * kRadPerDeg + 1e-9;  // drags are rounded to half a degree
constexpr int kLimit_ms = 60'000;                           // a loaded machine

const ShapeField& fieldNamed(const std::string& part, const std::string& quantity) {
  for (const auto& field : shapeFields())
    if (field.part == part && field.quantity == quantity) return field;
  throw std::runtime_error{"no field " + part + "." + quantity};
}

TEST(ShapeForm, HasEveryParameterOnce) {
  std::multiset<int> places;
  for (const auto& field : shapeFields())
    for (int side = 0; side < (field.isSided() ? 2 : 1); ++side) places.insert(field.place[std::size_t(side)]);
  const int count = int(shapeParameterNames().size());
  ASSERT_EQ(int(places.size()), count);
  for (int i = 0; i < count; ++i) EXPECT_EQ(places.count(i), 1U) << shapeParameterNames()[std::size_t(i)];
}

TEST(ShapeForm, LinkedSidesChangeTogetherAndAnglesAreDegrees) {
  ShapeParameters shape;
  setShownValue(shape, fieldNamed("femur", "elongation"), 0, false, 1.2);
  EXPECT_EQ(shape.sides[0].femur.elongation, 1.2);
  EXPECT_EQ(shape.sides[1].femur.elongation, 1);
  EXPECT_FALSE(hasEqualSides(shape));
  setShownValue(shape, fieldNamed("tibia", "torsion"), 1, true, -30);
  EXPECT_NEAR(shape.sides[0].tibia.torsion_rad, -30 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(shape.sides[1].tibia.torsion_rad, -30 * kRadPerDeg, 1e-12);
  setShownValue(shape, fieldNamed("trunk", "bend"), 0, false, 12);
  EXPECT_NEAR(shownValue(shape, fieldNamed("trunk", "bend"), 0), 12, 1e-9);
  const std::string words = shapeInWords(shape).toStdString();
  EXPECT_THAT(words, HasSubstr("femur right length 1.20"));
  EXPECT_THAT(words, ::testing::Not(HasSubstr("femur left")));
  mirrorToLeft(shape);
  EXPECT_TRUE(hasEqualSides(shape));
}

TEST(DesignDocument, ADragIsOneStepAndARefusedValueNone) {
  DesignDocument document;
  int changed = 0, previewed = 0;
  QString refused;
  QObject::connect(&document, &DesignDocument::changed, [&] { ++changed; });
  QObject::connect(&document, &DesignDocument::previewed, [&] { ++previewed; });
  QObject::connect(&document, &DesignDocument::rejected, [&](const QString& m) { refused = m; });
  const auto neck = [](double v) { return [v](RetargetDesign& d) { d.body.shape.neck_elongation = v; }; };
  for (const double v : {1.1, 1.2, 1.3}) document.preview(neck(v));
  EXPECT_EQ(document.current().body.shape.neck_elongation, 1.3);
  EXPECT_FALSE(document.canUndo());
  EXPECT_TRUE(document.edit("Neck", neck(1.4)));
  EXPECT_EQ(changed, 1);
  EXPECT_EQ(previewed, 3);
  EXPECT_FALSE(document.edit("Neck", neck(1.4)));  // alters nothing
  EXPECT_FALSE(document.edit("Neck", neck(9)));
  EXPECT_THAT(refused.toStdString(), HasSubstr("neck.elongation"));
  EXPECT_EQ(document.current().body.shape.neck_elongation, 1.4);
  document.undo();
  EXPECT_EQ(document.current(), RetargetDesign{});
  EXPECT_FALSE(document.canUndo());
  document.redo();
  EXPECT_EQ(document.current().body.shape.neck_elongation, 1.4);
}

TEST(FactorForm, PartsStandForTheirSegments) {
  PhysicsFactors factors;
  setPartMass(factors, "femur", MassRule::Ratio, 1.5);
  EXPECT_EQ(factors.mass_ratios.at("femur_l"), 1.5);
  setPartMass(factors, "femur", MassRule::Factor, 2);
  EXPECT_TRUE(factors.mass_ratios.empty());
  factors.mass_factors["femur_l"] = 3;
  EXPECT_TRUE(partMass(factors, "femur").mixed);
  setPartMass(factors, "femur", MassRule::Volume, 1);
  EXPECT_EQ(factors, PhysicsFactors{});
  EXPECT_EQ(partMass(loadShapePreset(test::resourceDir(), "hulk").physics, "humerus").rule, MassRule::Ratio);
}

class RomHandlesTest : public ::testing::Test {
 protected:
  Skeleton skeleton = loadReferenceSkeleton(test::resourceDir());
  RomCentres centres = [this] {
    const auto count = skeleton.joints.size();
    RomCentres c{std::vector<double>(count, 0.5), std::vector<double>(count, 0.1),
                 std::vector<Eigen::Vector3d>(count, Eigen::Vector3d{0.5, -0.8, 0.1}.normalized())};
    return c;
  }();
  BallRange hip{centres.direction_J[0], 0.8, 0.1, -0.6, 0.9};
};

TEST_F(RomHandlesTest, TheConeGoesWhereItIsPulledAndTheTransformAgrees) {
  for (const char* joint : {"hip_r", "hip_l"}) {
    RomEdit edit{.joint = joint};
    const Eigen::Vector3d there = Eigen::Vector3d{0.9, -0.2, 0.3}.normalized();
    pullCentre(hip, there, edit);
    EXPECT_NEAR(edited(hip, edit, skeleton).centre_J.dot(there), 1, 1 - std::cos(kHalfStep_rad) + 1e-12);
    pullBorder(hip, Eigen::AngleAxisd{0.4, there.unitOrthogonal()} * there, skeleton, edit);
    EXPECT_NEAR(edit.cone_factor, 0.5, 0.011);  // hundredths, about a middle that is half a step off
    const int index = skeleton.jointIndex(joint);
    const RomTransform transform{skeleton, centres, {edit}};
    const TwistSwing moved = transform.ballInverse(index, {hip.twist_centre_rad, hip.centre_J});
    EXPECT_NEAR((moved.direction_J - edited(hip, edit, skeleton).centre_J).norm(), 0, 1e-9);
  }
}

TEST_F(RomHandlesTest, TwistAndHingeBecomeTheIntervalOfTheHandOnBothSides) {
  for (const std::string side : {"_r", "_l"}) {
    RomEdit edit{.joint = "hip" + side};
    const int hip_index = skeleton.jointIndex(edit.joint), sign = twistSign(skeleton, hip_index);
    setTwist(hip, -0.3, 0.4, sign, edit);
    const BallRange after = edited(hip, edit, skeleton);
    constexpr double kRounding_rad = 0.02;  // a hundredth of the width, half a degree
    EXPECT_NEAR(after.twist_low_rad, -0.3, kRounding_rad);
    EXPECT_NEAR(after.twist_high_rad, 0.4, kRounding_rad);
    const RomTransform transform{skeleton, centres, {edit}};
    EXPECT_NEAR(transform.ballInverse(hip_index, {hip.twist_low_rad, hip.centre_J}).twist_rad, after.twist_low_rad,
                1e-9);

    RomEdit knee{.joint = "knee" + side};
    const HingeRange before = hingeRange(skeleton, centres, skeleton.jointIndex(knee.joint));
    setHinge(before, 0, 1.5, knee);
    const HingeRange bent = edited(before, knee);
    EXPECT_NEAR(bent.low_rad, 0, kRounding_rad);
    EXPECT_NEAR(bent.high_rad, 1.5, kRounding_rad);
    EXPECT_NEAR(
        RomTransform(skeleton, centres, {knee}).hingeInverse(skeleton.jointIndex(knee.joint), before.high_rad),
        bent.high_rad, 1e-9);
  }
}

TEST_F(RomHandlesTest, EditsOfOneJointAreFoundFromTheLast) {
  RomEdits edits{{.joint = "hip_r", .cone_factor = 0.8}, {.joint = "knee_r", .range_factor = 0.7}};
  editOf(edits, "hip_r").cone_factor = 0.5;
  EXPECT_EQ(edits.size(), 2U);
  EXPECT_EQ(findEdit(edits, "hip_r")->cone_factor, 0.5);
  EXPECT_EQ(editsBefore(edits, "hip_r").size(), 1U);
  EXPECT_EQ(findEdit(edits, "hip_l"), nullptr);
  editOf(edits, "hip_l");
  dropIdentities(edits);
  EXPECT_EQ(edits.size(), 2U);
}

TEST_F(RomHandlesTest, TheConeOfAMapHasItsArea) {
  RomMap map{
      "hip_r", {-Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitX()}, std::vector<std::uint8_t>(RomMap::kCells)};
  for (int p = 0; p < 12; ++p)  // 12 of 36 rings: a cone of 60 degrees
    for (int a = 0; a < RomMap::kAzimuths; ++a)
      for (int t = 6; t < 12; ++t) map.valid[std::size_t(RomMap::cell(t, p, a))] = 1;
  const BallRange range = ballRange(map, centres, 0);
  EXPECT_NEAR(range.cone_rad, 60 * kRadPerDeg, 1e-9);
  EXPECT_NEAR(range.twist_low_rad, -60 * kRadPerDeg, 1e-9);
  EXPECT_NEAR(range.twist_high_rad, 60 * kRadPerDeg, 1e-9);
}

class BodySolverTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { test::coreApplication(); }
  /// Little to compute: two straight muscles, a handful of postures.
  static std::shared_ptr<const RetargetReference> plainReference() {
    Model model = test::plainModel();
    auto poses = std::make_shared<PoseSet>(model.skeleton, "test");
    for (const auto& posture : restingPostures(model.skeleton)) poses->add(posture);
    auto motions = loadJointMotions(test::resourceDir(), model.skeleton);
    return std::make_shared<const RetargetReference>(std::move(model), std::move(motions), std::move(poses));
  }
  void load() {
    solver.load(plainReference);
    ASSERT_TRUE(waitUntil([&] { return solver.reference() != nullptr; }, kLimit_ms));
  }
  BodySolver solver;
};

RetargetDesign longThighs(double elongation) {
  RetargetDesign design;
  design.body.name = "long";
  for (auto& side : design.body.shape.sides) side.femur.elongation = elongation;
  return design;
}

TEST_F(BodySolverTest, BonesComeFirstThenTheMuscles) {
  load();
  solver.preview(longThighs(1.3));
  ASSERT_TRUE(waitUntil([&] { return solver.naive() != nullptr; }, kLimit_ms));
  EXPECT_FALSE(solver.isCurrent());
  EXPECT_EQ(solver.body(), nullptr);  // a drag solves nothing
  solver.solve(longThighs(1.3));
  ASSERT_TRUE(waitUntil([&] { return solver.isCurrent(); }, kLimit_ms));
  EXPECT_EQ(solver.body()->design, longThighs(1.3));
  EXPECT_EQ(solver.body()->model->name, "long");
  EXPECT_EQ(solver.body()->model->shape.sides[0].femur.elongation, 1.3);
  ASSERT_EQ(solver.body()->changes.size(), 2U);
  EXPECT_GT(solver.body()->changes[0].length_factor, 1.2);
}

TEST_F(BodySolverTest, TheNewestDesignWins) {
  load();
  for (const double e : {1.1, 1.2, 1.3, 1.4}) solver.solve(longThighs(e));
  ASSERT_TRUE(waitUntil([&] { return solver.isCurrent() && !solver.isSolving(); }, kLimit_ms));
  EXPECT_EQ(solver.body()->design, longThighs(1.4));
  ASSERT_TRUE(waitUntil([&] { return solver.naive()->shape == longThighs(1.4).body.shape; }, kLimit_ms));
}

TEST_F(BodySolverTest, ABodyIsTheSameByWayOfAnother) {
  load();
  for (const double e : {0.8, 1.3}) {
    solver.solve(longThighs(e));
    ASSERT_TRUE(waitUntil([&] { return solver.isCurrent(); }, kLimit_ms));
  }
  const Model at_once = retarget(*solver.reference(), longThighs(1.3).body.shape).model;
  for (std::size_t u = 0; u < at_once.musculature.units.size(); ++u) {
    const auto &unit = solver.body()->model->musculature.units[u], &expected = at_once.musculature.units[u];
    EXPECT_EQ(unit.optimal_fiber_length_m, expected.optimal_fiber_length_m);
    EXPECT_EQ(unit.tendon_slack_length_m, expected.tendon_slack_length_m);
    for (std::size_t p = 0; p < unit.path.size(); ++p)
      EXPECT_EQ(unit.path[p].anchors.front().p_B, expected.path[p].anchors.front().p_B);
  }
}

TEST_F(BodySolverTest, AFailureIsToldAndTheNextDesignGoesOn) {
  load();
  RetargetDesign thin = longThighs(0.2);  // shorter than its heads: no bone
  for (auto& side : thin.body.shape.sides) side.femur.proximal_scale = side.femur.distal_scale = 1;
  solver.solve(thin);
  ASSERT_TRUE(waitUntil([&] { return !solver.problem().isEmpty() && !solver.isSolving(); }, kLimit_ms));
  EXPECT_THAT(solver.problem().toStdString(), HasSubstr("femur_r.elongation"));
  EXPECT_FALSE(solver.isCurrent());
  solver.solve(longThighs(1.1));
  ASSERT_TRUE(waitUntil([&] { return solver.isCurrent(); }, kLimit_ms));
  EXPECT_TRUE(solver.problem().isEmpty());
}

TEST_F(BodySolverTest, MassesStrengthsAndRangesFollowWithoutRetargeting) {
  load();
  RetargetDesign design = longThighs(1.2);
  solver.solve(design);
  ASSERT_TRUE(waitUntil([&] { return solver.isCurrent(); }, kLimit_ms));
  const auto before = solver.body();
  setPartMass(design.body.physics, "femur", MassRule::Ratio, 2);
  design.body.physics.strength_factors["front_of_thigh_r"] = 1.5;
  design.rom.push_back({.joint = "knee_r", .range_factor = 0.5});
  solver.solve(design);
  ASSERT_TRUE(waitUntil([&] { return solver.isCurrent(); }, kLimit_ms));
  const Model &model = *solver.body()->model, &reference = solver.reference()->model();
  const auto femur = std::size_t(model.skeleton.segmentIndex("femur_r"));
  EXPECT_NEAR(model.skeleton.segments[femur].mass_kg, 2 * reference.skeleton.segments[femur].mass_kg, 1e-9);
  EXPECT_NEAR(model.musculature.unit("front_of_thigh_r").max_isometric_force_N, 2250, 1e-6);
  ASSERT_TRUE(solver.body()->rom.has_value()) << solver.body()->rom_problem.toStdString();
  ASSERT_FALSE(solver.body()->rom->stops.empty());
  const auto width = [](const Model& m) {
    const Coordinate& c = m.skeleton.coordinates[std::size_t(m.skeleton.coordinateIndex("knee_flexion_r"))];
    return c.stop_max_rad - c.stop_min_rad;
  };
  EXPECT_NEAR(width(model), 0.5 * width(*solver.body()->base), 1e-6);
  solver.solve(before->design);  // an undo of both
  ASSERT_TRUE(waitUntil([&] { return solver.isCurrent() && solver.body()->design == before->design; }, kLimit_ms));
  EXPECT_FALSE(solver.body()->rom.has_value());
}

TEST_F(BodySolverTest, TheStudyOfAHingeFollowsADragAndThenTheBody) {
  load();
  solver.solve({});
  ASSERT_TRUE(waitUntil([&] { return solver.isCurrent(); }, kLimit_ms));
  RomEditStudy study;
  const RomEdits edits{{.joint = "knee_r", .shift_rad = -0.2}};
  study.ask(solver.reference(), solver.body(), "knee_r", edits);
  ASSERT_TRUE(waitUntil([&] { return study.picture().has_value(); }, kLimit_ms));
  const RomEditPicture& p = *study.picture();
  EXPECT_FALSE(p.is_ball);
  EXPECT_NEAR(p.hinge_wanted.high_rad, p.hinge_before.high_rad - 0.2, 1e-9);
  EXPECT_NEAR(p.hinge_reached.high_rad, p.hinge_before.high_rad, 1e-9);  // the body is not solved for it
}

TEST(LiveBody, IsTheDeformedModelBitForBitWhateverCameBefore) {
  const auto reference = std::make_shared<const Model>(loadReferenceModel(test::resourceDir()));
  LiveBody live{reference};
  std::vector<ShapeParameters> shapes(4);
  shapes[0].sides[0].femur.elongation = 1.2;
  shapes[1] = shapes[0];
  shapes[1].trunk_bend_rad = 0.1;
  shapes[1].sides[1].ulna.torsion_rad = 0.4;
  shapes[2] = loadShapePreset(test::resourceDir(), "child").shape;
  shapes[3] = shapes[2];
  shapes[3].sides[0].femur.distal_scale = 1.1;  // the patella follows
  for (const auto& shape : shapes) {
    const Model wanted = deformedModel(*reference, shape);
    const auto got = live.deformed(shape);
    ASSERT_EQ(got->bones->size(), wanted.bones->size());
    for (std::size_t b = 0; b < wanted.bones->size(); ++b)
      EXPECT_EQ((*got->bones)[b].mesh.vertices, (*wanted.bones)[b].mesh.vertices) << (*wanted.bones)[b].bone;
    for (std::size_t u = 0; u < wanted.musculature.units.size(); ++u) {
      const auto &a = got->musculature.units[u], &b = wanted.musculature.units[u];
      EXPECT_EQ(a.optimal_fiber_length_m, b.optimal_fiber_length_m) << b.name;
      EXPECT_EQ(a.tendon_slack_length_m, b.tendon_slack_length_m) << b.name;
      for (std::size_t p = 0; p < b.path.size(); ++p)
        EXPECT_EQ(a.path[p].anchors.front().p_B, b.path[p].anchors.front().p_B) << b.name;
    }
  }
  ShapeParameters broken;
  broken.sides[0].tibia.elongation = 0.2;
  EXPECT_THROW(live.deformed(broken), InputError);
  EXPECT_EQ(live.deformed(shapes[0])->shape, shapes[0]);
}

TEST(DesignFiles, RangesComeBackAndFormatsAreNamed) {
  const test::TemporaryFolder folder;
  const Skeleton skeleton = loadReferenceSkeleton(test::resourceDir());
  const RomEdits edits{{.joint = "hip_r", .cone_factor = 0.63, .tilt = {.towards = "forward", .angle_rad = 0.5}}};
  saveRanges(edits, folder / "ranges.json");
  const RomEdits back = loadRanges(folder / "ranges.json", skeleton);
  ASSERT_EQ(back.size(), 1U);
  EXPECT_EQ(back[0].cone_factor, 0.63);
  EXPECT_NEAR(back[0].tilt.angle_rad, 0.5, 1e-9);
  exportModel(test::plainModel(), folder / "model.xml");
  EXPECT_TRUE(std::filesystem::exists(folder / "model.xml"));
  EXPECT_FALSE(exportModel(test::plainModel(), folder / "model.osim").empty());
  EXPECT_TRUE(std::filesystem::exists(folder / "model.osim"));
  EXPECT_THROW(exportModel(test::plainModel(), folder / "model.docx"), InputError);
}

}  // namespace
}  // namespace sinew
