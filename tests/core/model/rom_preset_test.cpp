#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/csv_table.h"
#include "core/file.h"
#include "core/model/model.h"
#include "core/muscle/hill.h"
#include "core/muscle/load_musculature.h"
#include "core/muscle/muscle_path.h"
#include "core/posture/validity.h"
#include "core/rom/poses/fit_preset.h"
#include "core/rom/poses/range_postures.h"
#include "core/rom/tests/rom_report.h"
#include "core/rom/tests/threshold.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using testing::HasSubstr;

/// One preset as shipped: skeleton with its stops, muscles with its stored lengths.
struct Shipped {
  explicit Shipped(const std::string& name) {
    model.skeleton = loadReferenceSkeleton(test::resourceDir());
    preset = loadRomPreset(test::resourceDir(), name, model.skeleton);
    setStops(model.skeleton, preset);
    model.musculature = loadMusculature(test::resourceDir(), model.skeleton, name);
    norms = loadClinicalTests(test::resourceDir(), model.skeleton);
    report = romReport(model, norms, name, norms.reference_mass_kg);
  }
  double reading_deg(const std::string& id) const {
    return simulateTest(model, norms.test(id), 'r', norms.test(id).threshold_Nm).angle_deg;
  }

  Model model;
  RomPreset preset;
  ClinicalTests norms;
  RomReport report;
};

const Shipped& shipped(const std::string& name) {
  static const Shipped average{"average-adult"}, athlete{"athlete"};
  return name == "athlete" ? athlete : average;
}

class Preset : public testing::TestWithParam<std::string> {
 protected:
  const Shipped& s() const { return shipped(GetParam()); }
};

TEST_P(Preset, StoredLengthsAreWhatTheFitGives) {
  const Skeleton skeleton = loadReferenceSkeleton(test::resourceDir());
  const PresetFit fit =
      fitPreset(skeleton, loadPublishedMusculature(test::resourceDir(), skeleton), s().preset, s().norms);
  const test::TemporaryFolder folder;
  writeFileAtomically(folder / "fresh.csv", lengthsCsv(fit.lengths, ""));
  const std::vector<std::string> columns{"muscle", "optimal_fiber_length_m", "tendon_slack_length_m"};
  const CsvTable fresh{folder / "fresh.csv", "sinew.reference_lengths", 1, columns};
  const CsvTable stored{test::resourceDir() / "muscles" / lengthsFile(GetParam()), "sinew.reference_lengths", 1,
                        columns};
  ASSERT_EQ(fresh.rowCount(), stored.rowCount());
  for (std::size_t row = 0; row < fresh.rowCount(); ++row) {
    EXPECT_EQ(fresh.text(row, "muscle"), stored.text(row, "muscle"));
    for (const char* column : {"optimal_fiber_length_m", "tendon_slack_length_m"})  // last digit: other compilers
      EXPECT_NEAR(fresh.number(row, column), stored.number(row, column), 2e-6)
          << fresh.text(row, "muscle") << ": run sinew-fit-lengths";
  }
}

/// Every posture of the shipped set, every unit and every stop.
TEST_P(Preset, EveryPostureOfTheSetIsValid) {
  int invalid = 0, count = 0;
  samplePoses(s().model.skeleton, s().preset, s().norms.tests, {}, [&](const Eigen::MatrixXd& postures) {
    for (Eigen::Index i = 0; i < postures.cols(); ++i, ++count)
      invalid += !validity(s().model.skeleton, s().model.musculature, postures.col(i)).valid;
  });
  EXPECT_GE(count, 70000);
  EXPECT_EQ(invalid, 0);
}

TEST_P(Preset, NothingPullsInTheKeyPostures) {
  const auto key_postures = restingPostures(s().model.skeleton);
  for (std::size_t key = 0; key < key_postures.size(); ++key) {
    const auto X_WB = segmentPoses(s().model.skeleton, key_postures[key]);
    for (const MusculotendonUnit& unit : s().model.musculature.units) {
      const FiberState state = equilibrium(unit, pathLength(unit, X_WB), 0);
      EXPECT_LE(state.normalized_fiber_length, key == 0 ? 1.1 : 1.105) << unit.name;  // the first is standing
      EXPECT_LE(state.force_N, 0.0081 * unit.max_isometric_force_N) << unit.name;
    }
  }
}

