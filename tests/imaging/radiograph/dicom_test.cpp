// DICOM that this program writes, and variants of it that others write.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcrleerg.h>
#include <dcmtk/dcmdata/dcrlerp.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmjpeg/djencode.h>
#include <dcmtk/dcmjpeg/djrplol.h>
#include <dcmtk/dcmjpls/djencode.h>
#include <dcmtk/dcmjpls/djrparam.h>
#include <gmock/gmock.h>

#include <functional>

#include "core/file.h"
#include "tests/imaging/sample_radiograph.h"
#include "tests/support/temporary_folder.h"

namespace sinew {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Dicom : public testing::Test {
 protected:
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "a.dcm";

  /// Writes the sample, lets DCMTK change the data set, reads the result.
  Radiograph changed(const std::function<void(DcmDataset&)>& change,
                     E_TransferSyntax syntax = EXS_LittleEndianExplicit,
                     const DcmRepresentationParameter* parameter = nullptr) const {
    writeDicom(test::sampleRadiograph(), file);
    DcmFileFormat format;
    EXPECT_TRUE(format.loadFile(file.c_str()).good());
    format.loadAllDataIntoMemory();
    if (change) change(*format.getDataset());
    if (parameter) {
      EXPECT_TRUE(format.getDataset()->chooseRepresentation(syntax, parameter).good());
    }
    const OFCondition saved = format.saveFile(file.c_str(), syntax);
    EXPECT_TRUE(saved.good()) << saved.text();
    return readRadiograph(file);
  }
  std::string error(const std::function<void(DcmDataset&)>& change) const {
    try {
      changed(change);
    } catch (const InputError& problem) {
      return problem.what();
    }
    return "no error";
  }
};

std::vector<std::string> codes(const Radiograph& r) {
  std::vector<std::string> out;
  for (const auto& w : r.warnings) out.push_back(w.code);
  return out;
}

void expectSameTags(const RadiographTags& a, const RadiographTags& b) {
  const auto texts = [](const RadiographTags& t) {
    return std::vector{
        t.modality,        t.sop_class_uid, t.sop_instance_uid, t.study_instance_uid, t.frame_of_reference_uid,
        t.transfer_syntax, t.patient_name,  t.patient_id,       t.patient_birth_date, t.patient_sex,
        t.study_date,      t.view_position, t.image_laterality, t.manufacturer,       t.patient_orientation};
  };
  const auto numbers = [](const RadiographTags& t) {
    return std::vector{t.imager_column_mm,
                       t.imager_row_mm,
                       t.distance_source_to_detector_mm,
                       t.distance_source_to_patient_mm,
                       t.distance_source_to_isocenter_mm,
                       t.estimated_magnification,
                       t.positioner_primary_angle_deg,
                       t.positioner_secondary_angle_deg};
  };
  EXPECT_EQ(texts(a), texts(b));
  EXPECT_EQ(numbers(a), numbers(b));
}

TEST_F(Dicom, GivesBackWhatWasWritten) {
  for (const bool monochrome1 : {false, true})
    for (const int bits : {8, 12, 16}) {
      Radiograph r = test::sampleRadiograph();
      r.monochrome1 = monochrome1;
      r.bits_stored = bits;
      auto pixels = *r.pixels;
      for (auto& p : pixels) p = std::uint16_t(bits == 8 ? p >> 4 : bits == 16 ? p * 16 + 7 : p);
      r.pixels = std::make_shared<const std::vector<std::uint16_t>>(pixels);
      writeDicom(r, file);
      const Radiograph back = readRadiograph(file);
      EXPECT_EQ(*back.pixels, *r.pixels);
      EXPECT_EQ(back.width_px, r.width_px);
      EXPECT_EQ(back.height_px, r.height_px);
      EXPECT_EQ(back.bits_stored, bits);
      EXPECT_EQ(back.monochrome1, monochrome1);
      EXPECT_EQ(back.window_center, r.window_center);
      EXPECT_EQ(back.window_width, r.window_width);
      EXPECT_EQ(back.spacing, r.spacing);
      expectSameTags(back.tags, r.tags);
      EXPECT_THAT(back.warnings, testing::IsEmpty());
    }
}

TEST_F(Dicom, WritesEveryMandatoryAttributeOfADigitalXRayImage) {
  writeDicom(test::sampleRadiograph(), file);
  DcmFileFormat format;
  ASSERT_TRUE(format.loadFile(file.c_str()).good());
  // Type 1 of the DX for-presentation modules (PS3.3, A.26): present and not empty.
  for (const auto& tag : {DCM_SOPClassUID,
                          DCM_SOPInstanceUID,
                          DCM_StudyInstanceUID,
                          DCM_SeriesInstanceUID,
                          DCM_Modality,
                          DCM_PresentationIntentType,
                          DCM_FrameOfReferenceUID,
                          DCM_ImageType,
                          DCM_SamplesPerPixel,
                          DCM_PhotometricInterpretation,
                          DCM_Rows,
                          DCM_Columns,
                          DCM_BitsAllocated,
                          DCM_BitsStored,
                          DCM_HighBit,
                          DCM_PixelRepresentation,
                          DCM_PixelIntensityRelationship,
                          DCM_PixelIntensityRelationshipSign,
                          DCM_RescaleIntercept,
                          DCM_RescaleSlope,
                          DCM_RescaleType,
                          DCM_PresentationLUTShape,
                          DCM_LossyImageCompression,
                          DCM_PatientOrientation,
                          DCM_BurnedInAnnotation,
                          DCM_ImagerPixelSpacing,
                          DCM_ImageLaterality,
                          DCM_WindowCenter,
                          DCM_WindowWidth,
                          DCM_PixelData})
    EXPECT_TRUE(format.getDataset()->tagExistsWithValue(tag)) << DcmTag(tag).getTagName();
  for (const auto& tag : {DCM_PatientName, DCM_PatientID, DCM_PatientBirthDate, DCM_PatientSex, DCM_StudyTime,
                          DCM_ReferringPhysicianName, DCM_StudyID, DCM_AccessionNumber, DCM_SeriesNumber,
                          DCM_InstanceNumber, DCM_Manufacturer, DCM_DetectorType, DCM_AnatomicRegionSequence,
                          DCM_AcquisitionContextSequence, DCM_PositionReferenceIndicator})
    EXPECT_TRUE(format.getDataset()->tagExists(tag)) << DcmTag(tag).getTagName();
}

TEST_F(Dicom, ImageOfUnknownSpacingBecomesASecondaryCapture) {
  Radiograph r = test::sampleRadiograph();
  r.spacing.reset();
  r.tags = {};
  writeDicom(r, file);
  const Radiograph back = readRadiograph(file);
  EXPECT_EQ(back.tags.modality, "OT");
  EXPECT_FALSE(back.spacing);
  EXPECT_THAT(codes(back), ElementsAre("pixel_spacing_missing"));
  EXPECT_THAT(back.tags.sop_instance_uid, testing::StartsWith("2.25."));
}

TEST_F(Dicom, LosslessCodingsGiveTheSamePixels) {
  DJEncoderRegistration::registerCodecs();
  DJLSEncoderRegistration::registerCodecs();
  DcmRLEEncoderRegistration::registerCodecs();
  const auto expected = *test::sampleRadiograph().pixels;
  const DJ_RPLossless jpeg;
  const DJLSRepresentationParameter jpeg_ls{2, OFTrue};
  const DcmRLERepresentationParameter rle;
  EXPECT_EQ(*changed({}, EXS_JPEGProcess14SV1, &jpeg).pixels, expected);
  EXPECT_EQ(*changed({}, EXS_JPEGLSLossless, &jpeg_ls).pixels, expected);
  EXPECT_EQ(*changed({}, EXS_RLELossless, &rle).pixels, expected);
  EXPECT_EQ(*changed({}, EXS_LittleEndianImplicit).pixels, expected);
  EXPECT_EQ(*changed({}, EXS_BigEndianExplicit).pixels, expected);
  EXPECT_THAT(changed({}, EXS_RLELossless, &rle).tags.transfer_syntax, HasSubstr("RLE"));
}

TEST_F(Dicom, SignedAndShiftedPixelsKeepTheirOrder) {
  const Radiograph r = changed([](DcmDataset& d) {
    const Uint16 raw[] = {0x8000, 0xfff0, 0x000f,
                          0x7ff0};  // 12 bits above 4 bits of something else: -2048, -1, 0, 2047
    d.putAndInsertUint16(DCM_Rows, 2);
    d.putAndInsertUint16(DCM_Columns, 2);
    d.putAndInsertUint16(DCM_HighBit, 15);
    d.putAndInsertUint16(DCM_PixelRepresentation, 1);
    d.putAndInsertString(DCM_WindowCenter, "0");
    d.putAndInsertString(DCM_WindowWidth, "400");
    d.putAndInsertUint16Array(DCM_PixelData, raw, 4);
  });
  EXPECT_THAT(*r.pixels, ElementsAre(0, 2047, 2048, 4095));
  EXPECT_EQ(r.window_center, 2048);
  EXPECT_EQ(r.window_width, 400);
}

TEST_F(Dicom, EightBitPixels) {
  const Radiograph r = changed([](DcmDataset& d) {
    const Uint8 raw[] = {0, 127, 128, 255};
    d.putAndInsertUint16(DCM_Rows, 2);
    d.putAndInsertUint16(DCM_Columns, 2);
    d.putAndInsertUint16(DCM_BitsAllocated, 8);
    d.putAndInsertUint16(DCM_BitsStored, 8);
    d.putAndInsertUint16(DCM_HighBit, 7);
    d.putAndInsertUint8Array(DCM_PixelData, raw, 4);
  });
  EXPECT_THAT(*r.pixels, ElementsAre(0, 127, 128, 255));
}

TEST_F(Dicom, WindowIsGivenInStoredValues) {
  const Radiograph r = changed([](DcmDataset& d) {
    d.putAndInsertString(DCM_RescaleSlope, "2");
    d.putAndInsertString(DCM_RescaleIntercept, "-1000");
    d.putAndInsertString(DCM_WindowCenter, "1000\\50");
    d.putAndInsertString(DCM_WindowWidth, "600\\20");
  });
  EXPECT_EQ(r.window_center, 1000);  // (1000 + 1000) / 2
  EXPECT_EQ(r.window_width, 300);
  EXPECT_FALSE(r.monochrome1);
  EXPECT_TRUE(changed([](DcmDataset& d) { d.putAndInsertString(DCM_RescaleSlope, "-1"); }).monochrome1);
}

TEST_F(Dicom, WindowFromATableOrFromThePixels) {
  const Radiograph table = changed([](DcmDataset& d) {
    d.findAndDeleteElement(DCM_WindowCenter);
    d.findAndDeleteElement(DCM_WindowWidth);
    DcmItem* item = nullptr;
    d.findOrCreateSequenceItem(DCM_VOILUTSequence, item, 0);
    std::vector<Uint16> lut(1001);
    for (std::size_t i = 0; i < lut.size(); ++i) lut[i] = Uint16(60 * i);
    const Uint16 descriptor[] = {1001, 500, 16};
    item->putAndInsertUint16Array(DCM_LUTDescriptor, descriptor, 3);
    item->putAndInsertUint16Array(DCM_LUTData, lut.data(), lut.size());
  });
  EXPECT_NEAR(table.window_center, 1000, 1);  // 500 .. 1500, its middle 90 %
  EXPECT_NEAR(table.window_width, 900, 2);

  const Radiograph none = changed([](DcmDataset& d) {
    d.findAndDeleteElement(DCM_WindowCenter);
    d.findAndDeleteElement(DCM_WindowWidth);
  });
  EXPECT_GT(none.window_width, 1000);
  EXPECT_LT(none.window_width, 4097);
}

TEST_F(Dicom, RefusesWhatIsNoSingleGreyRadiograph) {
  const auto set = [](const DcmTagKey& tag, const char* value) {
    return [tag, value](DcmDataset& d) { d.putAndInsertString(tag, value); };
  };
  const auto count = [](const DcmTagKey& tag, Uint16 value) {
    return [tag, value](DcmDataset& d) { d.putAndInsertUint16(tag, value); };
  };
  EXPECT_THAT(error(set(DCM_SOPClassUID, UID_CTImageStorage)), HasSubstr("modality: expected a radiograph"));
  EXPECT_THAT(error(set(DCM_NumberOfFrames, "12")), HasSubstr("frames: expected one image, found 12 frames"));
  EXPECT_THAT(error(set(DCM_PhotometricInterpretation, "RGB")), HasSubstr("grey values"));
  EXPECT_THAT(error(count(DCM_SamplesPerPixel, 3)), HasSubstr("3 samples a pixel"));
  EXPECT_THAT(error(count(DCM_Rows, 4700)), HasSubstr("truncated, or its size is wrong"));
  EXPECT_THAT(error(count(DCM_Rows, 60000)), HasSubstr("Rows: expected 1 to 20000, found 60000"));
  EXPECT_THAT(error(count(DCM_Columns, 0)), HasSubstr("Columns"));
  EXPECT_THAT(error(count(DCM_BitsAllocated, 12)), HasSubstr("Bits Allocated: expected 8 or 16"));
  EXPECT_THAT(error(count(DCM_BitsStored, 17)), HasSubstr("Bits Stored"));
  EXPECT_THAT(error(count(DCM_HighBit, 3)), HasSubstr("High Bit"));
  EXPECT_THAT(error([](DcmDataset& d) { d.findAndDeleteElement(DCM_PixelData); }), HasSubstr("pixel data"));
}

TEST_F(Dicom, ErrorsNameNoPatient) {
  for (const auto& tag : {DCM_Rows, DCM_Columns, DCM_PhotometricInterpretation, DCM_PixelData, DCM_SOPClassUID}) {
    const std::string message = error([&](DcmDataset& d) {
      d.findAndDeleteElement(tag);
      if (tag == DCM_SOPClassUID) d.putAndInsertString(DCM_Modality, "CT");
    });
    EXPECT_NE(message, "no error");
    EXPECT_THAT(message, testing::Not(testing::AnyOf(HasSubstr("ller"), HasSubstr("SYNTHETIC-7"))));
  }
}

TEST_F(Dicom, NamesInOtherCharacterSetsBecomeUtf8) {
  const auto nameIn = [&](const char* character_set, const char* bytes) {
    return changed([&](DcmDataset& d) {
             d.putAndInsertString(DCM_SpecificCharacterSet, character_set);
             d.putAndInsertString(DCM_PatientName, bytes);
           })
        .tags.patient_name;
  };
  EXPECT_EQ(nameIn("ISO_IR 100", "M\xfcller^J\xf6rg"), "M\xc3\xbcller^J\xc3\xb6rg");
  // The standard's Korean example (PS3.5, annex I): alphabetic = ideographic = phonetic.
  EXPECT_EQ(nameIn("\\ISO 2022 IR 149",
                   "Hong^Gildong=\x1b$)C\xfb\xf3^\x1b$)C\xd1\xce\xd4\xd7=\x1b$)C\xc8\xab^\x1b$)C\xb1\xe6\xb5\xbf"),
            "Hong^Gildong=\xe6\xb4\xaa^\xe5\x90\x89\xe6\xb4\x9e=\xed\x99\x8d^\xea\xb8\xb8\xeb\x8f\x99");
  // Undeclared bytes are not guessed.
  const Radiograph odd = changed([](DcmDataset& d) {
    d.findAndDeleteElement(DCM_SpecificCharacterSet);
    d.putAndInsertString(DCM_PatientName, "M\xfcller");
  });
  EXPECT_EQ(odd.tags.patient_name, "M?ller");
  EXPECT_THAT(codes(odd), testing::Contains("character_set"));
}

TEST(DisplayPixels, ShowDenseBoneBright) {
  Radiograph r;
  r.width_px = 3;
  r.height_px = 1;
  r.pixels = std::make_shared<const std::vector<std::uint16_t>>(std::vector<std::uint16_t>{0, 128, 255});
  // DICOM's linear window of centre 128, width 256: 0 -> 0, 255 -> 255.
  EXPECT_THAT(displayPixels(r, 128, 256, false), ElementsAre(0, 128, 255));
  EXPECT_THAT(displayPixels(r, 128, 256, true), ElementsAre(255, 127, 0));
  r.monochrome1 = true;
  EXPECT_THAT(displayPixels(r, 128, 256, false), ElementsAre(255, 127, 0));
  EXPECT_THAT(displayPixels(r, 128, 1, true), ElementsAre(0, 255, 255));  // width 1: a threshold
}

}  // namespace
}  // namespace sinew
