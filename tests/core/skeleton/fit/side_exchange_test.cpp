#include "core/skeleton/fit/side_exchange.h"

#include <gmock/gmock.h>

#include "core/skeleton/fit/exchange_words_internal.h"
#include "core/skeleton/fit/landmark_protocol.h"
#include "core/skeleton/shape/population.h"
#include "tests/support/resources.h"
#include "tests/support/synthetic_views.h"

namespace sinew {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// One body of the population, picked with 1 mm noise; 60 bodies with definition errors:
/// tests/benchmarks/exchange.cpp.
class SideExchangeTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    skeleton_ = loadReferenceSkeleton(test::resourceDir());
    priors_ = loadShapePriors(test::resourceDir());
  }

  std::vector<LandmarkObservation> picks(const std::vector<std::string>& names) const {
    std::mt19937_64 random{5};
    const ShapeParameters shape = drawShape(priors_, random);
    const Posture posture = drawStandingPosture(skeleton_, random);
    return test::observe(skeleton_, shape, posture, views_, names, 1, random);
  }
  std::vector<LandmarkObservation> protocolPicks() const {
    std::vector<std::string> names;
    for (const auto& landmark : loadLandmarkProtocol(test::resourceDir())) names.push_back(landmark.name);
    return picks(names);
  }
  ExchangeFinding find(const std::vector<LandmarkObservation>& picks, const ExchangeOptions& options = {}) const {
    return findExchangedSides(skeleton_, views_, picks, priors_, options);
  }

  static Skeleton skeleton_;
  static std::vector<ShapePrior> priors_;
  std::vector<View> views_ = test::coneBeamPair();
};
Skeleton SideExchangeTest::skeleton_;
std::vector<ShapePrior> SideExchangeTest::priors_;

TEST_F(SideExchangeTest, SaysNothingOfPicksThatAreRight) {
  const auto finding = find(protocolPicks());
  EXPECT_THAT(finding.exchanges, IsEmpty());
  EXPECT_THAT(finding.what, IsEmpty());
}

TEST_F(SideExchangeTest, NamesTheViewThatIsExchanged) {
  for (const int view : {0, 1}) {
    auto seen = protocolPicks();
    for (auto& pick : seen)
      if (pick.view == view) pick.landmark = withOtherSide(pick.landmark);
    const auto finding = find(seen);
    EXPECT_EQ(finding.what, "all landmarks of view " + std::to_string(view + 1));
    ASSERT_EQ(finding.exchanges.size(), 1u);
    EXPECT_EQ(finding.exchanges[0].view, view);
    EXPECT_TRUE(finding.exchanges[0].whole);
    for (const auto& pick : seen)
      EXPECT_EQ(isExchanged(finding.exchanges, pick.landmark, pick.view),
                pick.view == view && withOtherSide(pick.landmark) != pick.landmark);
  }
}

TEST_F(SideExchangeTest, NamesAMirroredBody) {
  auto seen = protocolPicks();
  for (auto& pick : seen) pick.landmark = withOtherSide(pick.landmark);
  const auto finding = find(seen);
  EXPECT_EQ(finding.what, "all landmarks of both views");
  EXPECT_EQ(finding.exchanges.size(), 2u);
}

TEST_F(SideExchangeTest, NamesOneLandmarkInOneView) {
  auto seen = protocolPicks();
  for (auto& pick : seen)
    if (pick.view == 0 && pick.landmark.starts_with("lateral_malleolus"))
      pick.landmark = withOtherSide(pick.landmark);
  const auto finding = find(seen);
  EXPECT_EQ(finding.what, "lateral malleolus in view 1");
  ASSERT_EQ(finding.exchanges.size(), 1u);
  EXPECT_FALSE(finding.exchanges[0].whole);
}

TEST_F(SideExchangeTest, JointCentresAloneMakeAMirroredBodyThatFacesAway) {
  // Hips, knees and ankles have no front: a mirrored body fits as one that faces away. Where the rig says which way
  // forward is, the names are doubted; where it does not, nothing can be said.
  auto seen = picks({"femoral_head_center_r", "femoral_head_center_l", "medial_condyle_center_r",
                     "medial_condyle_center_l", "lateral_condyle_center_r", "lateral_condyle_center_l",
                     "tibial_plafond_center_r", "tibial_plafond_center_l"});
  for (auto& pick : seen) pick.landmark = withOtherSide(pick.landmark);
  ExchangeOptions options;
  options.anterior_W = Eigen::Vector3d::UnitX();
  EXPECT_EQ(find(seen, options).what, "all landmarks of both views");
}

TEST(ExchangeWords, TakeTheLargestWhole) {
  // Femur and tibia in two views, three pairs each.
  std::vector<NamedPair> pairs;
  for (const int view : {0, 1})
    for (const char* bone : {"femur", "tibia"})
      for (int i = 0; i < 3; ++i) pairs.push_back({view, std::string{bone} + "_" + std::to_string(i), bone, i, i});
  const auto words = [&](const std::vector<int>& exchanged, const std::vector<int>& either) {
    std::vector<PairVerdict> verdicts(pairs.size(), PairVerdict::AsNamed);
    std::vector<bool> swapped(pairs.size());
    for (const int p : exchanged) verdicts[std::size_t(p)] = PairVerdict::Exchanged, swapped[std::size_t(p)] = true;
    for (const int p : either) verdicts[std::size_t(p)] = PairVerdict::Either;
    return wordsFor(pairs, verdicts, swapped, 2);
  };
  EXPECT_EQ(words({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}, {}).what, "all landmarks of both views");
  EXPECT_EQ(words({0, 1, 3, 4}, {2, 5}).what, "all landmarks of view 1");  // the undecided go with the whole
  EXPECT_EQ(words({0, 1, 3, 4}, {2, 5}).exchanges[0].landmarks.size(), 6u);
  EXPECT_EQ(words({3, 4, 5, 9, 10, 11}, {}).what, "tibia in both views");
  EXPECT_EQ(words({3, 4}, {5}).what, "tibia in view 1");
  EXPECT_EQ(words({3}, {}).what, "tibia 0 in view 1");
  EXPECT_EQ(words({}, {0, 1, 2}).what, "");
}

TEST(WithOtherSide, IsItsOwnInverseAndLeavesTheMidline) {
  EXPECT_EQ(withOtherSide("ankle_r"), "ankle_l");
  EXPECT_EQ(withOtherSide("ankle_l"), "ankle_r");
  EXPECT_EQ(withOtherSide("sacral_endplate_center"), "sacral_endplate_center");
}

}  // namespace
}  // namespace sinew
