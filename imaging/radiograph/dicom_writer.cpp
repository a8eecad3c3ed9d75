#include <dcmtk/dcmdata/dcostrmb.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string_view>

#include "core/file.h"
#include "core/text.h"
#include "imaging/radiograph/dicom_internal.h"
#include "imaging/radiograph/radiograph.h"

namespace sinew {
namespace {

/// Decimal string of DICOM: the shortest of at most 16 characters that is nearest to the value.
std::string decimalString(double value) {
  std::string digits = fmt::format("{}", value);  // the fewest that read back as the same number
  for (int precision = 15; digits.size() > 16; --precision) digits = brief(value, precision);
  return digits;
}

/// Identifier that the same content always gets: 2.25 and 60 bits of its hash.
std::string uidOf(const std::string& content) {
  return "2.25." + std::to_string(std::stoull(sha256(content).substr(0, 15), nullptr, 16));
}

class Writer {
 public:
  explicit Writer(DcmDataset& dataset) : dataset_{dataset} {}
  void text(const DcmTagKey& tag, const std::string& value) {
    check(dataset_.putAndInsertString(tag, value.c_str()));
  }
  void number(const DcmTagKey& tag, std::optional<double> value) {
    if (value) text(tag, decimalString(*value));
  }
  void pair(const DcmTagKey& tag, double row, double column) {
    text(tag, decimalString(row) + "\\" + decimalString(column));
  }
  void count(const DcmTagKey& tag, int value) { check(dataset_.putAndInsertUint16(tag, Uint16(value))); }
  void single(const DcmTagKey& tag, std::optional<double> value) {
    if (value) check(dataset_.putAndInsertFloat32(tag, Float32(*value)));
  }
  void emptySequence(const DcmTagKey& tag) { check(dataset_.insertEmptyElement(tag)); }
  void pixels(const std::vector<std::uint16_t>& values) {
    check(dataset_.putAndInsertUint16Array(DCM_PixelData, values.data(), values.size()));
  }

