#include "core/rom/poses/pose_set.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "core/error.h"
#include "core/file.h"
#include "core/posture/validity.h"
#include "core/rom/poses/pose_sampler.h"
#include "core/skeleton/clinical_angles.h"
#include "tests/support/postures.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using testing::HasSubstr;

constexpr double kDeg = 3.14159265358979323846 / 180;
constexpr double kSingle = 4e-7;  // rounding of a value up to pi in single precision

const Skeleton& skeleton() {
  static const Skeleton loaded = loadReferenceSkeleton(test::resourceDir());
  return loaded;
}
const ClinicalTests& norms() {
  static const ClinicalTests loaded = loadClinicalTests(test::resourceDir(), skeleton());
  return loaded;
}

PoseSet randomSet(int count) {
  PoseSet set{skeleton(), "random"};
  for (int i = 0; i < count; ++i) set.add(Posture::Random(skeleton().coordinateCount()));
  return set;
}

TEST(PoseSet, FileGoesBothWaysInBlocks) {
  const test::TemporaryFolder folder;
  const PoseSet set = randomSet(2 * kPoseBlock + 7);
  set.save(folder / "a.poses");
  const PoseSet back = loadPoseSet(folder / "a.poses", skeleton());
  ASSERT_EQ(back.size(), set.size());
  EXPECT_EQ(back.source(), "random");
  for (std::size_t i = 0; i < set.size(); ++i) ASSERT_EQ(back.posture(i), set.posture(i));
  std::size_t seen = 0;
  Eigen::Index largest = 0;
  visitPoseFile(folder / "a.poses", skeleton(), [&](const Eigen::MatrixXd& block) {
    for (Eigen::Index c = 0; c < block.cols(); ++c) ASSERT_EQ(Posture{block.col(c)}, set.posture(seen++));
    largest = std::max(largest, block.cols());
  });
  EXPECT_EQ(seen, set.size());
  EXPECT_LE(largest, kPoseBlock);  // memory stays bounded
}

TEST(PoseSet, SinglePrecisionIsKept) {
  PoseSet set{skeleton(), ""};
  const Posture q = Posture::Constant(skeleton().coordinateCount(), 3.0123456789);
  set.add(q);
  EXPECT_LT((set.posture(0) - q).lpNorm<Eigen::Infinity>(), kSingle);
}

