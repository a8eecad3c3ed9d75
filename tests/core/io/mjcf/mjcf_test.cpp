#include "core/io/mjcf/mjcf.h"

#include <gtest/gtest.h>

#include "app/bench/mujoco_peer.h"
#include "core/foreign/foreign_from_model.h"
#include "core/io/mjcf/mjcf_structures_internal.h"
#include "core/muscle/muscle_path.h"
#include "core/passive/structure_moments.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/support/postures.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

const Model& reference() {
  static const Model model = loadReferenceModel(test::resourceDir());
  return model;
}

int count(const std::string& text, const std::string& word) {
  int n = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

/// What MuJoCo can express exactly: one anchor a point, none on a driven segment.
bool isPlain(const MusculotendonUnit& unit) {
  return std::ranges::all_of(unit.path, [](const PathPoint& p) {
    return p.anchors.size() == 1 && p.anchors.front().segment < reference().skeleton.movingSegmentCount();
  });
}

TEST(Mjcf, HasEveryBodyJointAndUnit) {
  const std::string xml = mjcfText(reference());
  EXPECT_EQ(count(xml, "<body "), 23);
  EXPECT_EQ(count(xml, "type=\"ball\""), 2);    // shoulders
  EXPECT_EQ(count(xml, "type=\"hinge\""), 40);  // 5 revolute, 11 x 3 of the other ball joints, 2 patellae
  EXPECT_EQ(count(xml, "<spatial "), 282);
  EXPECT_EQ(count(xml, "<muscle "), 282);
  EXPECT_EQ(count(xml, "<body "), count(xml, "</body>"));
}

TEST(Mjcf, NamesCannotBreakTheDocument) {
  Model model;
  model.skeleton = reference().skeleton;
  model.name = "a\"<b>&c";
  EXPECT_NE(mjcfText(model).find("model=\"a&quot;&lt;b>&amp;c\""), std::string::npos);
}

TEST(Mjcf, ThePatellaIsAQuarticOfTheKneeWithin2Degrees) {
  constexpr double kStated_rad = 2 * std::numbers::pi / 180;  // docs/methods/model_exchange.md
  const Skeleton& s = reference().skeleton;
  const PatellaQuartic fit = patellaQuartic(s, s.patellae[0]);
  EXPECT_LT(fit.largest_error_rad, kStated_rad);
  EXPECT_GT(fit.coefficients[1], 0.5);  // it follows the knee
}

/// Largest difference of length by unit, over 100 postures inside the athlete envelope or the adult norm.
std::map<std::string, double> deviations_m(MujocoPeer& mujoco, bool athlete) {
  const Skeleton& s = reference().skeleton;
  std::mt19937_64 random{41};
  std::map<std::string, double> deviation_m;
  for (int trial = 0; trial < 100; ++trial) {
    Eigen::VectorXd clinical = test::randomClinical(s, random);
    for (int i = 0; !athlete && i < clinical.size(); ++i)
      clinical[i] = std::clamp(clinical[i], s.coordinates[i].normal_min_rad, s.coordinates[i].normal_max_rad);
    const Posture q = postureFromClinical(s, clinical);
    const auto X_WB = segmentPoses(s, q);
    mujoco.setPositions(mujoco.positions(q));
    mujoco.lengthsAndGradients();
    for (std::size_t u = 0; u < reference().musculature.units.size(); ++u) {
      const MusculotendonUnit& unit = reference().musculature.units[u];
      double& largest_m = deviation_m[unit.name];
      largest_m = std::max(largest_m, std::abs(mujoco.length_m(int(u)) - pathLength(unit, X_WB)));
    }
    // Origins of all bodies, driven ones included, are where ours are.
    for (std::size_t i = 0; i < X_WB.size(); ++i)
      EXPECT_LT((mujoco.p_WB(int(i)) - X_WB[i].translation()).norm(), 1e-9) << s.segments[i].name;
  }
  return deviation_m;
}

TEST(MjcfInMujoco, LengthsOfPlainUnitsAgreeToATenthOfAMillimetre) {
  const auto mujoco = MujocoPeer::make(reference());
  if (!mujoco) GTEST_SKIP() << "MuJoCo is not installed";
  int plain = 0;
  for (const auto& [name, off_m] : deviations_m(*mujoco, true)) {
    if (!isPlain(reference().musculature.unit(name))) continue;
    ++plain;
    EXPECT_LT(off_m, 1e-4) << name;
  }
  EXPECT_GT(plain, 100);
}

bool isBlended(const MusculotendonUnit& unit) {
  return std::ranges::any_of(unit.path, [](const PathPoint& p) { return p.anchors.size() > 1; });
}

/// Inside the adult norm; figures in docs/methods/model_exchange.md.
TEST(MjcfInMujoco, TheOthersDeviateAsStated) {
  const auto mujoco = MujocoPeer::make(reference());
  if (!mujoco) GTEST_SKIP() << "MuJoCo is not installed";
  constexpr double kDriven_m = 0.03;         // the radius turns by the clinical pronation
  constexpr double kBlendedMedian_m = 0.03;  // a pinned point leaves the way between its segments
  std::vector<double> blended_m, driven_m;
  std::string worst;
  for (const auto& [name, off_m] : deviations_m(*mujoco, false)) {
    const MusculotendonUnit& unit = reference().musculature.unit(name);
    if (isPlain(unit)) continue;
    if (isBlended(unit) && (blended_m.empty() || off_m > std::ranges::max(blended_m))) worst = name;
    (isBlended(unit) ? blended_m : driven_m).push_back(off_m);
    if (!isBlended(unit)) {
      EXPECT_LT(off_m, kDriven_m) << name;
    }
  }
  std::ranges::sort(blended_m);
  const double median_m = blended_m[blended_m.size() / 2];
  std::printf(
      "%zu units on driven bones: largest %.1f mm; %zu with blended points: median %.1f mm, largest %.1f mm (%s)\n",
      driven_m.size(), 1000 * std::ranges::max(driven_m), blended_m.size(), 1000 * median_m, 1000 * blended_m.back(),
      worst.c_str());
  EXPECT_LT(median_m, kBlendedMedian_m);
}

/// What `sinew export` reports is what MuJoCo has: our own evaluation of pinned points, with the patella at its exact
/// glide.
TEST(MjcfInMujoco, LengthsAreThoseOfTheModelInBetween) {
  const auto mujoco = MujocoPeer::make(reference());
  if (!mujoco) GTEST_SKIP() << "MuJoCo is not installed";
  const Skeleton& s = reference().skeleton;
  const ForeignModel foreign = foreignFromModel(reference(), {.blended = ForeignOptions::Blended::HeaviestAnchor});
  constexpr double kSpline_m = 1e-6;  // of the patella
  std::mt19937_64 random{47};
  for (int trial = 0; trial < 20; ++trial) {
    const Posture q = postureFromClinical(s, test::randomClinical(s, random));
    mujoco->setPositions(mujoco->positions(q));
    mujoco->lengthsAndGradients();
    const Eigen::VectorXd length_m = foreignLengths(foreign, foreignPosture(foreign, s, q));
    for (Eigen::Index u = 0; u < length_m.size(); ++u)
      EXPECT_NEAR(mujoco->length_m(int(u)), length_m[u], kSpline_m) << foreign.musculature.units[std::size_t(u)].name;
  }
}

/// Pinned points lie where the blended ones lie in the posture in which they are pinned.
TEST(MjcfInMujoco, AllLengthsAgreeAtTheZeroPosture) {
  const auto mujoco = MujocoPeer::make(reference());
  if (!mujoco) GTEST_SKIP() << "MuJoCo is not installed";
  const Posture q = zeroPosture(reference().skeleton);
  const auto X_WB = segmentPoses(reference().skeleton, q);
  mujoco->setPositions(mujoco->positions(q));
  mujoco->lengthsAndGradients();
  for (std::size_t u = 0; u < reference().musculature.units.size(); ++u)
    EXPECT_NEAR(mujoco->length_m(int(u)), pathLength(reference().musculature.units[u], X_WB), 1e-9);
}

TEST(MjcfInMujoco, PassiveForceIsTheGreatestAtTheEditedPassiveStrain) {
  // With its passive strain edited to what the fibre is stretched by when standing, a unit pulls with F_max there.
  Model model = reference();
  const auto X_WB = segmentPoses(model.skeleton, zeroPosture(model.skeleton));
  std::vector<int> stretched;
  for (std::size_t i = 0; i < model.musculature.units.size(); ++i) {
    MusculotendonUnit& unit = model.musculature.units[i];
    const double strain = (pathLength(unit, X_WB) - unit.tendon_slack_length_m) / unit.optimal_fiber_length_m - 1;
    if (strain < 0.05) continue;
    unit.curves.passive_strain = strain;
    stretched.push_back(static_cast<int>(i));
  }
  ASSERT_GT(stretched.size(), 10u);
  const auto mujoco = MujocoPeer::make(model);
  if (!mujoco) GTEST_SKIP() << "MuJoCo is not installed";
  mujoco->setPositions(mujoco->positions(zeroPosture(model.skeleton)));
  for (const int i : stretched) {
    const MusculotendonUnit& unit = model.musculature.units[std::size_t(i)];
    const double expected_N = unit.max_isometric_force_N * std::cos(unit.pennation_angle_at_optimal_rad);
    EXPECT_NEAR(mujoco->passiveForce_N(i), expected_N, 1e-6 * expected_N) << unit.name;  // 12 digits in the file
  }
}

/// The reference without muscles: what actuators do is then what the structures do.
Model structuresAlone() {
  Model model = reference();
  model.musculature.units.clear();
  return model;
}

TEST(MjcfInMujoco, StructuresOfOneCoordinateAreWithinThreePercentOfTheirEnd) {
  const Model model = structuresAlone();
  const auto mujoco = MujocoPeer::make(model);
  if (!mujoco) GTEST_SKIP() << "MuJoCo is not installed";
  const Skeleton& s = model.skeleton;
  double worst_share = 0;
  for (const Joint& joint : s.joints) {
    if (joint.type == JointType::Free) continue;
    for (int i = joint.first_coordinate; i < joint.first_coordinate + joint.coordinate_count; ++i) {
      const PassiveMoment& m = model.passive_moments[std::size_t(i)];
      const Coordinate& c = s.coordinates[std::size_t(i)];
      for (double t = -0.02; t <= 1.02; t += 0.02) {  // a little beyond the stops too
        Eigen::VectorXd clinical = Eigen::VectorXd::Zero(s.coordinateCount());
        clinical[i] = std::lerp(c.stop_min_rad, c.stop_max_rad, t);
        const double ours_Nm = passiveMoment_Nm(m, clinical[i]);
        if (std::abs(ours_Nm) > 2 * std::max(m.upper_Nm, m.lower_Nm)) continue;
        const Posture q = postureFromClinical(s, clinical);
        mujoco->setPositions(mujoco->positions(q));
        const Eigen::VectorXd theirs = mujoco->actuatorMoments_Nm();
        const bool ball = !mjcfHasHinges(s, s.coordinates[std::size_t(joint.first_coordinate)].joint);
        const double theirs_Nm =
            ball ? Eigen::Vector3d{theirs.segment<3>(joint.first_coordinate)}.dot(c.axis) : theirs[i];
        const double share = std::abs(theirs_Nm - ours_Nm) / std::max(m.upper_Nm, m.lower_Nm);
        worst_share = std::max(worst_share, share);
        EXPECT_LT(share, kMjcfStructureError + 0.003) << c.name << " at " << clinical[i];  // both ends together
      }
    }
  }
  std::printf("structures in MuJoCo, one coordinate: within %.2f %% of the end's moment\n", 100 * worst_share);
  EXPECT_GT(worst_share, 0.01);  // they are there
}

/// What `sinew export` reports is what MuJoCo has, in any orientation of the joints.
TEST(MjcfInMujoco, StructuresAreThoseThatTheReportIsMadeOf) {
  const Model model = structuresAlone();
  const auto mujoco = MujocoPeer::make(model);
  if (!mujoco) GTEST_SKIP() << "MuJoCo is not installed";
  const Skeleton& s = model.skeleton;
  std::mt19937_64 random{59};
  for (int trial = 0; trial < 20; ++trial) {
    const Posture q = postureFromClinical(s, test::randomClinical(s, random));
    const Eigen::VectorXd clinical = clinicalFromPosture(s, q);  // the reading that the wrists' hinges take
    mujoco->setPositions(mujoco->positions(q));
    const Eigen::VectorXd theirs = mujoco->actuatorMoments_Nm(), ours = mjcfStructureMoments_Nm(model, clinical);
    for (const Joint& joint : s.joints) {
      if (joint.type == JointType::Free) continue;
      const int first = joint.first_coordinate;
      if (!mjcfHasHinges(s, s.coordinates[std::size_t(joint.first_coordinate)].joint)) {
        const Eigen::Matrix3d R_JB = rotationFromVector<double>(q.segment<3>(first));
        const Eigen::Vector3d t_J = R_JB * theirs.segment<3>(first);
        const Eigen::Vector3d forces = angleRates(s, joint, clinical.segment<3>(first)).transpose() * t_J;
        EXPECT_LT((forces - ours.segment<3>(first)).norm(), 1e-6 * (1 + t_J.norm())) << joint.name;
      } else {
        for (int i = first; i < first + joint.coordinate_count; ++i)
          EXPECT_NEAR(theirs[i], ours[i], 1e-6 * (1 + std::abs(ours[i]))) << s.coordinates[std::size_t(i)].name;
      }
    }
  }
  std::printf("%s\n", summaryText(*mjcfDeviation(reference()).structures).c_str());
}

TEST(MjcfInMujoco, TheBodyFallsWithoutBreaking) {
  const auto mujoco = MujocoPeer::make(reference());
  if (!mujoco) GTEST_SKIP() << "MuJoCo is not installed";
  mujoco->setPositions(mujoco->positions(zeroPosture(reference().skeleton)));
  EXPECT_TRUE(mujoco->simulate(500));  // half a second
}

}  // namespace
}  // namespace sinew
