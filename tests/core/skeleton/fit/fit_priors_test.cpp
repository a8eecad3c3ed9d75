#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/angle.h"
#include "core/error.h"
#include "core/file.h"
#include "core/skeleton/clinical_angles.h"
#include "core/skeleton/fit/landmark_protocol.h"
#include "core/skeleton/shape/population.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

const ShapePrior& priorOf(const std::vector<ShapePrior>& priors, const std::string& parameter) {
  const auto at = std::ranges::find(priors, parameter, &ShapePrior::parameter);
  if (at == priors.end()) throw std::runtime_error{"no prior of " + parameter};
  return *at;
}

TEST(ShapePriors, EveryParameterHasOnePriorWithASource) {
  const auto priors = loadShapePriors(test::resourceDir());
  std::set<std::string> seen;
  for (const auto& prior : priors) {
    EXPECT_TRUE(seen.insert(prior.parameter).second) << prior.parameter;
    EXPECT_GT(prior.sd, 0) << prior.parameter;
    EXPECT_GT(prior.source.size(), 10u) << prior.parameter;
  }
  for (const auto& name : shapeParameterNames()) EXPECT_TRUE(seen.contains(name)) << name;
  EXPECT_TRUE(seen.contains(kSizePrior));
  EXPECT_EQ(priors.size(), shapeParameterNames().size() + 1);
}

