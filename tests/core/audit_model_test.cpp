#include "core/model/audit_model.h"

#include <gmock/gmock.h>

#include <numbers>

#include "core/file.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using testing::HasSubstr;

const Model& reference() {
  static const Model model = loadReferenceModel(test::resourceDir());
  return model;
}
const AuditRanges& ranges() {
  static const AuditRanges loaded = loadAuditRanges(test::resourceDir(), reference().skeleton);
  return loaded;
}

/// "soleus_medial_r pcsa_cm2" of every outlier.
std::vector<std::string> outliers(const Model& model) {
  std::vector<std::string> names;
  for (const auto& f : auditModel(model, reference(), ranges()).findings)
    if (f.verdict == AuditVerdict::Outlier) names.push_back(f.unit + " " + f.quantity);
  return names;
}

TEST(AuditOfTheReference, LeavesNothingUnexplained) {
  const ModelAudit audit = auditModel(reference(), reference(), ranges());
  ASSERT_EQ(audit.units.size(), 282u);
  for (const auto& f : audit.findings)
    EXPECT_NE(f.verdict, AuditVerdict::Outlier)
        << f.unit << " " << f.quantity << " " << f.value << " not in " << f.low << " to " << f.high;
  for (const auto& what : audit.unjudged) ADD_FAILURE() << what << " is judged by no row";
  std::printf("judged %zu quantities: %ld inside, %ld explained\n", audit.findings.size(),
              audit.count(AuditVerdict::Inside), audit.count(AuditVerdict::Explained));
}

TEST(AuditOfTheReference, ShowsFiguresThatAreKnown) {
  const ModelAudit audit = auditModel(reference(), reference(), ranges());
  const auto soleus = std::ranges::find(audit.units, "soleus_medial_r", &AuditedUnit::name);
  EXPECT_DOUBLE_EQ(soleus->body_scale, 1);
  EXPECT_DOUBLE_EQ(soleus->pcsa_cm2, 3097.4 / 60);  // half of 103 cm2
  EXPECT_DOUBLE_EQ(soleus->published_fiber_length_m, 0.044);
  const auto whole = std::ranges::find_if(
      audit.findings, [](const auto& f) { return f.unit == "soleus_*_r" && f.quantity == "pcsa_cm2"; });
  ASSERT_NE(whole, audit.findings.end());
  EXPECT_DOUBLE_EQ(whole->value, 2 * 3097.4 / 60);
}

/// Mistakes that people make in tables.
TEST(AuditOfAFaultyModel, CatchesEverySeededFault) {
  const auto after = [](const char* unit, const auto& change) {
    Model model = reference();
    change(model.musculature.units[static_cast<std::size_t>(model.musculature.unitIndex(unit))]);
    return outliers(model);
  };
  using testing::Contains;
  using Unit = MusculotendonUnit;
  for (const char* unit : {"soleus_medial_r", "gracilis_l", "multifidus_cervicis_r", "external_oblique_middle_l",
                           "flexor_carpi_radialis_r", "trapezius_acromial_l"}) {
    const std::string name = unit;
    EXPECT_THAT(after(unit, [](Unit& u) { u.max_isometric_force_N *= 10; }),
                testing::AllOf(Contains(name + " force_of_published"), Contains(HasSubstr("pcsa_cm2"))))
        << unit;
    EXPECT_THAT(after(unit, [](Unit& u) { u.max_isometric_force_N /= 10; }), Contains(name + " force_of_published"))
        << unit;
    EXPECT_THAT(after(unit, [](Unit& u) { std::swap(u.optimal_fiber_length_m, u.tendon_slack_length_m); }),
                Contains(name + " tendon_to_fiber_of_published"))
        << unit;
    EXPECT_THAT(after(unit, [](Unit& u) { u.pennation_angle_at_optimal_rad = std::numbers::pi / 2; }),
                Contains(name + " parameters"))
        << unit;
    EXPECT_THAT(after(unit, [](Unit& u) { u.pennation_angle_at_optimal_rad = 80 * std::numbers::pi / 180; }),
                Contains(name + " pennation_deg"))
        << unit;
    for (const double factor : {100.0, 0.01, 10.0, 0.1, 1000.0}) {  // centimetres, millimetres, a slipped point
      EXPECT_THAT(after(unit, [&](Unit& u) { u.optimal_fiber_length_m *= factor; }),
                  Contains(name + " optimal_fiber_length_cm"))
          << unit << factor;
      EXPECT_THAT(after(unit,
                        [&](Unit& u) {
                          u.optimal_fiber_length_m *= factor;
                          u.tendon_slack_length_m *= factor;
                        }),
                  Contains(name + " fiber_of_published"))
          << unit << factor;
    }
    for (const double wrong : {std::nan(""), -0.1, 0.0, std::numeric_limits<double>::infinity()}) {
      EXPECT_THAT(after(unit, [&](Unit& u) { u.max_isometric_force_N = wrong; }), Contains(name + " parameters"));
      EXPECT_THAT(after(unit, [&](Unit& u) { u.optimal_fiber_length_m = wrong; }), Contains(name + " parameters"));
      EXPECT_THAT(after(unit, [&](Unit& u) { u.tendon_slack_length_m = wrong; }), Contains(name + " parameters"));
    }
    EXPECT_THAT(
        after(unit, [](Unit& u) { u.pennation_angle_at_optimal_rad *= -1, u.pennation_angle_at_optimal_rad -= 0.1; }),
        Contains(name + " parameters"));
    EXPECT_THAT(after(unit, [](Unit& u) { u.path[0].anchors[0].p_B *= 100; }), Contains(name + " path_of_reference"));
    EXPECT_THAT(after(unit, [](Unit& u) { u.path[0].anchors[0].p_B.x() = std::nan(""); }),
                Contains(name + " parameters"));
  }
}

