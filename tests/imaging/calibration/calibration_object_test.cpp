#include "imaging/calibration/calibration_object.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "core/file.h"
#include "imaging/calibration/calibration_internal.h"
#include "tests/imaging/rigs.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using testing::HasSubstr;

std::vector<Eigen::Vector3d> places(const CalibrationObject& object) {
  std::vector<Eigen::Vector3d> out;
  for (const auto& bead : object.beads) out.push_back(bead.p_WQ);
  return out;
}

TEST(CalibrationObject, DefaultFillsALowerLimb) {
  const auto object = defaultCalibrationObject();
  ASSERT_EQ(object.beads.size(), 32u);
  Eigen::Vector3d low = object.beads[0].p_WQ, high = low;
  for (const auto& p : places(object)) low = low.cwiseMin(p), high = high.cwiseMax(p);
  EXPECT_LT((high - low - Eigen::Vector3d{0.40, 1.12, 0.50}).norm(), 1e-12);
  EXPECT_LT((high + low).norm(), 1e-12);
  EXPECT_GT(flatness(places(object)), 0.3);
}

TEST(CalibrationObject, NoBeadOfTheDefaultHidesAnother) {
  const auto object = defaultCalibrationObject();
  for (const double source_m : {1.2, 1.5, 2.0, 3.0})
    for (const auto& R : test::frontalAndLateral()) {
      const View view{ConeBeam{1, 1, 0, 0}, R, {0, 0, source_m}, 1, 1};
      for (const auto& a : object.beads)
        for (const auto& b : object.beads)
          if (&a != &b) {
            const double apart_m = (*project(view, a.p_WQ) - *project(view, b.p_WQ)).norm() * source_m;
            EXPECT_GT(apart_m, 0.012) << a.name << " " << b.name << " from " << source_m;
          }
    }
}

TEST(CalibrationObject, NoTurnOrMirrorMapsTheDefaultOntoItself) {
  const auto object = defaultCalibrationObject();
  for (int signs = 1; signs < 8; ++signs) {
    const Eigen::Vector3d s{signs & 1 ? -1. : 1., signs & 2 ? -1. : 1., signs & 4 ? -1. : 1.};
    int coincide = 0;
    for (const auto& a : object.beads)
      for (const auto& b : object.beads) coincide += (a.p_WQ.cwiseProduct(s) - b.p_WQ).norm() < 0.010;
    EXPECT_LT(coincide, 8) << signs;
  }
}

TEST(CalibrationObject, FileGivesItBack) {
  const test::TemporaryFolder folder;
  const auto object = defaultCalibrationObject();
  saveCalibrationObject(object, folder / "lower_limb_frame.csv");
  const auto back = loadCalibrationObject(folder / "lower_limb_frame.csv");
  ASSERT_EQ(back.beads.size(), object.beads.size());
  EXPECT_EQ(back.name, object.name);
  for (std::size_t i = 0; i < back.beads.size(); ++i) {
    EXPECT_EQ(back.beads[i].name, object.beads[i].name);
    EXPECT_LT((back.beads[i].p_WQ - object.beads[i].p_WQ).norm(), 1e-9);
    EXPECT_NEAR(back.beads[i].diameter_m, object.beads[i].diameter_m, 1e-12);
  }
}

TEST(CalibrationObject, RefusesFilesThatCannotCalibrate) {
  const test::TemporaryFolder folder;
  const auto error = [&](const std::string& text) {
    writeFileAtomically(folder / "beads.csv", text);
    try {
      loadCalibrationObject(folder / "beads.csv");
    } catch (const InputError& problem) {
      return std::string{problem.what()};
    }
    return std::string{"no error"};
  };
  std::string plane = "name,x_mm,y_mm,z_mm\n", good = plane;
  for (int i = 0; i < 9; ++i) {
    const std::string xy =
        "b" + std::to_string(i) + "," + std::to_string(i % 3 * 100) + "," + std::to_string(i / 3 * 100);
    plane += xy + ",5\n";
    good += xy + "," + std::to_string(i * i % 7 * 40) + "\n";
  }
  EXPECT_EQ(error(good), "no error");
  EXPECT_THAT(error(plane), HasSubstr("fill a volume"));
  EXPECT_THAT(error("name,x_mm,y_mm,z_mm\na,1,2,3\n"), HasSubstr("beads: expected 8 or more, found 1"));
  EXPECT_THAT(error("x,y,z\n"), HasSubstr("header"));
  EXPECT_THAT(error(good + "b1,7,8,9\n"), HasSubstr("'b1' twice"));
  EXPECT_THAT(error(good + "c,0,0,0\n"), HasSubstr("that of 'b0'"));
  EXPECT_THAT(error(good + "c,0,nine,0\n"), HasSubstr("y_mm"));
  EXPECT_THAT(error(good + "c,0,9,0,-3\n"), HasSubstr("diameter_mm"));
}

}  // namespace
}  // namespace sinew
