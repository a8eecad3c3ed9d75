#include <gmock/gmock.h>

#include <opencv2/imgcodecs.hpp>

#include "core/file.h"
#include "tests/imaging/sample_radiograph.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

class PlainImage : public testing::Test {
 protected:
  const test::TemporaryFolder folder;
  std::filesystem::path write(const cv::Mat& image, const std::string& name) const {
    std::vector<unsigned char> bytes;
    EXPECT_TRUE(cv::imencode(name.substr(name.find('.')), image, bytes));
    writeFileAtomically(folder / name, std::string{bytes.begin(), bytes.end()});
    return folder / name;
  }
};

TEST_F(PlainImage, SixteenBitPngAndTiffAreExact) {
  const Radiograph r = test::sampleRadiograph();
  const cv::Mat image{r.height_px, r.width_px, CV_16U, const_cast<std::uint16_t*>(r.pixels->data())};
  for (const char* name : {"a.png", "a.tif"}) {
    const Radiograph back = readRadiograph(write(image, name), 0.15);
    EXPECT_EQ(*back.pixels, *r.pixels) << name;
    EXPECT_EQ(back.bits_stored, 16);
    EXPECT_FALSE(back.monochrome1);
    EXPECT_EQ(back.spacing, (PixelSpacing{0.15, 0.15, PixelScaleSource::Declared}));
    EXPECT_THAT(back.warnings, testing::IsEmpty());
  }
}

TEST_F(PlainImage, WithoutADeclaredSizeLengthsAreInPixels) {
  const Radiograph r = readRadiograph(write(cv::Mat(5, 4, CV_8U, cv::Scalar{90}), "a.png"));
  EXPECT_FALSE(r.spacing);
  ASSERT_EQ(r.warnings.size(), 1u);
  EXPECT_EQ(r.warnings[0].code, "pixel_spacing_missing");
  EXPECT_EQ(r.bits_stored, 8);
  EXPECT_EQ(r.at(3, 4), 90);
}

TEST_F(PlainImage, ColourImagesPassOnlyWithoutColour) {
  cv::Mat colour(4, 4, CV_8UC3, cv::Scalar{7, 7, 7});
  EXPECT_EQ(readRadiograph(write(colour, "grey.png")).at(0, 0), 7);
  colour.at<cv::Vec3b>(2, 2) = {7, 8, 7};
  EXPECT_THROW(readRadiograph(write(colour, "colour.png")), InputError);
}

TEST_F(PlainImage, RefusesAnAbsurdDeclaredSize) {
  const auto file = write(cv::Mat(5, 4, CV_8U, cv::Scalar{90}), "a.png");
  for (const double mm : {0.0, -0.1, 50.0, std::nan("")}) EXPECT_THROW(readRadiograph(file, mm), InputError) << mm;
}

TEST_F(PlainImage, TiffThatCountsWhiteAsZeroKeepsItsMeaning) {
  // A 2 x 1 TIFF by hand: 0 is white and 255 black. Shown, the first pixel must be bright.
  for (const int bits : {8, 16}) {
    std::string t{"II*\0\x08\0\0\0", 8};
    const auto u16 = [&](int v) { t += char(v & 255), t += char(v >> 8); };
    const auto entry = [&](int tag, int type, int value) { u16(tag), u16(type), u16(1), u16(0), u16(value), u16(0); };
    u16(9);
    entry(256, 3, 2), entry(257, 3, 1), entry(258, 3, bits), entry(259, 3, 1), entry(262, 3, 0);
    entry(273, 4, 8 + 2 + 9 * 12 + 4), entry(277, 3, 1), entry(278, 3, 1), entry(279, 4, 2 * bits / 8);
    u16(0), u16(0);
    t += bits == 8 ? std::string{"\x00\xff", 2} : std::string{"\x00\x00\xff\xff", 4};
    writeFileAtomically(folder / "white.tif", t);
    const Radiograph r = readRadiograph(folder / "white.tif");
    const auto shown = displayPixels(r, bits == 8 ? 128 : 32768, bits == 8 ? 256 : 65536, false);
    EXPECT_THAT(shown, testing::ElementsAre(255, 0)) << bits;
  }
}

}  // namespace
}  // namespace sinew