/// A body of another size is judged at its own size, with forces that stayed and with forces that grew.
TEST(AuditOfAPatient, DoesNotMindTheSizeOfTheBody) {
  for (const double size : {0.75, 1.15}) {
    ShapeParameters shape;
    shape.trunk_elongation = shape.pelvis_width = shape.neck_elongation = size;
    for (auto& side : shape.sides) {
      for (LimbBoneShape* bone : {&side.femur, &side.tibia})
        bone->elongation = bone->proximal_scale = bone->distal_scale = size;
      side.foot_scale = size;
    }
    Model model = deformedModel(reference(), shape);
    const ModelAudit audit = auditModel(model, reference(), ranges());
    const auto leg = std::ranges::find(audit.units, "vastus_lateralis_superior_r", &AuditedUnit::name);
    EXPECT_NEAR(leg->body_scale, size, 0.02);
    const auto isLeg = [](const std::string& name) { return name.find("vastus") == 0 || name.find("soleus") == 0; };
    for (const double force : {1.0, size * size}) {
      Model scaled = model;
      for (auto& unit : scaled.musculature.units) unit.max_isometric_force_N *= force;
      for (const auto& what : outliers(scaled)) EXPECT_FALSE(isLeg(what)) << what << " at size " << size;
    }
  }
}

/// Units that nobody has heard of are neither judged nor a reason to stop.
TEST(AuditOfAModelWithOwnUnits, SaysWhatItCannotJudge) {
  Model model = reference();
  model.musculature.units[0].name = "my_muscle_r";
  const ModelAudit audit = auditModel(model, reference(), ranges());
  EXPECT_THAT(audit.unjudged, testing::Contains("my_muscle_r: pcsa_cm2"));
  EXPECT_TRUE(std::isnan(audit.units[0].pcsa_cm2));
}

class BrokenAuditTable : public testing::Test {
 protected:
  std::string complaintAfter(const std::string& file, const std::string& from, const std::string& to) {
    const auto muscles = folder_.path() / "muscles";
    std::filesystem::create_directories(muscles);
    for (const auto& entry : std::filesystem::directory_iterator{test::resourceDir() / "muscles"})
      std::filesystem::copy_file(entry.path(), muscles / entry.path().filename(),
                                 std::filesystem::copy_options::overwrite_existing);
    std::string content = readFile(muscles / file);
    const auto at = content.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    writeFileAtomically(muscles / file, content.replace(at, from.size(), to));
    try {
      loadAuditRanges(folder_.path(), reference().skeleton);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  test::TemporaryFolder folder_;
};

TEST_F(BrokenAuditTable, IsAnsweredWithLineAndField) {
  EXPECT_THAT(complaintAfter("literature_ranges.csv", "\ngracilis,pcsa_cm2,1.4", "\ngracilis,pcsa_cm2,9"),
              HasSubstr("low: expected at most high"));
  EXPECT_THAT(complaintAfter("literature_ranges.csv", "\ngracilis,pcsa_cm2", "\ngracillis,pcsa_cm2"),
              HasSubstr("units: expected names of muscles.csv"));
  EXPECT_THAT(complaintAfter("literature_ranges.csv", "\ngracilis,pcsa_cm2", "\ngracilis,pcsa_m2"),
              HasSubstr("quantity: expected a quantity of the audit"));
  EXPECT_THAT(complaintAfter("literature_ranges.csv", ",no,", ",maybe,"), HasSubstr("verified: expected yes or no"));
}

}  // namespace
}  // namespace sinew