 private:
  static void check(const OFCondition& condition) { require(condition.good(), condition.text()); }
  DcmDataset& dataset_;
};

void writeIdentity(Writer& w, const Radiograph& r, bool is_dx) {
  const RadiographTags& t = r.tags;
  const std::string_view bytes{reinterpret_cast<const char*>(r.pixels->data()), r.pixels->size() * 2};
  const std::string own = sha256(bytes) + t.study_instance_uid + t.view_position + t.patient_id;
  const std::string study = t.study_instance_uid.empty() ? uidOf("study" + own) : t.study_instance_uid;
  w.text(DCM_SpecificCharacterSet, "ISO_IR 192");
  w.text(DCM_SOPClassUID, is_dx ? UID_DigitalXRayImageStorageForPresentation : UID_SecondaryCaptureImageStorage);
  w.text(DCM_SOPInstanceUID, t.sop_instance_uid.empty() ? uidOf("instance" + own) : t.sop_instance_uid);
  w.text(DCM_StudyInstanceUID, study);
  w.text(DCM_SeriesInstanceUID, uidOf("series" + study + t.view_position));
  w.text(DCM_FrameOfReferenceUID, t.frame_of_reference_uid.empty() ? uidOf("frame" + own) : t.frame_of_reference_uid);
  w.text(DCM_PositionReferenceIndicator, "");
  w.text(DCM_Modality, is_dx ? "DX" : "OT");
  if (is_dx)
    w.text(DCM_PresentationIntentType, "FOR PRESENTATION");
  else
    w.text(DCM_ConversionType, "WSD");
  w.text(DCM_PatientName, t.patient_name);
  w.text(DCM_PatientID, t.patient_id);
  w.text(DCM_PatientBirthDate, t.patient_birth_date);
  w.text(DCM_PatientSex, t.patient_sex);
  w.text(DCM_StudyDate, t.study_date);
  for (const auto& tag :
       {DCM_StudyTime, DCM_ReferringPhysicianName, DCM_StudyID, DCM_AccessionNumber, DCM_SeriesNumber})
    w.text(tag, "");
  w.text(DCM_Manufacturer, t.manufacturer);
  w.text(DCM_InstanceNumber, "1");
}

void writeGeometry(Writer& w, const Radiograph& r) {
  const RadiographTags& t = r.tags;
  if (t.imager_row_mm && t.imager_column_mm) w.pair(DCM_ImagerPixelSpacing, *t.imager_row_mm, *t.imager_column_mm);
  if (r.spacing) {
    const PixelSpacing& s = *r.spacing;
    // What a person declared from a ball of known size is a fiducial in DICOM's words.
    const bool fiducial = s.source == PixelScaleSource::Fiducial || s.source == PixelScaleSource::Declared;
    if (fiducial || s.source == PixelScaleSource::Geometry) {
      w.pair(DCM_PixelSpacing, s.row_mm, s.column_mm);
      w.text(DCM_PixelSpacingCalibrationType, fiducial ? "FIDUCIAL" : "GEOMETRY");
      w.text(DCM_PixelSpacingCalibrationDescription, fiducial ? "object of known size" : "isocentre plane");
    } else if (s.source == PixelScaleSource::ImagerAtDetector && !t.imager_row_mm) {
      w.pair(DCM_ImagerPixelSpacing, s.row_mm, s.column_mm);
    }
  }
  w.number(DCM_DistanceSourceToDetector, t.distance_source_to_detector_mm);
  w.number(DCM_DistanceSourceToPatient, t.distance_source_to_patient_mm);
  w.single(DCM_DistanceSourceToIsocenter, t.distance_source_to_isocenter_mm);
  w.number(DCM_EstimatedRadiographicMagnificationFactor, t.estimated_magnification);
  w.text(DCM_PositionerType, t.positioner_primary_angle_deg ? "CARM" : "");
  w.number(DCM_PositionerPrimaryAngle, t.positioner_primary_angle_deg);
  w.number(DCM_PositionerSecondaryAngle, t.positioner_secondary_angle_deg);
  w.text(DCM_ViewPosition, t.view_position);
  w.text(DCM_ImageLaterality, t.image_laterality.empty() ? "U" : t.image_laterality);
  w.text(DCM_PatientOrientation, t.patient_orientation);
  w.text(DCM_DetectorType, "");
  w.emptySequence(DCM_AnatomicRegionSequence);
  w.emptySequence(DCM_AcquisitionContextSequence);
}

void writeImage(Writer& w, const Radiograph& r) {
  w.text(DCM_ImageType, "DERIVED\\PRIMARY\\");
  w.count(DCM_SamplesPerPixel, 1);
  w.text(DCM_PhotometricInterpretation, r.monochrome1 ? "MONOCHROME1" : "MONOCHROME2");
  w.count(DCM_Rows, r.height_px);
  w.count(DCM_Columns, r.width_px);
  w.count(DCM_BitsAllocated, 16);
  w.count(DCM_BitsStored, r.bits_stored);
  w.count(DCM_HighBit, r.bits_stored - 1);
  w.count(DCM_PixelRepresentation, 0);
  w.text(DCM_PixelIntensityRelationship, "LOG");
  w.text(DCM_PixelIntensityRelationshipSign, r.monochrome1 ? "-1" : "1");
  w.text(DCM_RescaleIntercept, "0");
  w.text(DCM_RescaleSlope, "1");
  w.text(DCM_RescaleType, "US");
  w.text(DCM_PresentationLUTShape, r.monochrome1 ? "INVERSE" : "IDENTITY");
  w.text(DCM_LossyImageCompression, "00");
  w.text(DCM_BurnedInAnnotation, "NO");
  w.number(DCM_WindowCenter, r.window_center);
  w.number(DCM_WindowWidth, std::max(r.window_width, 1.0));
  w.pixels(*r.pixels);
}

}  // namespace

void writeDicom(const Radiograph& radiograph, const std::filesystem::path& file) {
  require(radiograph.pixels &&
              radiograph.pixels->size() == std::size_t(radiograph.width_px) * std::size_t(radiograph.height_px),
          "one pixel value for every row and column");
  require(radiograph.bits_stored >= 8 && radiograph.bits_stored <= 16, "8 to 16 bits stored");
  dicom::setUp();
  DcmFileFormat format;
  Writer writer{*format.getDataset()};
  // A DX object must state the spacing of its detector; what is not known is not invented, and makes the image a
  // secondary capture.
  const bool detector_known =
      radiograph.tags.imager_row_mm ||
      (radiograph.spacing && radiograph.spacing->source == PixelScaleSource::ImagerAtDetector);
  writeIdentity(writer, radiograph, detector_known);
  writeGeometry(writer, radiograph);
  writeImage(writer, radiograph);

  format.validateMetaInfo(EXS_LittleEndianExplicit);
  std::string bytes(format.calcElementLength(EXS_LittleEndianExplicit, EET_ExplicitLength) + 4096, '\0');
  DcmOutputBufferStream stream{bytes.data(), offile_off_t(bytes.size())};
  format.transferInit();
  const OFCondition written = format.write(stream, EXS_LittleEndianExplicit, EET_ExplicitLength, nullptr);
  format.transferEnd();
  require(written.good(), written.text());
  writeFileAtomically(file, std::string_view{bytes.data(), std::size_t(stream.filled())});
}

}  // namespace sinew