std::string complaint(const std::filesystem::path& file) {
  try {
    loadPoseSet(file, skeleton());
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(PoseSet, RefusesBrokenFiles) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(complaint(folder / "absent.poses"), HasSubstr("no such file"));
  writeFileAtomically(folder / "b.poses", "HIERARCHY");
  EXPECT_THAT(complaint(folder / "b.poses"), HasSubstr("begins with SINEWPOS"));
  randomSet(3).save(folder / "c.poses");
  const std::string whole = readFile(folder / "c.poses");
  writeFileAtomically(folder / "short.poses", whole.substr(0, whole.size() - 1));
  EXPECT_THAT(complaint(folder / "short.poses"), HasSubstr("expected 600 bytes, found 599 bytes"));
  std::string renamed = whole;
  renamed.replace(renamed.find("hip_flexion_r"), 13, "hip_flexion_x");
  writeFileAtomically(folder / "d.poses", renamed);
  EXPECT_THAT(complaint(folder / "d.poses"), HasSubstr("expected 'hip_flexion_r', found 'hip_flexion_x'"));
  std::string infinite = whole;
  infinite.replace(infinite.size() - 4, 4, std::string{"\0\0\x80\x7f", 4});
  writeFileAtomically(folder / "e.poses", infinite);
  EXPECT_THAT(complaint(folder / "e.poses"), HasSubstr("finite numbers"));
}

TEST(PoseMirror, MirrorsEveryPointAndIsItsOwnInverse) {
  const PoseMirror mirror{skeleton()};
  std::mt19937_64 random{5};
  for (int i = 0; i < 20; ++i) {
    const Posture q = postureFromClinical(skeleton(), test::randomClinical(skeleton(), random));
    const Posture m = mirror(q);
    EXPECT_LT((mirror(m) - q).norm(), 1e-15);
    const auto X = segmentPoses(skeleton(), q), Y = segmentPoses(skeleton(), m);
    for (std::size_t s = 0; s < X.size(); ++s) {
      std::string other = skeleton().segments[s].name;
      if (other.ends_with("_r"))
        other.back() = 'l';
      else if (other.ends_with("_l"))
        other.back() = 'r';
      const auto t = static_cast<std::size_t>(skeleton().segmentIndex(other));
      EXPECT_LT((mirrored(X[s]).matrix() - Y[t].matrix()).norm(), 1e-12) << other;
    }
  }
}

TEST(PoseSet, MirrorImagesSubsamplesAndOutliers) {
  PoseSet set{skeleton(), "three"};
  set.add(zeroPosture(skeleton()));
  set.add(postureFromDegrees(skeleton(), {{"knee_flexion_r", 90}}));
  set.add(postureFromDegrees(skeleton(), {{"knee_flexion_l", -40}}));  // no knee does
  const PoseSet doubled = withMirrorImages(set, skeleton());
  ASSERT_EQ(doubled.size(), 6u);
  EXPECT_NEAR(doubled.posture(3)[skeleton().coordinateIndex("knee_flexion_l")], 90 * kDeg, kSingle);
  EXPECT_EQ(subsampled(doubled, 4, skeleton()).size(), 2u);
  std::size_t rejected = 0;
  EXPECT_EQ(withoutOutliers(set, skeleton(), 10 * kDeg, rejected).size(), 2u);
  EXPECT_EQ(rejected, 1u);
}

class SampledPoses : public testing::TestWithParam<std::string> {};

TEST_P(SampledPoses, StayInsideRangesAndCouplingsOnBothSides) {
  Skeleton body = skeleton();
  const RomPreset preset = loadRomPreset(test::resourceDir(), GetParam(), body);
  setStops(body, preset);
  const auto bounds = sidedBounds(body, preset);
  const PoseSet set = sampledPoseSet(body, preset, norms().tests, {.count = 1500});
  ASSERT_GE(set.size(), 1500u);
  for (std::size_t i = 0; i < set.size(); ++i) {
    const Posture q = set.posture(i);
    for (const auto& m : stopMargins(body, q))
      ASSERT_TRUE(m.holds()) << body.coordinates[m.index].name << " " << m.margin;
    const Eigen::VectorXd clinical = clinicalFromPosture(body, q);
    for (const auto& b : bounds) {
      const bool arm = std::ranges::any_of(
          b.terms, [&](const auto& t) { return body.coordinates[t.first].name.starts_with("shoulder"); });
      if (b.terms.size() > 1 && !arm) {  // an arm above the head reads otherwise than it was drawn
        EXPECT_LE(b.excess_rad(clinical), 1e-3 * kDeg);
      }
    }
  }
}

TEST_P(SampledPoses, RepeatAndMoveBothSidesIndependently) {
  const RomPreset preset = loadRomPreset(test::resourceDir(), GetParam(), skeleton());
  const PoseSet a = sampledPoseSet(skeleton(), preset, norms().tests, {.count = 3000}),
                b = sampledPoseSet(skeleton(), preset, norms().tests, {.count = 3000}),
                other = sampledPoseSet(skeleton(), preset, norms().tests, {.count = 3000, .seed = 1});
  ASSERT_EQ(a.size(), b.size());
  const int right = skeleton().coordinateIndex("knee_flexion_r"), left = skeleton().coordinateIndex("knee_flexion_l");
  const PoseMirror mirror{skeleton()};
  bool differs = false;
  double mean = 0, products = 0, squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) mean += a.posture(i)[right] / static_cast<double>(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a.posture(i), b.posture(i));
    differs = differs || a.posture(i) != other.posture(i);
    if (i % 2 == 1) {
      ASSERT_EQ(a.posture(i), mirror(a.posture(i - 1)));
    }
    const double r = a.posture(i)[right] - mean, l = a.posture(i)[left] - mean;
    products += r * l;
    squares += r * r;
  }
  EXPECT_TRUE(differs);
  EXPECT_LT(std::abs(products / squares), 0.25);  // correlation of the knees; 0 +- 0.06 by chance, ends included
}

INSTANTIATE_TEST_SUITE_P(Presets, SampledPoses, testing::ValuesIn(romPresetNames()),
                         [](const auto& tested) { return tested.param == "athlete" ? "Athlete" : "AverageAdult"; });

}  // namespace
}  // namespace sinew
