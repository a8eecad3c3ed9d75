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

TEST(AuditOfTheReference, LeavesNothingUnexplainedInTheLengthsOfAnAthlete) {
  EXPECT_THAT(outliers(loadReferenceModel(test::resourceDir(), "athlete")), testing::IsEmpty());
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
  for (const char* unit : {"soleus_medial_r", "gracilis_l", "multifidus_cervicis_r", "external_oblique_posterior_l",
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
  for (const double size : {0.75, 0.9, 1.15}) {
    std::vector<double> parameters = toVector(ShapeParameters{});
    for (double& p : parameters)
      if (p == 1) p = size;  // ratios; angles are 0
    Model model = deformedModel(reference(), shapeFromVector(parameters));
    const ModelAudit audit = auditModel(model, reference(), ranges());
    for (const auto& u : audit.units)
      EXPECT_NEAR(u.body_scale, size, 0.08) << u.name;  // the neck gets longer, not wider
    EXPECT_THAT(outliers(model), testing::IsEmpty()) << size;
    for (auto& unit : model.musculature.units) unit.max_isometric_force_N *= size * size;
    EXPECT_THAT(outliers(model), testing::IsEmpty()) << size;
    for (auto& unit : model.musculature.units) unit.optimal_fiber_length_m /= size * size;
    EXPECT_GT(outliers(model).size(), 50u) << size;  // fibres of the wrong body
  }
}

/// What an examination found short is not a mistake of the model; what it did not touch is judged as ever.
TEST(AuditOfAPatient, KnowsWhatTheExaminationChanged) {
  Model model = reference();
  auto& unit =
      model.musculature.units[static_cast<std::size_t>(model.musculature.unitIndex("gastrocnemius_medial_r"))];
  unit.optimal_fiber_length_m *= 0.9;
  unit.tendon_slack_length_m *= 0.9;
  EXPECT_THAT(outliers(model), testing::ElementsAre("gastrocnemius_medial_r standing_fiber"));
  model.length_factors[unit.name] = 0.9;
  EXPECT_THAT(outliers(model), testing::IsEmpty());
  unit.optimal_fiber_length_m *= 10;
  EXPECT_THAT(outliers(model), testing::Contains("gastrocnemius_medial_r fiber_of_published"));
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
