#include "core/model/model.h"

#include <gmock/gmock.h>

#include "core/file.h"
#include "core/muscle/muscle_path.h"
#include "core/skeleton/shape/bone_field.h"
#include "tests/support/postures.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using testing::HasSubstr;

const Model& reference() {
  static const Model model = loadReferenceModel(test::resourceDir());
  return model;
}

ShapeParameters someShape() {
  ShapeParameters shape;
  shape.pelvis_width = 0.95;
  shape.trunk_elongation = 1.05;
  shape.sides[0].femur = {1.08, 1.03, 0.97, 0.2, 0.05, -0.04};
  shape.sides[1].tibia.torsion_rad = -0.15;
  shape.sides[1].foot_scale = 1.1;
  return shape;
}

/// Largest difference of all path points over the unit lists, and of lengths.
void expectSameMuscles(const Musculature& a, const Musculature& b, double tolerance) {
  ASSERT_EQ(a.units.size(), b.units.size());
  for (std::size_t i = 0; i < a.units.size(); ++i) {
    const auto& u = a.units[i];
    const auto& v = b.units[i];
    EXPECT_EQ(u.name, v.name);
    EXPECT_EQ(u.group, v.group);
    EXPECT_EQ(u.source, v.source);
    EXPECT_NEAR(u.max_isometric_force_N, v.max_isometric_force_N, tolerance);
    EXPECT_NEAR(u.optimal_fiber_length_m, v.optimal_fiber_length_m, tolerance);
    EXPECT_NEAR(u.tendon_slack_length_m, v.tendon_slack_length_m, tolerance);
    EXPECT_NEAR(u.pennation_angle_at_optimal_rad, v.pennation_angle_at_optimal_rad, tolerance);
    ASSERT_EQ(u.path.size(), v.path.size());
    for (std::size_t p = 0; p < u.path.size(); ++p) {
      EXPECT_EQ(u.path[p].role, v.path[p].role);
      EXPECT_EQ(u.path[p].bone, v.path[p].bone);
      EXPECT_EQ(u.path[p].site, v.path[p].site);
      ASSERT_EQ(u.path[p].anchors.size(), v.path[p].anchors.size());
      for (std::size_t j = 0; j < u.path[p].anchors.size(); ++j) {
        EXPECT_EQ(u.path[p].anchors[j].segment, v.path[p].anchors[j].segment);
        EXPECT_NEAR(u.path[p].anchors[j].weight, v.path[p].anchors[j].weight, tolerance);
        EXPECT_LE((u.path[p].anchors[j].p_B - v.path[p].anchors[j].p_B).norm(), tolerance);
      }
    }
  }
}

void expectSameSkeleton(const Skeleton& a, const Skeleton& b, double tolerance) {
  ASSERT_EQ(a.segments.size(), b.segments.size());
  for (std::size_t i = 0; i < a.segments.size(); ++i) {
    EXPECT_EQ(a.segments[i].name, b.segments[i].name);
    EXPECT_EQ(a.segments[i].parent, b.segments[i].parent);
    EXPECT_NEAR(a.segments[i].mass_kg, b.segments[i].mass_kg, tolerance);
    EXPECT_LE((a.segments[i].p_BCom - b.segments[i].p_BCom).norm(), tolerance);
    EXPECT_LE((a.segments[i].inertia_B_kgm2 - b.segments[i].inertia_B_kgm2).norm(), tolerance);
  }
  ASSERT_EQ(a.coordinates.size(), b.coordinates.size());
  for (std::size_t i = 0; i < a.coordinates.size(); ++i) {
    EXPECT_EQ(a.coordinates[i].name, b.coordinates[i].name);
    EXPECT_EQ(a.coordinates[i].joint, b.coordinates[i].joint);
    EXPECT_EQ(a.coordinates[i].translational, b.coordinates[i].translational);
    EXPECT_NEAR(a.coordinates[i].normal_min_rad, b.coordinates[i].normal_min_rad, tolerance);
    EXPECT_NEAR(a.coordinates[i].athlete_max_rad, b.coordinates[i].athlete_max_rad, tolerance);
  }
  ASSERT_EQ(a.landmarks.size(), b.landmarks.size());
  for (std::size_t i = 0; i < a.landmarks.size(); ++i) {
    EXPECT_EQ(a.landmarks[i].name, b.landmarks[i].name);
    EXPECT_LE((a.landmarks[i].p_BL - b.landmarks[i].p_BL).norm(), tolerance);
  }
  // Joint frames and drivers: every segment, driven ones included, is in the same place at random postures.
  std::mt19937_64 random{3};
  for (int trial = 0; trial < 5; ++trial) {
    const Eigen::VectorXd clinical = test::randomClinical(a, random);
    const auto X = segmentPoses(a, postureFromClinical(a, clinical));
    const auto Y = segmentPoses(b, postureFromClinical(b, clinical));
    for (std::size_t i = 0; i < X.size(); ++i) EXPECT_LE((X[i].matrix() - Y[i].matrix()).norm(), 10 * tolerance);
  }
}

