#include <dcmtk/dcmdata/dcspchrs.h>

#include <cmath>

#include "imaging/radiograph/dicom_internal.h"

namespace sinew::dicom {
namespace {

/// Text of the data set in UTF-8, whichever character sets it declares (PS3.5, 6.1).
class TextReader {
 public:
  TextReader(DcmDataset& dataset, Warnings& warnings) : dataset_{dataset}, warnings_{warnings} {
    OFString declared;
    dataset.findAndGetOFStringArray(DCM_SpecificCharacterSet, declared);
    known_ = converter_.selectCharacterSet(declared).good();
  }

  std::string utf8(const DcmTagKey& tag, const char* delimiters) {
    const std::string raw = text(dataset_, tag);
    bool ascii = true;
    for (char c : raw) ascii = ascii && static_cast<unsigned char>(c) < 128 && c != '\x1b';
    if (ascii) return raw;
    OFString converted;
    if (known_ && converter_.convertString(OFString{raw.c_str(), raw.size()}, converted, delimiters).good())
      return {converted.c_str(), converted.size()};
    if (!warned_)
      warnings_.push_back({"character_set",
                           "Text of the file is in a character set that it does not declare rightly; "
                           "unreadable letters are shown as '?'."});
    warned_ = true;
    std::string readable;
    for (char c : raw) readable += static_cast<unsigned char>(c) < 128 && c >= ' ' ? c : '?';
    return readable;
  }

 private:
  DcmDataset& dataset_;
  Warnings& warnings_;
  DcmSpecificCharacterSet converter_;
  bool known_ = false, warned_ = false;
};

std::optional<double> positiveNumber(DcmDataset& dataset, const DcmTagKey& tag) {
  const auto value = number(dataset, tag);
  return value && *value > 0 ? value : std::nullopt;  // zero stands for "not known" in many files
}

}  // namespace

RadiographTags readTags(DcmDataset& dataset, Warnings& warnings) {
  TextReader reader{dataset, warnings};
  RadiographTags tags;
  tags.modality = text(dataset, DCM_Modality);
  tags.sop_class_uid = text(dataset, DCM_SOPClassUID);
  tags.sop_instance_uid = text(dataset, DCM_SOPInstanceUID);
  tags.study_instance_uid = text(dataset, DCM_StudyInstanceUID);
  tags.frame_of_reference_uid = text(dataset, DCM_FrameOfReferenceUID);
  tags.patient_name = reader.utf8(DCM_PatientName, "\\^=");
  tags.patient_id = reader.utf8(DCM_PatientID, "\\");
  tags.patient_birth_date = text(dataset, DCM_PatientBirthDate);
  tags.patient_sex = text(dataset, DCM_PatientSex);
  tags.study_date = text(dataset, DCM_StudyDate);
  tags.view_position = text(dataset, DCM_ViewPosition);
  tags.image_laterality = text(dataset, DCM_ImageLaterality);
  if (tags.image_laterality.empty()) tags.image_laterality = text(dataset, DCM_Laterality);
  tags.manufacturer = reader.utf8(DCM_Manufacturer, "\\");
  const std::string along_row = text(dataset, DCM_PatientOrientation, 0);
  const std::string along_column = text(dataset, DCM_PatientOrientation, 1);
  if (!along_row.empty() || !along_column.empty()) tags.patient_orientation = along_row + "\\" + along_column;
  const auto imager_row = number(dataset, DCM_ImagerPixelSpacing, 0);
  const auto imager_column = number(dataset, DCM_ImagerPixelSpacing, 1);
  if (imager_row && imager_column && *imager_row > 0 && *imager_column > 0) {
    tags.imager_row_mm = imager_row;
    tags.imager_column_mm = imager_column;
  }
  tags.distance_source_to_detector_mm = positiveNumber(dataset, DCM_DistanceSourceToDetector);
  tags.distance_source_to_patient_mm = positiveNumber(dataset, DCM_DistanceSourceToPatient);
  tags.distance_source_to_isocenter_mm = positiveNumber(dataset, DCM_DistanceSourceToIsocenter);
  tags.estimated_magnification = positiveNumber(dataset, DCM_EstimatedRadiographicMagnificationFactor);
  tags.positioner_primary_angle_deg = number(dataset, DCM_PositionerPrimaryAngle);
  tags.positioner_secondary_angle_deg = number(dataset, DCM_PositionerSecondaryAngle);
  return tags;
}

std::optional<Window> readWindow(DcmDataset& dataset, const PixelFormat& format, Warnings& warnings) {
  const double slope = number(dataset, DCM_RescaleSlope).value_or(1);
  const double intercept = number(dataset, DCM_RescaleIntercept).value_or(0);
  const auto center = number(dataset, DCM_WindowCenter), width = number(dataset, DCM_WindowWidth);
  DcmItem* lut = nullptr;
  if (dataset.findAndGetSequenceItem(DCM_ModalityLUTSequence, lut, 0).good() && lut) {
    warnings.push_back({"modality_lut", "The file maps grey values by a table; its window is not used."});
    return std::nullopt;
  }
  if (slope == 0) {
    warnings.push_back({"rescale_slope_zero", "Rescale Slope is 0; the file's window is not used."});
    return std::nullopt;
  }
  const auto stored = [&](double value) { return (value - intercept) / slope + format.offset(); };
  if (center && width && *width >= 1) return Window{stored(*center), std::abs(*width / slope)};

  if (dataset.findAndGetSequenceItem(DCM_VOILUTSequence, lut, 0).bad() || !lut) return std::nullopt;
  // A table is shown by the window that spans the middle 90 % of its output.
  const Uint16* data = nullptr;
  unsigned long count = 0;
  const auto first = number(*lut, DCM_LUTDescriptor, 1);
  if (lut->findAndGetUint16Array(DCM_LUTData, data, &count).bad() || !data || count < 2 || !first)
    return std::nullopt;
  const auto crossing = [&](double fraction) {
    const double level = data[0] + fraction * (double(data[count - 1]) - data[0]);
    unsigned long i = 0;
    while (i + 1 < count && (data[count - 1] > data[0] ? data[i] < level : data[i] > level)) ++i;
    return *first + double(i);
  };
  const double low = crossing(0.05), high = crossing(0.95);
  if (!(high > low)) return std::nullopt;
  return Window{stored(0.5 * (low + high)), std::abs((high - low) / slope)};
}

}  // namespace sinew::dicom
