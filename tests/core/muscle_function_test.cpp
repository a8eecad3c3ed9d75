// What the reference muscles do, against anatomy and published moment arms (tables in tests/data).
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "core/csv_table.h"
#include "core/muscle/load_musculature.h"
#include "core/muscle/muscle_path.h"
#include "core/skeleton/clinical_angles.h"
#include "core/text.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

/// "elbow_flexion_r=90;hip_flexion_r=45"
std::map<std::string, double> degrees(const std::string& text) {
  std::map<std::string, double> result;
  std::istringstream terms{text};
  for (std::string term; std::getline(terms, term, ';');) {
    const auto equals = term.find('=');
    result[term.substr(0, equals)] = parseNumber(term.substr(equals + 1), text, "degrees");
  }
  return result;
}

class MuscleFunction : public testing::Test {
 protected:
  double momentArm(const std::string& muscle, const std::string& coordinate,
                   std::map<std::string, double> posture_deg) {
    const Kinematics k = clinicalKinematics(skeleton_, postureFromDegrees(skeleton_, posture_deg));
    return momentArms(musculature_.unit(muscle), k)[skeleton_.coordinateIndex(coordinate)];
  }
  const Skeleton skeleton_ = loadReferenceSkeleton(test::resourceDir());
  const Musculature musculature_ = loadMusculature(test::resourceDir(), skeleton_);
};

TEST_F(MuscleFunction, EveryPrincipalAndSecondaryMomentHasTheAnatomicalSign) {
  const CsvTable table{test::testDataDir() / "muscle_functions.csv",
                       "sinew.test.muscle_functions",
                       1,
                       {"muscle", "coordinate", "sign", "strength", "min_deg", "max_deg", "other_posture_deg"}};
  ASSERT_EQ(table.rowCount(), 276u);
  int principal = 0, kept = 0;
  for (std::size_t row = 0; row < table.rowCount(); ++row) {
    const auto& muscle = table.text(row, "muscle");
    const auto& coordinate = table.text(row, "coordinate");
    const double sign = table.text(row, "sign") == "+" ? 1 : -1;
    auto posture = degrees(table.text(row, "other_posture_deg"));
    EXPECT_GT(sign * momentArm(muscle, coordinate, posture), 0) << muscle << " " << coordinate;
    if (table.text(row, "strength") != "principal") continue;
    // Over the whole range, eleven angles: at least nine tenths right.
    int right = 0;
    const double low = table.number(row, "min_deg"), high = table.number(row, "max_deg");
    for (int i = 0; i <= 10; ++i) {
      posture[coordinate] = low + i * (high - low) / 10;
      right += sign * momentArm(muscle, coordinate, posture) > 0;
    }
    ++principal;
    kept += right >= 10;
  }
  EXPECT_EQ(principal, 177);
  EXPECT_GE(kept, 0.98 * principal);
}

TEST_F(MuscleFunction, MomentArmsLieInThePublishedRange) {
  const CsvTable table{
      test::testDataDir() / "moment_arms.csv",
      "sinew.test.moment_arms",
      1,
      {"muscle", "coordinate", "other_posture_deg", "angle_deg", "reference_cm", "min_cm", "max_cm"}};
  std::map<bool, std::pair<int, int>> inside;  // by leg or not: inside, all
  for (std::size_t row = 0; row < table.rowCount(); ++row) {
    const auto& coordinate = table.text(row, "coordinate");
    auto posture = degrees(table.text(row, "other_posture_deg"));
    posture[coordinate] = table.number(row, "angle_deg");
    const double arm_cm = 100 * momentArm(table.text(row, "muscle"), coordinate, posture);
    const bool leg =
        coordinate.starts_with("hip") || coordinate.starts_with("knee") || coordinate.starts_with("ankle");
    const bool in = arm_cm >= table.number(row, "min_cm") && arm_cm <= table.number(row, "max_cm");
    inside[leg].first += in;
    inside[leg].second += 1;
    const double reference_cm = table.number(row, "reference_cm");
    if (std::abs(reference_cm) >= 1.5) {
      EXPECT_GT(arm_cm * reference_cm, 0) << table.where(row);
    }
    if (!in)
      std::printf("outside: %s about %s at %s deg: %.2f cm\n", table.text(row, "muscle").c_str(), coordinate.c_str(),
                  table.text(row, "angle_deg").c_str(), arm_cm);
  }
  std::printf("inside: leg %d of %d, other %d of %d\n", inside[true].first, inside[true].second, inside[false].first,
              inside[false].second);
  EXPECT_GE(inside[true].first, 0.9 * inside[true].second);
  EXPECT_GE(inside[false].first, 0.9 * inside[false].second);
}

}  // namespace
}  // namespace sinew