/// A slack unit stands at the shortest fibre and carries nothing; no fibre is ever 0 or less.
TEST_P(Preset, SlackUnitsKeepTheirFibers) {
  double shortest = 10;
  samplePoses(s().model.skeleton, s().preset, s().norms.tests, {.count = 2000}, [&](const Eigen::MatrixXd& postures) {
    for (Eigen::Index i = 0; i < postures.cols(); ++i) {
      const auto X_WB = segmentPoses(s().model.skeleton, postures.col(i));
      for (const MusculotendonUnit& unit : s().model.musculature.units)
        for (const double activation : {0.0, 1.0}) {
          const FiberState state = equilibrium(unit, pathLength(unit, X_WB), activation);
          shortest = std::min(shortest, state.normalized_fiber_length);
          if (state.slack) {
            EXPECT_EQ(state.force_N, 0) << unit.name;
          }
        }
    }
  });
  EXPECT_GE(shortest, kShortestFiber - 1e-12);
}

/// Every target of the preset is reached before the examiner's moment.
TEST_P(Preset, TestsGetAsFarAsTheirTargets) {
  for (const RomTarget& target : s().preset.targets()) {
    const ClinicalTest& test = s().norms.test(target.test);
    const SimulatedTest reading = simulateTest(s().model, test, 'r', test.threshold_Nm);
    const double direction = test.to_deg > test.from_deg ? 1 : -1;
    if (target.to_stops)
      EXPECT_TRUE(reading.stopped_by_joint) << test.id << " " << reading.angle_deg;
    else
      EXPECT_GT(direction * (reading.angle_deg - target.target_deg), -0.3) << test.id;  // 3 deg steps of the fit
  }
}

