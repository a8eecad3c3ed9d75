#include "clinical/synthetic/synthetic_patient.h"

#include <gtest/gtest.h>

#include <numbers>

#include "clinical/synthetic/synthetic_rig.h"
#include "core/skeleton/clinical_angles.h"
#include "core/skeleton/fit/landmark_protocol.h"
#include "core/skeleton/shape/bone_field.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

struct Drawn {
  ShapeParameters shape;
  Skeleton skeleton;
  Posture posture;
};
const Skeleton& reference() {
  static const Skeleton skeleton = loadReferenceSkeleton(test::resourceDir());
  return skeleton;
}
Drawn draw(unsigned seed, SyntheticRig kind = SyntheticRig::ConeBeam) {
  static const auto priors = loadShapePriors(test::resourceDir());
  RandomSource shape_source{seed, 1}, posture_source{seed, 2};
  Drawn drawn;
  drawn.shape = drawPatientShape(priors, shape_source);
  drawn.skeleton = deformedSkeleton(reference(), drawn.shape);
  drawn.posture = drawPatientPosture(drawn.skeleton, floorHeight_m(kind), posture_source);
  return drawn;
}
double coordinate_deg(const Drawn& d, const std::string& name) {
  return clinicalFromPosture(d.skeleton, d.posture)[d.skeleton.coordinateIndex(name)] * 180 / std::numbers::pi;
}

TEST(RandomSource, IsThatOfTheStandardAndNormalNumbersHaveTheirMoments) {
  std::mt19937_64 engine;  // the standard fixes its 10000th value
  engine.discard(9999);
  EXPECT_EQ(engine(), 9981545732273789042ULL);
  RandomSource random{7};
  double sum = 0, sum2 = 0, sum4 = 0;
  constexpr int kCount = 200000;
  for (int i = 0; i < kCount; ++i) {
    const double z = random.normal();
    sum += z, sum2 += z * z, sum4 += z * z * z * z;
  }
  EXPECT_NEAR(sum / kCount, 0, 4 / std::sqrt(kCount));
  EXPECT_NEAR(sum2 / kCount, 1, 4 * std::sqrt(2.0 / kCount));
  EXPECT_NEAR(sum4 / kCount, 3, 4 * std::sqrt(96.0 / kCount));
  EXPECT_NE(RandomSource(1, 1).uniform(), RandomSource(1, 2).uniform());
  EXPECT_NE(RandomSource(1, 1).uniform(), RandomSource(2, 1).uniform());
}

TEST(DrawPatientShape, FollowsThePriorsAndKeepsTheLegsAlike) {
  const auto priors = loadShapePriors(test::resourceDir());
  double sum = 0, sum2 = 0, difference2 = 0;
  constexpr int kCount = 400;
  for (unsigned seed = 0; seed < kCount; ++seed) {
    RandomSource random{seed, 1};
    const auto shape = drawPatientShape(priors, random);
    EXPECT_NO_THROW(validate(shape));
    const double torsion = shape.sides[0].tibia.torsion_rad;
    sum += torsion, sum2 += torsion * torsion;
    const double difference = shape.sides[0].femur.elongation / shape.sides[1].femur.elongation - 1;
    difference2 += difference * difference;
  }
  const auto prior =
      std::find_if(priors.begin(), priors.end(), [](const auto& p) { return p.parameter == "tibia_r.torsion"; });
  const double mean = sum / kCount, sd = std::sqrt(sum2 / kCount - mean * mean);
  EXPECT_NEAR(mean, prior->mean, 4 * prior->sd / std::sqrt(kCount));
  EXPECT_NEAR(sd, prior->sd, 0.2 * prior->sd);  // cutting at 2 SD takes a tenth, sampling 4 %
  const double legs = std::sqrt(difference2 / kCount);
  EXPECT_GT(legs, 0.005);  // a leg-length difference of millimetres exists ...
  EXPECT_LT(legs, 0.04);   // ... and stays one
}