TEST(ReferenceModel, IsWhole) {
  EXPECT_EQ(reference().skeleton.segments.size(), 23u);
  EXPECT_EQ(reference().skeleton.coordinateCount(), 50);
  EXPECT_EQ(reference().musculature.units.size(), 282u);
  for (const auto* name : {"femur_r", "femur_l", "tibia_r", "tibia_l"})
    EXPECT_EQ(std::ranges::count(*reference().bones, name, &BoneMesh::bone), 1) << name;
  for (const auto& bone : *reference().bones) EXPECT_GT(signedVolume_m3(bone.mesh), 0) << bone.bone;
}

TEST(ModelFile, LoadsBackWhatWasSaved) {
  test::TemporaryFolder folder;
  Model model = deformedModel(reference(), someShape());
  model.name = "case";
  model.length_factors["semimembranosus_r"] = 0.93;
  saveModel(model, folder / "model.json");
  const Model loaded = loadModel(folder / "model.json", reference());
  EXPECT_EQ(loaded.name, model.name);
  EXPECT_EQ(loaded.length_factors, model.length_factors);
  const auto shape = toVector(loaded.shape), wanted = toVector(model.shape);
  for (std::size_t i = 0; i < shape.size(); ++i) EXPECT_NEAR(shape[i], wanted[i], 1e-12);
  expectSameSkeleton(loaded.skeleton, model.skeleton, 1e-12);  // text carries every digit
  expectSameMuscles(loaded.musculature, model.musculature, 1e-12);
  ASSERT_EQ(loaded.bones->size(), model.bones->size());
  for (std::size_t i = 0; i < loaded.bones->size(); ++i)
    EXPECT_EQ((*loaded.bones)[i].mesh.vertices, (*model.bones)[i].mesh.vertices);
}

TEST(ModelFile, CanBeAskedForByNameOrFile) {
  test::TemporaryFolder folder;
  saveModel(reference(), folder / "m.json");
  expectSameMuscles(loadModelByName("reference", test::resourceDir()).musculature, reference().musculature, 0);
  expectSameMuscles(loadModelByName((folder / "m.json").string(), test::resourceDir()).musculature,
                    reference().musculature, 1e-12);
  EXPECT_THROW(loadModelByName((folder / "absent.json").string(), test::resourceDir()), InputError);
}

class BrokenModelFile : public testing::Test {
 protected:
  /// Complaint after the first `from` in a sound file became `to`.
  std::string complaint(const std::string& from, const std::string& to) {
    saveModel(reference(), folder_ / "m.json");
    std::string text = readFile(folder_ / "m.json");
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    writeFileAtomically(folder_ / "m.json", text.replace(at, from.size(), to));
    try {
      loadModel(folder_ / "m.json", reference());
    } catch (const InputError& error) {
      EXPECT_EQ(std::string{error.what()}.find('\n'), std::string::npos);
      return error.what();
    }
    return "accepted";
  }
  test::TemporaryFolder folder_;
};

