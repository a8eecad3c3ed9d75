#pragma once
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <filesystem>
#include <optional>
#include <string>

#include "imaging/radiograph/radiograph.h"

namespace sinew::dicom {

// Steps of reading a DICOM file; included by the dicom_*.cpp files only.

/// Registers the decoders and silences DCMTK's log, which would print patient data. Once per process.
void setUp();

/// First value of an attribute without padding; empty if absent.
std::string text(DcmItem& dataset, const DcmTagKey& tag, unsigned long index = 0);
std::optional<double> number(DcmItem& dataset, const DcmTagKey& tag, unsigned long index = 0);

/// Where the messages begin: the file, never the patient.
struct Source {
  std::string file;
  std::uintmax_t bytes = 0;
  [[noreturn]] void fail(const std::string& field, const std::string& expected, const std::string& found) const;
};

/// How the stored pixels are to be read.
struct PixelFormat {
  int rows = 0, columns = 0, bits_allocated = 0, bits_stored = 0, high_bit = 0;
  bool is_signed = false;
  /// Added to signed data so that grey values are >= 0.
  int offset() const { return is_signed ? 1 << (bits_stored - 1) : 0; }
};

/// Checks everything that pixels depend on, sizes against the file before anything is allocated. @throws InputError.
PixelFormat pixelFormat(DcmDataset& dataset, const Source& source);
/// Decodes the one frame. @throws InputError.
std::vector<std::uint16_t> decodePixels(DcmDataset& dataset, const PixelFormat& format, const Source& source);

/// All tags but the pixels'; text becomes UTF-8.
RadiographTags readTags(DcmDataset& dataset, Warnings& warnings);

/// Display window in stored grey values (modality rescale undone, sign offset added), from the file's first window,
/// or from the span of a VOI LUT; nullopt if it has neither.
struct Window {
  double center = 0, width = 0;
};
std::optional<Window> readWindow(DcmDataset& dataset, const PixelFormat& format, Warnings& warnings);

/// JPEG 2000 code stream of one grey component -> row-major samples; nullopt unless its size and depth are as stated.
std::optional<std::vector<std::uint16_t>> decodeJpeg2000(const std::vector<std::uint8_t>& stream,
                                                         const PixelFormat& format);

}  // namespace sinew::dicom
