#include <gtest/gtest.h>

#include "clinical/synthetic/synthetic_case.h"
#include "imaging/calibration/calibrate.h"
#include "imaging/calibration/detect_beads.h"
#include "imaging/rig/rig_from_dicom.h"
#include "imaging/rig/triangulate.h"

namespace sinew {
namespace {

/// The bead phantom of the demo, half the resolution: 0.56 mm pixels, small beads of 8 px.
class RenderedPhantom : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    SyntheticOptions options;
    options.seed = 7;
    options.binning = 2;
    phantom = syntheticPhantom();
    truth = drawTrueRig(options.rig, options.seed, options.binning);
    for (std::size_t i = 0; i < 2; ++i)
      films[i] = renderPhantom(phantom, truth.views[i], options, filmGeometry(options.rig)[i].view_position);
  }
  static CalibrationObject phantom;
  static BiplanarRig truth;
  static std::array<Radiograph, 2> films;
};
CalibrationObject RenderedPhantom::phantom;
BiplanarRig RenderedPhantom::truth;
std::array<Radiograph, 2> RenderedPhantom::films;

TEST_F(RenderedPhantom, BeadsAreFoundWhereTheyProject) {
  for (std::size_t i = 0; i < 2; ++i) {
    const auto found = detectBeads(films[i]);
    double sum2 = 0;
    for (const auto& bead : phantom.beads) {
      const Eigen::Vector2d uv = *project(truth.views[i], bead.p_WQ);
      double nearest = 1e9;
      for (const auto& f : found) nearest = std::min(nearest, (f.uv_px - uv).norm());
      // The shadows of S06 and S12 nearly touch in the lateral view; all others are within 0.3 px.
      EXPECT_LT(nearest, 1) << bead.name << " in view " << i + 1;
      sum2 += nearest * nearest;
    }
    EXPECT_LT(std::sqrt(sum2 / double(phantom.beads.size())), 0.15);
    EXPECT_LE(found.size(), phantom.beads.size() + 2);  // a corner of the frame may look round
  }
}

TEST_F(RenderedPhantom, CalibratesBackToTheTrueRig) {
  const auto calibration =
      calibrateFromBeads(phantom, std::array{detectBeads(films[0]), detectBeads(films[1])}, rigFromDicom(films));
  ASSERT_EQ(calibration.outcome, Outcome::Converged);
  EXPECT_LT(calibration.rms_px, 0.2);
  // Points where landmarks are: seen by the true rig, located by the calibrated one.
  for (const Eigen::Vector3d& p_W : {Eigen::Vector3d{0, 0.32, 0.09}, Eigen::Vector3d{0.03, -0.07, -0.1},
                                     Eigen::Vector3d{-0.05, -0.5, 0.12}, Eigen::Vector3d{-0.08, 0.42, -0.12}}) {
    std::vector<Sighting> pair;
    for (const int i : {0, 1}) pair.push_back({"p", i, *project(truth.views[std::size_t(i)], p_W), 1});
    const auto point = triangulate(calibration.rig, pair);
    ASSERT_TRUE(point.has_value());
    EXPECT_LT((point->p_WL - p_W).norm(), 0.3e-3) << p_W.transpose();
  }
}

}  // namespace
}  // namespace sinew