TEST_F(BrokenModelFile, IsAnsweredWithFileAndField) {
  EXPECT_THAT(complaint("\"version\": 1", "\"version\": 2"),
              HasSubstr("m.json: version: expected version 1, found 2"));
  EXPECT_THAT(complaint("sinew.model", "sinew.case"), HasSubstr("m.json: format"));
  EXPECT_THAT(complaint("\"mass_kg\"", "\"mass\""), HasSubstr("m.json: skeleton.segments[0]"));
  EXPECT_THAT(complaint("\"parent\": \"pelvis\"", "\"parent\": \"pelvsi\""), HasSubstr("nearest: pelvis"));
  EXPECT_THAT(complaint("\"optimal_fiber_length_m\": 0.", "\"optimal_fiber_length_m\": -0."),
              HasSubstr("m.json: muscles[0].optimal_fiber_length_m"));
  EXPECT_THAT(complaint("\"weight\": 0.5", "\"weight\": 0.4"), HasSubstr("anchors: expected weights with sum 1"));
  EXPECT_THAT(complaint("\"length_factors\": {}", "\"length_factors\": {\"soleus_r\": 1.1}"),
              HasSubstr("soleus_medial_r"));
  EXPECT_THAT(complaint("\"rotation\": [1.0, ", "\"rotation\": [2.0, "), HasSubstr("rotation matrix"));
  EXPECT_THAT(complaint("\"muscles\"", "\"muscels\""), HasSubstr("muscels"));
}

TEST_F(BrokenModelFile, CutOffAnywhereIsNotAccepted) {
  saveModel(reference(), folder_ / "m.json");
  const std::string whole = readFile(folder_ / "m.json");
  for (const double part : {0.0, 0.1, 0.5, 0.99}) {
    writeFileAtomically(folder_ / "m.json", whole.substr(0, static_cast<std::size_t>(part * whole.size())));
    EXPECT_THROW(loadModel(folder_ / "m.json", reference()), InputError);
  }
}

TEST(DeformedModel, OfTheIdentityIsTheReference) {
  const Model same = deformedModel(reference(), ShapeParameters{});
  expectSameMuscles(same.musculature, reference().musculature, 1e-12);
  expectSameSkeleton(same.skeleton, reference().skeleton, 1e-12);
  EXPECT_EQ(same.bones, reference().bones);  // shared, not copied
}

TEST(DeformedModel, UniformScalingOfTheLegScalesItsMuscles) {
  ShapeParameters shape;
  auto& side = shape.sides[0];
  for (LimbBoneShape* limb : {&side.femur, &side.tibia}) *limb = {1.1, 1.1, 1.1, 0, 0, 0};
  side.foot_scale = 1.1;
  const Model large = deformedModel(reference(), shape);
  for (const auto* name : {"soleus_medial_r", "gastrocnemius_medial_r", "biceps_femoris_short_head_r",
                           "vastus_lateralis_inferior_r", "tibialis_anterior_r"}) {
    const auto& before = reference().musculature.unit(name);
    const auto& after = large.musculature.unit(name);
    EXPECT_NEAR(after.optimal_fiber_length_m / before.optimal_fiber_length_m, 1.1, 1e-9) << name;
    EXPECT_NEAR(after.tendon_slack_length_m / before.tendon_slack_length_m, 1.1, 1e-9) << name;
    EXPECT_EQ(after.max_isometric_force_N, before.max_isometric_force_N);
  }
  EXPECT_NEAR(large.musculature.unit("soleus_medial_l").optimal_fiber_length_m,
              reference().musculature.unit("soleus_medial_l").optimal_fiber_length_m, 1e-12);
}

TEST(DeformedModel, AttachmentsRideOnTheirBones) {
  const ShapeParameters shape = someShape();
  const Model model = deformedModel(reference(), shape);
  const auto& before = reference().musculature.unit("adductor_magnus_ischiocondylar_r").path.back().anchors[0];
  const auto& after = model.musculature.unit("adductor_magnus_ischiocondylar_r").path.back().anchors[0];
  EXPECT_LE((after.p_B - deform(reference().skeleton, toVector(shape), before.segment, before.p_B)).norm(), 1e-15);
  EXPECT_GT((after.p_B - before.p_B).norm(), 0.02);  // 8 % of a femur
}

