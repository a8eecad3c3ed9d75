// Damaged files either read or are refused in one line: no crash, no huge allocation.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcrleerg.h>
#include <dcmtk/dcmdata/dcrlerp.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmjpeg/djencode.h>
#include <dcmtk/dcmjpeg/djrplol.h>
#include <dcmtk/dcmjpls/djencode.h>
#include <dcmtk/dcmjpls/djrparam.h>
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <random>

#include "core/file.h"
#include "tests/imaging/sample_radiograph.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

/// Peak memory of the process so far.
long peak_kB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

class DamagedImage : public testing::Test {
 protected:
  const test::TemporaryFolder folder;

  bool reads(const std::string& bytes, const std::string& name) const {
    std::ofstream{folder / name, std::ios::binary} << bytes;
    try {
      const Radiograph r = readRadiograph(folder / name);
      EXPECT_EQ(r.pixels->size(), std::size_t(r.width_px) * std::size_t(r.height_px));
      return true;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string{error.what()}.find('\n'), std::string::npos);
      return false;
    }
  }

  void damage(const std::string& good, const std::string& name) const {
    ASSERT_TRUE(reads(good, name));
    const long before_kB = peak_kB();
    std::mt19937 random{20240};
    std::uniform_int_distribution<std::size_t> anywhere{0, good.size() - 1},
        head{0, std::min<std::size_t>(good.size(), 1600) - 1};
    int refused = 0;
    for (int i = 0; i < 100; ++i) refused += !reads(good.substr(0, anywhere(random)), name);
    EXPECT_GE(refused, 99);  // a file cut in its last padding may still be whole
    for (int i = 0; i < 300; ++i) {
      std::string bad = good;
      for (int k = 0; k <= i % 4; ++k) bad[head(random)] = char(random());
      reads(bad, name);
    }
    for (int i = 0; i < 50; ++i) {
      std::string bad = good;
      bad[anywhere(random)] ^= char(1 << (i % 8));
      reads(bad, name);
    }
    EXPECT_LT(peak_kB() - before_kB, 300'000);  // far below what a damaged size field could ask for
  }
};

TEST_F(DamagedImage, Dicom) {
  writeDicom(test::sampleRadiograph(), folder / "good.dcm");
  damage(readFile(folder / "good.dcm"), "bad.dcm");
}

TEST_F(DamagedImage, CompressedDicom) {
  DJEncoderRegistration::registerCodecs();
  DJLSEncoderRegistration::registerCodecs();
  DcmRLEEncoderRegistration::registerCodecs();
  const DJ_RPLossless jpeg;
  const DJLSRepresentationParameter jpeg_ls{2, OFTrue};
  const DcmRLERepresentationParameter rle;
  const std::pair<E_TransferSyntax, const DcmRepresentationParameter*> codings[] = {
      {EXS_JPEGProcess14SV1, &jpeg}, {EXS_JPEGLSLossless, &jpeg_ls}, {EXS_RLELossless, &rle}};
  for (const auto& [syntax, parameter] : codings) {
    writeDicom(test::sampleRadiograph(), folder / "good.dcm");
    DcmFileFormat format;
    ASSERT_TRUE(format.loadFile((folder / "good.dcm").c_str()).good());
    ASSERT_TRUE(format.getDataset()->chooseRepresentation(syntax, parameter).good());
    ASSERT_TRUE(format.saveFile((folder / "coded.dcm").c_str(), syntax).good());
    const std::string good = readFile(folder / "coded.dcm");
    ASSERT_TRUE(reads(good, "bad.dcm"));
    const long before_kB = peak_kB();
    std::mt19937 random{31};
    for (int i = 0; i < 150; ++i) {
      std::string bad = good;
      bad[good.size() - 1 - random() % (good.size() / 2)] = char(random());  // in the code stream
      reads(bad, "bad.dcm");
    }
    EXPECT_LT(peak_kB() - before_kB, 300'000);
  }
}

TEST_F(DamagedImage, PngAndTiff) {
  const Radiograph r = test::sampleRadiograph();
  const cv::Mat image{r.height_px, r.width_px, CV_16U, const_cast<std::uint16_t*>(r.pixels->data())};
  for (const std::string kind : {"png", "tif"}) {
    std::vector<unsigned char> bytes;
    ASSERT_TRUE(cv::imencode("." + kind, image, bytes));
    std::string good{bytes.begin(), bytes.end()};
    EXPECT_TRUE(reads(good, "good." + kind));
    testing::internal::CaptureStderr();  // the decoders complain there
    EXPECT_FALSE(reads(good.substr(0, 30), "cut." + kind));
    std::mt19937 random{7};
    for (int i = 0; i < 200; ++i) {
      std::string bad = good;
      bad[random() % std::min<std::size_t>(bad.size(), 200)] = char(random());
      reads(bad, "bad." + kind);
    }
    testing::internal::GetCapturedStderr();
  }
}

TEST_F(DamagedImage, WhatIsNoImage) {
  EXPECT_FALSE(reads("", "empty.dcm"));
  EXPECT_FALSE(reads(std::string(128, '\0') + "DICM", "preamble.dcm"));
  EXPECT_FALSE(reads("%PDF-1.4", "report.dcm"));
  EXPECT_THROW(readRadiograph(folder / "absent.dcm"), InputError);
  EXPECT_THROW(readRadiograph(folder.path()), InputError);
}

}  // namespace
}  // namespace sinew