TEST_P(Preset, CouplingsAreThoseOfPeople) {
  constexpr double kAllowed_deg = 10;
  for (const RomCouplingLine& line : s().report.couplings) {
    if (GetParam() == "average-adult") {  // gymnasts: nothing may be left of it
      EXPECT_TRUE(line.right_way) << line.coupling->id << " " << line.difference_deg;
    }
    if (line.norm.known()) {
      EXPECT_LE(std::abs(line.off_deg), kAllowed_deg) << line.coupling->id << " " << line.difference_deg;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, Preset, testing::ValuesIn(romPresetNames()),
                         [](const auto& tested) { return tested.param == "athlete" ? "Athlete" : "AverageAdult"; });

TEST(AverageAdult, ReadsThePoplitealAngleOfThePaper) {
  EXPECT_NEAR(shipped("average-adult").reading_deg("popliteal_adult"), 30, 2);  // Ryu et al.: 30 deg at 50 N m
}

/// 0.4 to 1.7 optimal lengths while one coordinate goes through the preset's range. Asked: 95 % of the units;
/// docs/validation.md names those that miss it.
TEST(AverageAdult, FibersWorkWhileOneCoordinateMoves) {
  const Shipped& s = shipped("average-adult");
  const std::size_t half = s.model.musculature.units.size() / 2;
  std::vector<bool> works(half, true);
  for (const Posture& q : singleMotions(s.model.skeleton, s.preset)) {
    const auto X_WB = segmentPoses(s.model.skeleton, q);
    for (std::size_t u = 0; u < half; ++u) {
      const MusculotendonUnit& unit = s.model.musculature.units[u];
      const double fiber = equilibrium(unit, pathLength(unit, X_WB), 0).normalized_fiber_length;
      if (fiber < 0.4 || fiber > 1.7) works[u] = false;
    }
  }
  const auto count = std::ranges::count(works, true);
  std::printf("%td of %zu units stay within 0.4 to 1.7\n", count, half);
  EXPECT_GE(count, 0.95 * half);
}

TEST(AverageAdult, StraightLegRaiseIsLessThanWithABentKnee) {
  const Shipped& s = shipped("average-adult");
  EXPECT_GT(s.reading_deg("hipflex_knee_flexed") - s.reading_deg("slr"), 25);
  EXPECT_GT(s.reading_deg("silf_knee_flex"), s.reading_deg("silf_knee_ext") + 2);
  EXPECT_LT(s.reading_deg("duncan_ely"), s.reading_deg("knee_flex_hip90"));
  EXPECT_GE(s.reading_deg("hipext_knee_flexed"), s.reading_deg("hipext_knee_straight"));
}

TEST(AverageAdult, KneeExtensionEndsAtTheJointAndNotAtMuscles) {
  const Shipped& s = shipped("average-adult");
  EXPECT_TRUE(
      simulateTest(s.model, s.norms.test("knee_ext"), 'r', s.norms.test("knee_ext").threshold_Nm).stopped_by_joint);
  EXPECT_TRUE(
      simulateTest(s.model, s.norms.test("elb_ext"), 'r', s.norms.test("elb_ext").threshold_Nm).stopped_by_joint);
}

TEST(SimulatedTest, EndsAtTheThresholdAndIsTheSameOnBothSides) {
  const Shipped& s = shipped("average-adult");
  const ClinicalTest& test = s.norms.test("popliteal_adult");
  const SimulatedTest right = simulateTest(s.model, test, 'r', test.threshold_Nm),
                      left = simulateTest(s.model, test, 'l', test.threshold_Nm);
  EXPECT_NEAR(right.moment_Nm, test.threshold_Nm, 0.1);
  EXPECT_NEAR(right.angle_deg, left.angle_deg, 0.01);
  ClinicalTest weaker = test;
  weaker.threshold_Nm = 20;
  EXPECT_GT(simulateTest(s.model, weaker, 'r', weaker.threshold_Nm).angle_deg,
            right.angle_deg + 1);  // felt earlier: more lack of extension
}

TEST(SimulatedTest, MovesSeveralCoordinatesToTheirStops) {
  const Shipped& s = shipped("average-adult");
  Model limp = s.model;  // no muscle holds: only stops are left
  for (auto& unit : limp.musculature.units) unit.optimal_fiber_length_m *= 10;
  const SimulatedTest reading =
      simulateTest(limp, s.norms.test("neck_flex"), 'r', s.norms.test("neck_flex").threshold_Nm);
  EXPECT_TRUE(reading.stopped_by_joint);
  const auto stop_deg = [&](const char* name) {
    return limp.skeleton.coordinates[limp.skeleton.coordinateIndex(name)].stop_max_rad * 180 / 3.14159265358979323846;
  };
  EXPECT_NEAR(reading.angle_deg, stop_deg("neck_flexion") + stop_deg("head_flexion"), 1e-6);
  EXPECT_THAT(reading.limited_by, testing::UnorderedElementsAre("stop of neck_flexion", "stop of head_flexion"));
}

TEST(RomPreset, RefusesWhatItDoesNotKnow) {
  const Skeleton skeleton = loadReferenceSkeleton(test::resourceDir());
  try {
    loadRomPreset(test::resourceDir(), "atlete", skeleton);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("nearest: athlete"));
  }
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "rom");
  std::string text = readFile(test::resourceDir() / "rom" / "athlete.json");
  text.replace(text.find("\"knee_flexion\""), 14, "\"knee_flexoin\"");
  writeFileAtomically(folder / "rom" / "athlete.json", text);
  try {
    loadRomPreset(folder.path(), "athlete", skeleton);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("athlete.json"), HasSubstr("nearest: knee_flexion")));
  }
}

TEST(ModelNames, NameAPreset) {
  EXPECT_EQ(presetOf("reference"), "average-adult");
  EXPECT_EQ(presetOf("reference:athlete"), "athlete");
  EXPECT_EQ(presetOf("patient.json"), std::nullopt);
  const Model athlete = loadModelByName("reference:athlete", test::resourceDir());
  EXPECT_EQ(athlete.name, "reference:athlete");
  const int hip = athlete.skeleton.coordinateIndex("hip_flexion_l");
  EXPECT_GT(athlete.skeleton.coordinates[hip].stop_max_rad, 2.5);
  EXPECT_THROW(loadModelByName("reference:dwarf", test::resourceDir()), InputError);
}

}  // namespace
}  // namespace sinew
