#include "imaging/rig/biplanar_rig.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/file.h"
#include "tests/imaging/rigs.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using testing::HasSubstr;

std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(BiplanarRig, FileGivesBackTheSameRig) {
  const test::TemporaryFolder folder;
  for (BiplanarRig rig : {test::coneBeamRig(), test::slotScanRig()}) {
    rig.calibration.warnings.push_back({"uncalibrated", "Lengths are good to 3-5 %."});
    rig.patient_aligned = false;
    saveRig(rig, folder / "rig.json");
    const BiplanarRig back = loadRig(folder / "rig.json");
    EXPECT_EQ(back, rig);
    EXPECT_EQ(std::isnan(back.calibration.rms_px), std::isnan(rig.calibration.rms_px));
  }
}

TEST(BiplanarRig, FileGivesBackAMirroredOrthographicView) {
  const test::TemporaryFolder folder;
  BiplanarRig rig = test::coneBeamRig();
  rig.views[0].projection = Orthographic{0.0002, 0.0003, 10.5, 20.25};
  rig.views[0].R_CW.row(0) *= -1;
  rig.calibration.id = geometryId(rig.views);
  saveRig(rig, folder / "rig.json");
  EXPECT_EQ(loadRig(folder / "rig.json"), rig);
}

TEST(BiplanarRig, IdNamesTheGeometryAlone) {
  BiplanarRig rig = test::coneBeamRig(), moved = rig;
  EXPECT_EQ(geometryId(rig.views).size(), 12u);
  moved.views[1].p_CW.z() += 1e-4;
  EXPECT_NE(geometryId(rig.views), geometryId(moved.views));
}

TEST(BiplanarRig, BadFilesAreAnsweredInOneLine) {
  const test::TemporaryFolder folder;
  const auto file = folder / "rig.json";
  saveRig(test::coneBeamRig(), file);
  const std::string good = readFile(file);
  const auto replaced = [&](const std::string& what, const std::string& by) {
    std::string text = good;
    const auto at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    writeFileAtomically(file, text.replace(at, what.size(), by));
    return messageOf([&] { loadRig(file); });
  };
  EXPECT_THAT(replaced("\"version\": 1", "\"version\": 2"), HasSubstr("version"));
  EXPECT_THAT(replaced("sinew.rig", "sinew.case"), HasSubstr("format"));
  EXPECT_THAT(replaced("\"fx_px\": 6000", "\"fx_px\": -6000"), HasSubstr("fx_px"));
  EXPECT_THAT(replaced("\"width_px\": 2000", "\"width_px\": 4000000"), HasSubstr("width_px"));
  EXPECT_THAT(replaced("cone_beam", "fisheye"), HasSubstr("projection"));
  EXPECT_THAT(replaced("-1.0", "-1.5"), HasSubstr("R_CW"));
  writeFileAtomically(file, good.substr(0, good.size() / 2));
  EXPECT_THAT(messageOf([&] { loadRig(file); }), HasSubstr("rig.json"));
}

TEST(BiplanarRig, AngleBetweenViews) {
  BiplanarRig rig = test::coneBeamRig();
  rig.views[0].projection = ConeBeam{6000, 6000, 999.5, 2199.5};
  rig.views[1].projection = ConeBeam{6000, 6000, 999.5, 2199.5};
  EXPECT_NEAR(angleBetweenViews_rad(rig), M_PI / 2, 1e-12);
}

class TextCalibration : public testing::Test {
 protected:
  const test::TemporaryFolder folder;
  const std::string good =
      "image size\n640,480\n\ncamera matrix\n2000,0,320\n0,2010,240\n0,0,1\n\nrotation\n1,0,0\n0,1,0\n0,0,1\n\n"
      "translation\n10\n20\n900\n";
  BiplanarRig import(const std::string& first) const {
    writeFileAtomically(folder / "cam1.txt", first);
    std::string second = good;
    second.replace(second.find("1,0,0\n0,1,0\n0,0,1\n\ntranslation"), 17, "0,0,1\n0,1,0\n-1,0,0");
    writeFileAtomically(folder / "cam2.txt", second);
    return importTextCalibration(std::vector{folder / "cam1.txt", folder / "cam2.txt"}, "mayacam");
  }
  std::string error(const std::string& what, const std::string& by) const {
    std::string text = good;
    text.replace(text.find(what), what.size(), by);
    return messageOf([&] { import(text); });
  }
};

TEST_F(TextCalibration, ReadsMillimetresAndTheLaboratoryFrame) {
  const BiplanarRig rig = import(good);
  EXPECT_FALSE(rig.patient_aligned);
  EXPECT_EQ(rig.calibration.method, "mayacam");
  EXPECT_EQ(rig.views[0].width_px, 640);
  EXPECT_EQ(rig.views[0].height_px, 480);
  EXPECT_EQ(std::get<ConeBeam>(rig.views[0].projection), (ConeBeam{2000, 2010, 320, 240}));
  // x = K (R X + t) by hand: X = (0.1, 0, 0.1) m, R X + t = (0.11, 0.02, 1.0) m.
  const Eigen::Vector2d uv = *project(rig.views[0], Eigen::Vector3d{0.1, 0, 0.1});
  EXPECT_NEAR(uv.x(), 2000 * 0.11 + 320, 1e-9);
  EXPECT_NEAR(uv.y(), 2010 * 0.02 + 240, 1e-9);
}

TEST_F(TextCalibration, ReadsWindowsLineEndsAndAnyCase) {
  std::string text = "Image Size\r\n";
  for (char c : good.substr(good.find('\n') + 1)) text += c == '\n' ? std::string{"\r\n"} : std::string(1, c);
  EXPECT_EQ(import(text), import(good));
}

TEST_F(TextCalibration, RefusesWhatIsNoCalibration) {
  EXPECT_THAT(error("0,0,1\n\nrotation", "0,0,2\n\nrotation"), HasSubstr("camera matrix"));
  EXPECT_THAT(error("2000,0,320", "-2000,0,320"), HasSubstr("camera matrix"));
  EXPECT_THAT(error("2000,0,320", "2000,9,320"), HasSubstr("no skew"));
  EXPECT_THAT(error("rotation\n1,0,0", "rotation\n1,0.1,0"), HasSubstr("rotation: expected three orthogonal"));
  EXPECT_THAT(error("rotation\n1,0,0", "rotation\n-1,0,0"), HasSubstr("determinant"));
  EXPECT_THAT(error("20\n900", "20"), HasSubstr("translation: expected 3 x 1 numbers"));
  EXPECT_THAT(error("640,480", "640.5,480"), HasSubstr("image size"));
  EXPECT_THAT(error("camera matrix", "camera"), HasSubstr("camera matrix"));
  EXPECT_THAT(error("image size\n", ""), HasSubstr("MayaCam 2"));
  EXPECT_THAT(error("900", "nine hundred"), HasSubstr("translation"));
  EXPECT_THAT(messageOf([&] { importTextCalibration(std::vector{folder / "cam1.txt"}, "mayacam"); }),
              HasSubstr("2 or more, one a view"));
}

TEST_F(TextCalibration, WarnsOfNearlyParallelViews) {
  import(good);
  const auto rig = importTextCalibration(std::vector{folder / "cam1.txt", folder / "cam1.txt"}, "autoscoper");
  ASSERT_EQ(rig.calibration.warnings.size(), 1u);
  EXPECT_EQ(rig.calibration.warnings[0].code, "views_nearly_parallel");
}

}  // namespace
}  // namespace sinew
