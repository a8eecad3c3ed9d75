#include "clinical/pipeline/side_check.h"

#include <gmock/gmock.h>

#include "clinical/pipeline/patient_fit.h"
#include "clinical/synthetic/synthetic_patient.h"
#include "clinical/synthetic/synthetic_rig.h"
#include "core/skeleton/shape/bone_field.h"
#include "tests/support/resources.h"

namespace sinew {
namespace {

using testing::IsEmpty;

/// A synthetic patient picked with 1 mm noise.
class SideCheck : public testing::TestWithParam<int> {
 protected:
  SideCheck() {
    RandomSource shape{3, 1}, posture{3, 2}, picking{3, 3};
    const auto skeleton = deformedSkeleton(reference_, drawPatientShape(loadShapePriors(test::resourceDir()), shape));
    const auto standing = drawPatientPosture(skeleton, floorHeight_m(SyntheticRig::ConeBeam), posture);
    rig_ = drawTrueRig(SyntheticRig::ConeBeam, 3, 1, GetParam());
    picks_ = drawSightings(skeleton, standing, rig_, test::resourceDir(), 1, picking);
  }
  ExchangeFinding examine(const std::vector<Sighting>& picks) const {
    return examineSides(reference_, rig_, picks, test::resourceDir());
  }
  Skeleton reference_ = loadReferenceSkeleton(test::resourceDir());
  BiplanarRig rig_;
  std::vector<Sighting> picks_;
};
INSTANTIATE_TEST_SUITE_P(Views, SideCheck, testing::Values(2, 3));

TEST_P(SideCheck, GoodPicksAreUsedAsTheyAre) {
  const auto finding = examine(picks_);
  EXPECT_THAT(warningsOf(finding), IsEmpty());
  const auto fit = fitPatient(reference_, rig_, picks_, test::resourceDir());
  ASSERT_EQ(fit.outcome, Outcome::Converged);
  EXPECT_FALSE(disagreeGrossly(fit, finding.exchanges));
}

TEST_P(SideCheck, AMirroredPatientIsNamedRefusedAndPutRight) {
  auto wrong = picks_;
  for (auto& s : wrong) s.name = withOtherSide(s.name);
  const auto finding = examine(wrong);
  ASSERT_EQ(warningsOf(finding).size(), 1u);
  EXPECT_EQ(warningsOf(finding)[0].code, kSidesExchanged);
  EXPECT_THAT(finding.what, testing::EndsWith(GetParam() == 2 ? "both views" : "all views"));
  EXPECT_TRUE(disagreeGrossly({}, finding.exchanges));
  applyExchange(wrong, finding.exchanges);
  EXPECT_EQ(wrong, picks_);
  applyExchange(wrong, finding.exchanges);
  EXPECT_NE(wrong, picks_);  // a second time exchanges back
}

TEST_P(SideCheck, PicksOfNoLandmarkSayNothing) {
  EXPECT_THAT(examine({{"bead_1", 0, {100, 100}, 1}}).exchanges, IsEmpty());
}

}  // namespace
}  // namespace sinew