TEST(DrawPatientPosture, StandsWithBothFeetFlatOnTheFloor) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const auto d = draw(seed);
    const auto X_WB = segmentPoses(d.skeleton, d.posture);
    std::array<double, 2> lowest{1e9, 1e9};
    for (const int side : {0, 1}) {
      const int foot = d.skeleton.segmentIndex(side ? "foot_l" : "foot_r");
      EXPECT_NEAR(X_WB[std::size_t(foot)].linear().col(1).y(), 1, 1e-4);  // within 0.8 deg of upright
      for (const auto& l : d.skeleton.landmarks)
        if (l.segment == foot)
          lowest[std::size_t(side)] = std::min(lowest[std::size_t(side)], (X_WB[std::size_t(foot)] * l.p_BL).y());
    }
    EXPECT_NEAR(lowest[0], lowest[1], 2e-4) << seed;
    EXPECT_NEAR(std::min(lowest[0], lowest[1]), floorHeight_m(SyntheticRig::ConeBeam) + 0.008, 1e-9);
    for (const char* knee : {"knee_flexion_r", "knee_flexion_l"}) {
      EXPECT_GE(coordinate_deg(d, knee), 2);
      EXPECT_LE(coordinate_deg(d, knee), 12);
    }
    EXPECT_LT(std::abs(coordinate_deg(d, "pelvis_list")), 10);
    // One foot before the other, so that the legs can be told apart from the side.
    const double stagger = X_WB[std::size_t(d.skeleton.segmentIndex("foot_r"))].translation().x() -
                           X_WB[std::size_t(d.skeleton.segmentIndex("foot_l"))].translation().x();
    EXPECT_GT(std::abs(stagger), 0.02) << seed;
  }
}

TEST(DrawSightings, ReprojectWithoutNoiseAndScatterAsStatedWithIt) {
  for (const auto kind : {SyntheticRig::ConeBeam, SyntheticRig::SlotScan}) {
    const auto d = draw(2, kind);
    const auto rig = drawTrueRig(kind, 2);
    const auto X_WB = segmentPoses(d.skeleton, d.posture);
    const auto exact = [&](const Sighting& s) {
      const auto& l = d.skeleton.landmark(s.name);
      return *project(rig.views[std::size_t(s.view)], Eigen::Vector3d{X_WB[std::size_t(l.segment)] * l.p_BL});
    };
    RandomSource quiet{5};
    const auto clean = drawSightings(d.skeleton, d.posture, rig, test::resourceDir(), 0, quiet);
    for (const auto& s : clean) EXPECT_LT((s.uv_px - exact(s)).norm(), 1e-9);
    double sum2 = 0;
    std::size_t count = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
      RandomSource random{seed};
      for (const auto& s : drawSightings(d.skeleton, d.posture, rig, test::resourceDir(), 1.5, random)) {
        sum2 += ((s.uv_px - exact(s)) / s.sigma_px).squaredNorm() / 2;
        ++count;
      }
    }
    EXPECT_NEAR(sum2 / double(count), 1, 4 / std::sqrt(double(count)));
  }
}

TEST(DrawSightings, AConeBeamFilmShowsTheWholeProtocolAndSigmaGrowsTowardsTheSource) {
  const auto rig = drawTrueRig(SyntheticRig::ConeBeam, 1);
  std::size_t wanted = 0;
  for (const auto& l : loadLandmarkProtocol(test::resourceDir())) wanted += l.views.size();
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const auto d = draw(seed);
    RandomSource random{seed};
    const auto picks = drawSightings(d.skeleton, d.posture, rig, test::resourceDir(), 1, random);
    EXPECT_GE(picks.size() + 4, wanted) << seed;  // a toe of the tallest may be cut off
    const auto sigma = [&](const char* name) {
      return std::find_if(picks.begin(), picks.end(), [&](const auto& s) { return s.name == name && s.view == 1; })
          ->sigma_px;
    };
    // The source is on the right: 3 m / 0.28 mm / 2.57 m against / 2.73 m.
    EXPECT_NEAR(sigma("femoral_head_center_r") / sigma("femoral_head_center_l"), 2.73 / 2.57, 0.02);
    EXPECT_NEAR(sigma("femoral_head_center_r"), 4.1, 0.15);
  }
}

}  // namespace
}  // namespace sinew
