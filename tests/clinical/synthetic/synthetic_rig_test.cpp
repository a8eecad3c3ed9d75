#include "clinical/synthetic/synthetic_rig.h"

#include <gtest/gtest.h>

#include "imaging/rig/rig_from_dicom.h"

namespace sinew {
namespace {

std::array<Radiograph, 2> filmsOf(SyntheticRig kind) {
  std::array<Radiograph, 2> films;
  const auto geometry = filmGeometry(kind);
  for (std::size_t i = 0; i < 2; ++i) {
    films[i].width_px = geometry[i].width_px;
    films[i].height_px = geometry[i].height_px;
    setGeometryTags(films[i], geometry[i], kind);
  }
  return films;
}

class EitherRig : public testing::TestWithParam<SyntheticRig> {};

TEST_P(EitherRig, TagsDescribeTheNominalGeometry) {
  const auto films = filmsOf(GetParam());
  const BiplanarRig read = rigFromDicom(films), nominal = nominalRig(GetParam());
  EXPECT_EQ(read.calibration.method, nominal.calibration.method);
  EXPECT_TRUE(read.patient_aligned);
  for (std::size_t i = 0; i < 2; ++i)
    for (const Eigen::Vector3d& p : {Eigen::Vector3d{0.1, 0.3, -0.12}, Eigen::Vector3d{-0.08, -0.5, 0.1}})
      EXPECT_LT((*project(read.views[i], p) - *project(nominal.views[i], p)).norm(), 1e-6) << i;
}

TEST_P(EitherRig, ImagesAreHungAsRadiographsAre) {
  const BiplanarRig rig = drawTrueRig(GetParam(), 3);
  const auto at = [&](int view, const Eigen::Vector3d& p) { return *project(rig.views[std::size_t(view)], p); };
  EXPECT_GT(at(0, {0, 0, -0.1}).x(), at(0, {0, 0, 0.1}).x());  // patient's left at the right of the frontal film
  EXPECT_GT(at(1, {0.1, 0, 0}).x(), at(1, {-0.1, 0, 0}).x());  // he looks to the right in the lateral one
  for (const int view : {0, 1}) EXPECT_GT(at(view, {0, -0.1, 0}).y(), at(view, {0, 0.1, 0}).y());
  const Eigen::Vector3d floor{0, floorHeight_m(GetParam()), 0};
  for (const int view : {0, 1}) EXPECT_LT(at(view, floor).y(), rig.views[std::size_t(view)].height_px - 20);
}

INSTANTIATE_TEST_SUITE_P(Synthetic, EitherRig, testing::Values(SyntheticRig::ConeBeam, SyntheticRig::SlotScan),
                         [](const auto& kind) {
                           return kind.param == SyntheticRig::ConeBeam ? "ConeBeam" : "SlotScan";
                         });

TEST(SyntheticRig, AThirdObliqueFilmIsDescribedByItsTags) {
  std::vector<Radiograph> films;
  for (const auto& geometry : filmGeometry(SyntheticRig::ConeBeam, 1, 3)) {
    Radiograph film;
    film.width_px = geometry.width_px;
    film.height_px = geometry.height_px;
    setGeometryTags(film, geometry, SyntheticRig::ConeBeam);
    films.push_back(film);
  }
  const BiplanarRig read = rigFromDicom(films), nominal = nominalRig(SyntheticRig::ConeBeam, 1, 3);
  ASSERT_EQ(read.views.size(), 3u);
  EXPECT_EQ(read.views[2].role, ViewRole::Oblique);
  const Eigen::Vector3d p{0.1, 0.3, -0.12};
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT((*project(read.views[i], p) - *project(nominal.views[i], p)).norm(), 1e-6) << i;
  // The first two views are those of the pair.
  EXPECT_EQ(drawTrueRig(SyntheticRig::ConeBeam, 4, 1, 3).views[1].R_CW,
            drawTrueRig(SyntheticRig::ConeBeam, 4).views[1].R_CW);
}

TEST(DrawTrueRig, ConeBeamIsALittleOffAndTheSeedSaysHow) {
  const BiplanarRig nominal = nominalRig(SyntheticRig::ConeBeam);
  const BiplanarRig a = drawTrueRig(SyntheticRig::ConeBeam, 1), b = drawTrueRig(SyntheticRig::ConeBeam, 2);
  EXPECT_EQ(a.views, drawTrueRig(SyntheticRig::ConeBeam, 1).views);
  EXPECT_NE(a.views, b.views);
  for (std::size_t i = 0; i < 2; ++i) {
    const double shift_px =
        (*project(a.views[i], Eigen::Vector3d{0, 0, 0}) - *project(nominal.views[i], Eigen::Vector3d{0, 0, 0}))
            .norm();
    EXPECT_GT(shift_px, 1);    // uncalibrated picks would be wrong by millimetres
    EXPECT_LT(shift_px, 120);  // 34 mm: nobody would notice at the machine
  }
  EXPECT_EQ(drawTrueRig(SyntheticRig::SlotScan, 1).views, nominalRig(SyntheticRig::SlotScan).views);
}

}  // namespace
}  // namespace sinew