TEST(ShapePriors, AnglesAreRadiansInside) {
  const auto priors = loadShapePriors(test::resourceDir());
  EXPECT_NEAR(priorOf(priors, "femur_l.torsion").sd, 10 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(priorOf(priors, "femur_r.neck_shaft").mean, 1 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(priorOf(priors, "tibia_r.elongation").mean, 1, 1e-12);
  EXPECT_THAT(priorOf(priors, "femur_r.torsion").source, testing::Not(testing::HasSubstr("not verified")));
  EXPECT_THAT(priorOf(priors, "foot_r.scale").source, testing::HasSubstr("not verified"));
}

TEST(ShapePriors, ABrokenFileIsNamedWithItsField) {
  const test::TemporaryFolder folder;
  const std::string good = readFile(test::resourceDir() / "clinical" / "shape_priors.json");
  const auto complaint = [&](const std::string& from, const std::string& to) -> std::string {
    std::string text = good;
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    std::filesystem::create_directories(folder.path() / "clinical");
    writeFileAtomically(folder.path() / "clinical" / "shape_priors.json", text);
    try {
      loadShapePriors(folder.path());
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  using testing::HasSubstr;
  EXPECT_THAT(complaint("femur.torsion", "femur.torsoin"), HasSubstr("femur_r.torsion"));
  EXPECT_THAT(complaint("\"sd\": 0.15", "\"sd\": -0.15"), HasSubstr("sd"));
  EXPECT_THAT(complaint("\"unit\": \"deg\"", "\"unit\": \"ratio\""), HasSubstr("deg, the unit of"));
  EXPECT_THAT(complaint("pelvis.height", "pelvis.width"), HasSubstr("twice"));
  EXPECT_THAT(complaint("\"version\": 1", "\"version\": 2"), HasSubstr("version"));
}

TEST(Population, DrawsHaveTheMeanAndSpreadOfThePriors) {
  const std::vector<ShapePrior> priors = {
      {kSizePrior, 0.9, 0.1, ""}, {"femur_r.elongation", 1, 0.05, ""}, {"femur_r.torsion", 0.1, 0.2, ""}};
  std::mt19937_64 random{7};
  double sum_size = 0, sum_ratio = 0, sum_torsion = 0, sum_torsion2 = 0;
  constexpr int kDraws = 4000;
  for (int i = 0; i < kDraws; ++i) {
    const ShapeParameters shape = drawShape(priors, random);
    const double size = shape.pelvis_width;  // no prior of its own: 1, times size
    sum_size += size;
    sum_ratio += shape.sides[0].femur.elongation / size;
    sum_torsion += shape.sides[0].femur.torsion_rad;
    sum_torsion2 += shape.sides[0].femur.torsion_rad * shape.sides[0].femur.torsion_rad;
    EXPECT_EQ(shape.sides[1].femur.torsion_rad, 0);
  }
  // Tolerances: 4 standard errors of 4000 draws; truncation at 2.5 SD narrows the spread to 0.96.
  EXPECT_NEAR(sum_size / kDraws, 0.9, 0.007);
  EXPECT_NEAR(sum_ratio / kDraws, 1, 0.0035);
  EXPECT_NEAR(sum_torsion / kDraws, 0.1, 0.013);
  const double mean = sum_torsion / kDraws;
  EXPECT_NEAR(std::sqrt(sum_torsion2 / kDraws - mean * mean), 0.2 * 0.96, 0.01);
}

TEST(Population, TheSameSeedDrawsTheSameBody) {
  const auto priors = loadShapePriors(test::resourceDir());
  std::mt19937_64 a{3}, b{3}, c{4};
  const ShapeParameters first = drawShape(priors, a);
  EXPECT_EQ(first, drawShape(priors, b));
  EXPECT_FALSE(first == drawShape(priors, c));
}

TEST(Population, StandingPosturesStayWithinTheNormalRange) {
  const Skeleton skeleton = loadReferenceSkeleton(test::resourceDir());
  std::mt19937_64 random{11};
  for (int draw = 0; draw < 20; ++draw) {
    const Posture q = drawStandingPosture(skeleton, random);
    const Eigen::VectorXd clinical = clinicalFromPosture(skeleton, q);
    for (int i = 6; i < skeleton.coordinateCount(); ++i) {
      EXPECT_GE(clinical[i], skeleton.coordinates[i].normal_min_rad - 1e-9) << skeleton.coordinates[i].name;
      EXPECT_LE(clinical[i], skeleton.coordinates[i].normal_max_rad + 1e-9) << skeleton.coordinates[i].name;
    }
    EXPECT_GT(q.tail(44).norm(), 0.1);
  }
}

TEST(Population, ThePosturePriorIsWeakAndKnowsNothingOfTheRoot) {
  const Skeleton skeleton = loadReferenceSkeleton(test::resourceDir());
  const Eigen::VectorXd sd = standingPostureSd(skeleton);
  EXPECT_TRUE(sd.head<6>().array().isInf().all());
  EXPECT_NEAR(sd[skeleton.coordinateIndex("knee_flexion_l")], 140.0 / 8 * kRadPerDeg, 1e-9);
  const int hip = skeleton.joints[skeleton.jointIndex("hip_r")].first_coordinate;
  EXPECT_NEAR(sd[hip + 2], 140.0 / 8 * kRadPerDeg, 1e-9);  // flexion turns about Z
  EXPECT_NEAR(sd[hip + 0], 75.0 / 8 * kRadPerDeg, 1e-9);   // adduction about X
}

TEST(LandmarkProtocol, EveryNameIsALandmarkOfTheSkeleton) {
  const Skeleton skeleton = loadReferenceSkeleton(test::resourceDir());
  for (const auto& landmark : loadLandmarkProtocol(test::resourceDir()))
    EXPECT_NO_THROW(skeleton.landmarkIndex(landmark.name)) << landmark.name;
}

TEST(LandmarkProtocol, GoesFromThePelvisDownTheRightLegThenTheLeft) {
  const auto protocol = loadLandmarkProtocol(test::resourceDir());
  const auto at = [&](const std::string& name) {
    const auto found = std::ranges::find(protocol, name, &ProtocolLandmark::name);
    EXPECT_NE(found, protocol.end()) << name;
    return found - protocol.begin();
  };
  EXPECT_LT(at("asis_l"), at("femoral_head_center_r"));
  EXPECT_LT(at("femoral_head_center_r"), at("medial_malleolus_r"));
  EXPECT_LT(at("metatarsal_5_head_r"), at("femoral_head_center_l"));
  const auto& head = protocol[static_cast<std::size_t>(at("femoral_head_center_l"))];
  EXPECT_EQ(head.title, "Left femoral head, centre");
  EXPECT_EQ(head.group, "Left femur");
  EXPECT_EQ(head.views, (std::vector<int>{0, 1}));
  std::set<std::string> names;
  for (const auto& landmark : protocol) EXPECT_TRUE(names.insert(landmark.name).second) << landmark.name;
}

}  // namespace
}  // namespace sinew
