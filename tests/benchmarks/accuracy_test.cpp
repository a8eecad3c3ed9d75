#include <gtest/gtest.h>

#include <cctype>
#include <cmath>

#include "tests/benchmarks/accuracy_study.h"
#include "tests/benchmarks/deformity_study.h"
#include "tests/support/resources.h"
#include "tests/support/synthetic_views.h"

namespace sinew {
namespace {

constexpr int kBodies = 20;  // the full study is the program sinew_accuracy

/// What is exact is also said to be exact.
class Accuracy : public testing::TestWithParam<StudyRig> {};

TEST_P(Accuracy, NoiseFreePicksGiveTheTruth) {
  const Disturbance none{.name = "exact", .pick_mm = 0, .exact = true};
  const AccuracyStudy study = studyAccuracy(test::resourceDir(), GetParam(), none, 1, kBodies);
  EXPECT_EQ(study.not_converged, 0);
  for (const auto& row : study.rows) {
    EXPECT_LT(row.max, 0.1) << row.quantity;  // mm and deg: what is required of exact landmarks
    EXPECT_EQ(row.undetermined, 0) << row.quantity;
  }
}

TEST_P(Accuracy, OneMillimetreOfPickingNoiseStaysWithinTheRequiredSpread) {
  const Disturbance picks{.name = "picks", .pick_mm = 1, .exact = true};
  const AccuracyStudy study = studyAccuracy(test::resourceDir(), GetParam(), picks, 1, kBodies);
  EXPECT_EQ(study.not_converged, 0);
  EXPECT_LT(study.row("femur_length").sd, 2);
  EXPECT_LT(study.row("tibia_length").sd, 2);
  EXPECT_LT(study.row("femoral_torsion").sd, 3);
  EXPECT_LT(study.row("tibial_torsion").sd, 3);
  EXPECT_LT(study.row("hka").sd, 0.5);
  for (const auto& row : study.rows) {
    EXPECT_LT(std::abs(row.bias), 4 * row.sd / std::sqrt(row.determined)) << row.quantity;
    EXPECT_GE(row.coverage, row.determined > kBodies ? 0.8 : 0.7) << row.quantity;  // 3 SD of 40 and 20 draws
  }
  // All figures together, which are not independent: 95 % +- 3 % would be three SD of 400 draws.
  EXPECT_GT(study.coverage(), 0.91);
}

INSTANTIATE_TEST_SUITE_P(Rigs, Accuracy, testing::Values(coneBeamRig(), slotScanRig()), [](const auto& tested) {
  return std::string{tested.param.simultaneous ? "slot_scan" : "cone_beam"};
});

TEST(Disturbed, IntervalsHoldWhateverWentWrong) {
  for (const Disturbance& disturbance : requiredDisturbances()) {
    const AccuracyStudy study = studyAccuracy(test::resourceDir(), coneBeamRig(), disturbance, 501, 8);
    EXPECT_EQ(study.not_converged, 0) << disturbance.name;
    // 160 figures of 8 bodies, of which those of one body go together: three SD below 95 %.
    EXPECT_GT(study.coverage(), 0.88) << disturbance.name;
    if (disturbance.knees_deg > 0)
      EXPECT_GE(study.joint_warnings, 7) << disturbance.name;
    else
      EXPECT_LE(study.joint_warnings, 1) << disturbance.name;
  }
}

// ---- bones outside the population
// -----------------------------------------------------------------------------------

class Deformed : public testing::TestWithParam<std::size_t> {};

bool isAxis(const std::string& quantity) {
  return quantity == "hka" || quantity == "knee_flexion" || quantity == "pelvic_obliquity";
}

TEST_P(Deformed, LengthsAndAxesHaveNoBias) {
  const Deformity& deformity = deformities()[GetParam()];
  constexpr int kDraws = 8;
  for (const double amount : {deformity.amounts.back(), deformity.amounts.front()}) {
    const DeformityStudy study =
        studyDeformity(test::resourceDir(), test::coneBeamPair(), deformity, amount, 1, kDraws);
    EXPECT_EQ(study.not_converged, 0) << amount;
    double covered = 0, all = 0;
    for (const auto& row : study.rows) {
      if (row.determined < 2) continue;
      // Required are 1 mm and 0.5 deg; a mean of 8 draws has a standard error of its own.
      const double chance = 3 * row.sd / std::sqrt(row.determined);
      if (row.unit == "mm") {
        EXPECT_LT(std::abs(row.bias), 1 + chance) << amount << " " << row.quantity;
      }
      if (isAxis(row.quantity)) {
        EXPECT_LT(std::abs(row.bias), 0.5 + chance) << amount << " " << row.quantity;
      }
      covered += row.coverage * row.determined, all += row.determined;
    }
    EXPECT_GT(covered / all, 0.85) << amount;         // 95 % less three SD of some 50 independent ones
    EXPECT_LE(study.left_out, kDraws / 4) << amount;  // every pick is true
  }
}

INSTANTIATE_TEST_SUITE_P(Bones, Deformed, testing::Range(std::size_t{0}, deformities().size()),
                         [](const auto& tested) {
                           std::string name;
                           for (const char c : deformities()[tested.param].name) {
                             if (c == ',' || c == ':') break;
                             if (std::isalnum(static_cast<unsigned char>(c))) name += c;
                           }
                           return name + std::to_string(tested.param);
                         });

}  // namespace
}  // namespace sinew
