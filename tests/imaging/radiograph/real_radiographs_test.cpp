// Real files of several makers; what is expected was read from them with other programs.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <gmock/gmock.h>

#include <filesystem>

#include "imaging/radiograph/radiograph.h"
#include "tests/support/resources.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

TEST(RealRadiographs, FourCodingsOfOneAnkleGiveTheSamePixels) {
  SINEW_NEEDS_EXTERNAL("radiographs");
  const Radiograph rle = readRadiograph(external_file / "RG3_RLE.dcm");
  EXPECT_EQ(rle.width_px, 1760);
  EXPECT_EQ(rle.height_px, 1760);
  EXPECT_EQ(rle.bits_stored, 10);
  EXPECT_TRUE(rle.monochrome1);
  EXPECT_FALSE(rle.spacing);  // none in the file, none invented
  EXPECT_THAT(rle.warnings, testing::Contains(testing::Field(&Warning::code, "pixel_spacing_missing")));
  EXPECT_EQ(rle.window_center, 550);
  EXPECT_EQ(rle.window_width, 1024);
  for (const char* name : {"RG3_JPLL.dcm", "RG3_JLSL.dcm", "RG3_J2KR.dcm"}) {
    const Radiograph other = readRadiograph(external_file / name);
    EXPECT_TRUE(*other.pixels == *rle.pixels) << name;
    EXPECT_NE(other.tags.transfer_syntax, rle.tags.transfer_syntax);
  }
}

TEST(RealRadiographs, ChestWithoutPreamble) {
  SINEW_NEEDS_EXTERNAL("radiographs/CR-MONO1-10-chest");
  const Radiograph r = readRadiograph(external_file);
  EXPECT_EQ(r.width_px, 440);
  EXPECT_EQ(r.height_px, 440);
  EXPECT_TRUE(r.monochrome1);
  EXPECT_EQ(r.at(0, 0), 0);
  EXPECT_EQ(r.at(1, 0), 0xd1);
  EXPECT_EQ(r.at(2, 0), 0x30e);
}

TEST(RealRadiographs, OverlayOutsideTheImageDoesNoHarm) {
  SINEW_NEEDS_EXTERNAL("radiographs/OutOfBoundsOverlay.dcm");
  const Radiograph r = readRadiograph(external_file);
  EXPECT_EQ(r.width_px, 1318);
  EXPECT_EQ(r.height_px, 788);
  ASSERT_TRUE(r.spacing);
  EXPECT_EQ(r.spacing->source, PixelScaleSource::ImagerMagnified);
  EXPECT_NEAR(r.spacing->column_mm, 0.085 * 623 / 650, 1e-9);
}

TEST(RealRadiographs, KoreanNameIsShownRight) {
  SINEW_NEEDS_EXTERNAL("radiographs/chrKoreanMulti.dcm");
  const test::TemporaryFolder folder;
  DcmFileFormat format;  // the sample is a header; an image is put into it
  ASSERT_TRUE(format.loadFile(external_file.c_str()).good());
  EXPECT_THROW(readRadiograph(external_file), InputError);
  const std::vector<Uint16> pixels(32 * 32, 100);
  ASSERT_TRUE(format.getDataset()->putAndInsertUint16Array(DCM_PixelData, pixels.data(), pixels.size()).good());
  ASSERT_TRUE(format.saveFile((folder / "a.dcm").c_str(), EXS_LittleEndianExplicit).good());
  // KS X 1001 code points B1E8 C8F1 C1DF of the file, looked up by hand: U+AE40 U+D76C U+C911.
  EXPECT_EQ(readRadiograph(folder / "a.dcm").tags.patient_name, "\xea\xb9\x80\xed\x9d\xac\xec\xa4\x91");
}

TEST(RealRadiographs, BiplaneFrame) {
  SINEW_NEEDS_EXTERNAL("biplane_wrist/xr_rad_uln_cam01_UND.0099.tif");
  const Radiograph r = readRadiograph(external_file);
  EXPECT_EQ(r.width_px, 1760);
  EXPECT_EQ(r.height_px, 1760);
  EXPECT_EQ(r.bits_stored, 8);
  const auto mean = [&](int u0, int v0, int half) {
    double sum = 0;
    for (int v = v0 - half; v <= v0 + half; ++v)
      for (int u = u0 - half; u <= u0 + half; ++u) sum += r.at(u, v);
    return sum / ((2 * half + 1) * (2 * half + 1));
  };
  EXPECT_GT(std::abs(mean(948, 1417, 1) - mean(948, 1417, 25)), 15);  // bead A stands out where it should be
}

}  // namespace
}  // namespace sinew
