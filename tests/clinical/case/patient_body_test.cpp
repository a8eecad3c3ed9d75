#include "clinical/case/patient_body.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "core/model/physical_scaling.h"
#include "core/posture/evaluate.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

const Model& reference() {
  static const Model model = loadReferenceModel(test::resourceDir());
  return model;
}

Patient weighing(std::optional<double> mass_kg, const std::string& born = "") {
  Patient patient;
  patient.mass_kg = mass_kg;
  patient.birth_date = born;
  return patient;
}

PhysicalExam examinedOn(const std::string& date) {
  PhysicalExam exam;
  exam.date = date;
  return exam;
}

/// The model of a case: bones of this shape, what the scaling rules make of the patient.
Model modelOf(const ShapeParameters& shape, const Patient& patient, const PhysicalExam& exam = {}) {
  return withPhysics(deformedModel(reference(), shape), reference(),
                     patientPhysics(patient, exam, shape, reference().skeleton));
}

/// All bones and the trunk by one factor.
ShapeParameters uniform(double L) {
  ShapeParameters shape;
  shape.pelvis_width = shape.pelvis_height = shape.pelvis_depth = L;
  shape.trunk_elongation = shape.trunk_expansion = shape.neck_elongation = shape.head_scale = L;
  for (auto& side : shape.sides) {
    for (LimbBoneShape* bone : {&side.femur, &side.tibia, &side.humerus, &side.ulna})
      bone->elongation = bone->proximal_scale = bone->distal_scale = L;
    side.foot_scale = side.hand_scale = L;
  }
  return shape;
}

double soleus_N(const Model& model) {
  return model.musculature.unit("soleus_medial_r").max_isometric_force_N;
}

TEST(PatientBody, HasTheEnteredMassAndForcesOfItsSize) {
  // A girl of 54 kg and 1.57 m: 0.9 of the reference's size, whose bones would carry 53.2 kg.
  constexpr double L = 0.9;
  const Model girl = modelOf(uniform(L), weighing(54));
  EXPECT_NEAR(bodyMass_kg(girl.skeleton), 54, 1e-9);
  EXPECT_NEAR(soleus_N(girl) / soleus_N(reference()), L * L, 1e-6);
  const auto hip = std::size_t(reference().skeleton.coordinateIndex("hip_flexion_r"));
  EXPECT_NEAR(girl.passive_moments[hip].lower_Nm / reference().passive_moments[hip].lower_Nm,
              54 / bodyMass_kg(reference().skeleton), 1e-9);
  // Weight alone is flesh: it makes nobody stronger.
  EXPECT_EQ(soleus_N(modelOf(uniform(L), weighing(80))), soleus_N(girl));
}

TEST(PatientBody, NotWeighedHasTheMassOfItsBones) {
  const Model model = modelOf(uniform(0.9), weighing({}));
  // The neck has no width of its own: 0.2 kg more than the cube of 0.9 of the reference.
  EXPECT_NEAR(bodyMass_kg(model.skeleton), bodyMass_kg(deformedModel(reference(), uniform(0.9)).skeleton), 1e-9);
  EXPECT_NEAR(bodyMass_kg(model.skeleton), 0.729 * bodyMass_kg(reference().skeleton), 0.3);
  const Warnings doubts = patientPhysicsDoubts(weighing({}), uniform(0.9), reference().skeleton);
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_EQ(doubts[0].code, "model_mass_unknown");
}

TEST(PatientBody, DoubtsOrRefusesAMassThatIsNotOfTheseBones) {
  EXPECT_TRUE(patientPhysicsDoubts(weighing(54), uniform(0.9), reference().skeleton).empty());
  const Warnings doubts = patientPhysicsDoubts(weighing(23), ShapeParameters{}, reference().skeleton);
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_EQ(doubts[0].code, "mass_unlike_bones");
  EXPECT_THROW(modelOf(uniform(0.6), weighing(400)), InputError);
}

