#include <dcmtk/dcmdata/dcrledrg.h>
#include <dcmtk/dcmjpeg/djdecode.h>
#include <dcmtk/dcmjpls/djdecode.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "imaging/radiograph/dicom_internal.h"
#include "imaging/radiograph/pixel_spacing.h"
#include "imaging/radiograph/radiograph_internal.h"

namespace sinew {
namespace dicom {

void setUp() {
  static const bool once = [] {
    OFLog::configure(OFLogger::OFF_LOG_LEVEL);
    DJDecoderRegistration::registerCodecs();
    DJLSDecoderRegistration::registerCodecs();
    DcmRLEDecoderRegistration::registerCodecs();
    return true;
  }();
  (void)once;
}

void Source::fail(const std::string& field, const std::string& expected, const std::string& found) const {
  throw InputError{{file, field, expected, found}};
}

std::string text(DcmItem& dataset, const DcmTagKey& tag, unsigned long index) {
  OFString value;
  if (dataset.findAndGetOFString(tag, value, index).bad()) return {};
  std::string out{value.c_str(), value.size()};
  while (!out.empty() && (out.back() == ' ' || out.back() == '\0')) out.pop_back();
  const auto first = out.find_first_not_of(' ');
  return first == std::string::npos ? std::string{} : out.substr(first);
}

std::optional<double> number(DcmItem& dataset, const DcmTagKey& tag, unsigned long index) {
  Float32 single = 0;
  if (dataset.findAndGetFloat32(tag, single, index).good() && std::isfinite(single)) return double(single);
  const std::string digits = text(dataset, tag, index);
  char* end = nullptr;
  const double value = std::strtod(digits.c_str(), &end);
  return !digits.empty() && *end == '\0' && std::isfinite(value) ? std::optional{value} : std::nullopt;
}

}  // namespace dicom

namespace {

using dicom::Source;

void requireRadiograph(DcmDataset& dataset, const Source& source) {
  static const std::array kAccepted = {UID_ComputedRadiographyImageStorage,
                                       UID_DigitalXRayImageStorageForPresentation,
                                       UID_DigitalXRayImageStorageForProcessing,
                                       UID_DigitalMammographyXRayImageStorageForPresentation,
                                       UID_DigitalMammographyXRayImageStorageForProcessing,
                                       UID_XRayAngiographicImageStorage,
                                       UID_XRayRadiofluoroscopicImageStorage,
                                       UID_EnhancedXAImageStorage,
                                       UID_EnhancedXRFImageStorage,
                                       UID_SecondaryCaptureImageStorage,
                                       UID_MultiframeGrayscaleByteSecondaryCaptureImageStorage,
                                       UID_MultiframeGrayscaleWordSecondaryCaptureImageStorage};
  const std::string sop_class = dicom::text(dataset, DCM_SOPClassUID), modality = dicom::text(dataset, DCM_Modality);
  for (const char* uid : kAccepted)
    if (sop_class == uid) return;
  if (sop_class.empty())
    for (const char* name : {"CR", "DX", "RG", "XA", "RF", "MG", "OT"})
      if (modality == name) return;
  const char* name = dcmFindNameOfUID(sop_class.c_str());
  source.fail("modality", "a radiograph (CR, DX, XA, RF or secondary capture)",
              (modality.empty() ? "none" : modality) + (name ? std::string{", "} + name : ""));
}

std::optional<PixelSpacingFacts::Pair> pairOf(DcmDataset& dataset, const DcmTagKey& tag) {
  const auto row = dicom::number(dataset, tag, 0), column = dicom::number(dataset, tag, 1);
  if (!row && !column) return std::nullopt;
  return PixelSpacingFacts::Pair{row.value_or(0), column.value_or(0)};
}

std::optional<PixelSpacing> readSpacing(DcmDataset& dataset, const RadiographTags& tags,
                                        std::optional<double> declared, Warnings& warnings) {
  PixelSpacingFacts facts;
  facts.pixel_spacing = pairOf(dataset, DCM_PixelSpacing);
  facts.calibration_type = dicom::text(dataset, DCM_PixelSpacingCalibrationType);
  facts.imager_spacing = pairOf(dataset, DCM_ImagerPixelSpacing);
  facts.magnification = tags.estimated_magnification;
  facts.source_to_detector_mm = tags.distance_source_to_detector_mm;
  facts.source_to_patient_mm = tags.distance_source_to_patient_mm;
  facts.declared_mm = declared;
  return choosePixelSpacing(facts, warnings);
}

/// Low grey values are shown bright: by the photometric interpretation, by the presentation LUT's shape, or by a
/// rescale that turns the scale round.
bool lowIsBright(DcmDataset& dataset) {
  const bool inverse = dicom::text(dataset, DCM_PhotometricInterpretation) == "MONOCHROME1" ||
                       dicom::text(dataset, DCM_PresentationLUTShape) == "INVERSE";
  return inverse != (dicom::number(dataset, DCM_RescaleSlope).value_or(1) < 0);
}

}  // namespace

Radiograph readDicom(const std::filesystem::path& file, std::optional<double> declared_spacing_mm) {
  dicom::setUp();
  const Source source{file.string(), std::filesystem::file_size(file)};
  DcmFileFormat format;
  // Values above 4 kB stay in the file until asked for, so a claimed length allocates nothing here.
  const OFCondition loaded = format.loadFile(file.c_str(), EXS_Unknown, EGL_noChange, DCM_MaxReadLength);
  if (loaded.bad()) source.fail("", "a DICOM file", std::string{"a damaged one ("} + loaded.text() + ")");
  DcmDataset& dataset = *format.getDataset();
  requireRadiograph(dataset, source);
  const dicom::PixelFormat pixel_format = dicom::pixelFormat(dataset, source);

  Radiograph out;
  out.tags = dicom::readTags(dataset, out.warnings);
  out.tags.transfer_syntax = DcmXfer{dataset.getOriginalXfer()}.getXferName();
  out.width_px = pixel_format.columns;
  out.height_px = pixel_format.rows;
  out.bits_stored = pixel_format.bits_stored;
  out.monochrome1 = lowIsBright(dataset);
  out.spacing = readSpacing(dataset, out.tags, declared_spacing_mm, out.warnings);
  const auto window = dicom::readWindow(dataset, pixel_format, out.warnings);
  if (dicom::text(dataset, DCM_LossyImageCompression) == "01")
    out.warnings.push_back({"lossy_compressed", "The image was compressed with loss once."});
  if (dicom::text(dataset, DCM_BurnedInAnnotation) == "YES")
    out.warnings.push_back({"burned_in_annotation", "Text is burnt into the pixels; it may name the patient."});
  out.pixels = std::make_shared<const std::vector<std::uint16_t>>(dicom::decodePixels(dataset, pixel_format, source));
  if (window) {
    out.window_center = window->center;
    out.window_width = window->width;
  } else {
    setWindowFromPixels(out);
  }
  return out;
}

}  // namespace sinew