TEST(DeformedModel, ARefusedShapeNamesTheParameter) {
  ShapeParameters shape;
  shape.sides[0].femur.elongation = 0.1;
  try {
    deformedModel(reference(), shape);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("femur_r.elongation"));
  }
}

std::vector<std::string> codes(const Model& model) {
  std::vector<std::string> result;
  for (const auto& warning : validateModel(model)) result.push_back(warning.code);
  return result;
}

TEST(ValidateModel, HasNothingAgainstTheReference) {
  for (const auto& warning : validateModel(reference())) ADD_FAILURE() << warning.code << ": " << warning.message;
}

TEST(ValidateModel, FindsWhatIsBroken) {
  const auto broken = [](auto change) {
    Model model = reference();
    change(model);
    return codes(model);
  };
  using testing::Contains;
  EXPECT_THAT(broken([](Model& m) { m.musculature.units[3].path[0].anchors[0].weight = 0.9; }),
              Contains("muscle_weights"));
  EXPECT_THAT(broken([](Model& m) { m.musculature.units[3].path[0].anchors[0].p_B.x() += 1e-6; }),
              Contains("muscle_mirror"));
  EXPECT_THAT(broken([](Model& m) { m.musculature.units[3].path[0].anchors[0].segment = 99; }),
              Contains("muscle_anchor"));
  EXPECT_THAT(broken([](Model& m) { m.musculature.units[3].optimal_fiber_length_m = 0; }),
              Contains("muscle_parameters"));
  EXPECT_THAT(broken([](Model& m) { m.musculature.units[3].optimal_fiber_length_m *= 0.5; }),
              Contains("muscle_standing_fiber"));
  EXPECT_THAT(broken([](Model& m) { m.musculature.units.pop_back(); }), Contains("muscle_side_missing"));
  EXPECT_THAT(broken([](Model& m) { m.musculature.units[1].name = m.musculature.units[0].name; }),
              Contains("muscle_name"));
  EXPECT_THAT(broken([](Model& m) { m.skeleton.segments[0].mass_kg = 0; }), Contains("segment_mass"));
  EXPECT_THAT(broken([](Model& m) { m.length_factors["nobody"] = 1; }), Contains("length_factor"));
  EXPECT_THAT(broken([](Model& m) { m.musculature.units[3].pennation_angle_at_optimal_rad = 1.6; }),
              Contains("muscle_parameters"));
  EXPECT_THAT(broken([](Model& m) { m.musculature.units[3].max_isometric_force_N *= 1.1; }),
              Contains("muscle_sides_differ"));
  EXPECT_THAT(
      broken([](Model& m) { std::swap(m.musculature.units[3].path.front(), m.musculature.units[3].path.back()); }),
      Contains("muscle_path"));
  EXPECT_THAT(broken([](Model& m) { m.skeleton.coordinates[7].axis *= 1.01; }), Contains("coordinate_axis"));
  EXPECT_THAT(broken([](Model& m) { m.skeleton.coordinates[7].axis = m.skeleton.coordinates[8].axis; }),
              Contains("coordinate_axis"));
  EXPECT_THAT(broken([](Model& m) { m.skeleton.coordinates[9].normal_max_rad = -1; }), Contains("coordinate_limits"));
  EXPECT_THAT(broken([](Model& m) { m.skeleton.joints[2].coordinate_count = 2; }), Contains("joint_coordinates"));
  EXPECT_THAT(broken([](Model& m) { m.skeleton.radii[0].axis_U *= 2; }), Contains("driven_segment"));
  EXPECT_THAT(broken([](Model& m) {
                auto& path = m.musculature.units[3].path;
                for (auto& point : path) point.anchors = {path[0].anchors[0]};
              }),
              testing::AllOf(Contains("muscle_spans_no_joint"), Contains("muscle_path")));
}

}  // namespace
}  // namespace sinew