TEST(PatientBody, IsAsOldAsOnTheDayOfTheExamination) {
  EXPECT_FALSE(ageYears(weighing(23, "2017-03-09"), examinedOn("")));
  EXPECT_FALSE(ageYears(weighing(23), examinedOn("2024-03-09")));
  EXPECT_NEAR(*ageYears(weighing(23, "2017-03-09"), examinedOn("2024-09-09")), 7.5, 1e-12);
  const ShapeParameters child = loadShapePreset(test::resourceDir(), "child").shape;
  const auto ir = std::size_t(reference().skeleton.coordinateIndex("hip_internal_rotation_r"));
  const auto stopOf = [&](const Model& model) { return model.skeleton.coordinates[ir].stop_max_rad; };
  EXPECT_GT(stopOf(modelOf(child, weighing(23, "2017-03-09"), examinedOn("2024-03-09"))),
            stopOf(modelOf(child, weighing(23))) + 0.1);
}

/// Passive moment of muscles, capsules and ligaments about one coordinate, bent hips and knees.
double passive_Nm(const Model& model, const char* coordinate, const std::map<std::string, double>& posture_deg) {
  const Posture q = postureFromDegrees(model.skeleton, posture_deg);
  return evaluatePosture(model.skeleton, model.musculature, q, model.passive_moments)
      .passive_torque[model.skeleton.coordinateIndex(coordinate)];
}

struct TestPosture {
  const char* coordinate;
  std::map<std::string, double> posture_deg;
};
/// Where the reference holds an examiner: popliteal angle, Staheli, Silfverskiold with the knee straight.
const TestPosture kTests[] = {{"knee_flexion_r", {{"hip_flexion_r", 90}, {"knee_flexion_r", 30}}},
                              {"hip_flexion_r", {{"hip_flexion_r", -10}}},
                              {"ankle_dorsiflexion_r", {{"ankle_dorsiflexion_r", 15}}}};

/// The examiner's torque is in proportion to the mass, and so is what a scaled body sets against it in every posture
/// (forces with the cross-section, arms with the length): it is examined like the reference, and not called long.
TEST(PatientBody, AScaledBodyIsExaminedLikeTheReference) {
  const double mass_kg = 0.9 * 0.9 * 0.9 * bodyMass_kg(reference().skeleton);
  const Model girl = modelOf(uniform(0.9), weighing(mass_kg));
  for (const TestPosture& test : kTests) {
    const double ours = passive_Nm(girl, test.coordinate, test.posture_deg) / mass_kg;
    const double adults =
        passive_Nm(reference(), test.coordinate, test.posture_deg) / bodyMass_kg(reference().skeleton);
    EXPECT_NEAR(ours, adults, 0.01 * std::abs(adults)) << test.coordinate;
  }
}

/// Not a scaled adult, but nearer to one than with an adult's maximal forces (which made fitting a healthy child's
/// examination lengthen its muscles).
TEST(PatientBody, AChildIsNotAsStiffAsAnAdult) {
  const ShapeParameters shape = loadShapePreset(test::resourceDir(), "child").shape;
  const Model child = modelOf(shape, weighing(23)), adult_forces = deformedModel(reference(), shape);
  for (const TestPosture& test : kTests) {
    const double adults =
        passive_Nm(reference(), test.coordinate, test.posture_deg) / bodyMass_kg(reference().skeleton);
    const double ratio = passive_Nm(child, test.coordinate, test.posture_deg) / 23 / adults;
    const double before = passive_Nm(adult_forces, test.coordinate, test.posture_deg) / 23 / adults;
    std::printf("%s: %.2f of the adult's moment a kilogram, %.2f with an adult's forces\n", test.coordinate, ratio,
                before);
    EXPECT_GT(ratio, 0.6) << test.coordinate;
    EXPECT_LT(ratio, 2) << test.coordinate;
    EXPECT_LT(ratio, before) << test.coordinate;
  }
}

}  // namespace
}  // namespace sinew
