#include <dcmtk/dcmdata/dcpixel.h>
#include <dcmtk/dcmdata/dcpixseq.h>
#include <dcmtk/dcmdata/dcpxitem.h>

#include "imaging/radiograph/dicom_internal.h"
#include "imaging/radiograph/radiograph_internal.h"

namespace sinew::dicom {
namespace {

/// No lossless coder of radiographs packs better; a claim beyond it is an attack or damage.
constexpr std::uint64_t kMaxCompression = 1000;

int unsignedTag(DcmDataset& dataset, const DcmTagKey& tag, const char* name, const Source& source, int low,
                int high) {
  Uint16 value = 0;
  const std::string expected = std::to_string(low) + " to " + std::to_string(high);
  if (dataset.findAndGetUint16(tag, value).bad()) source.fail(name, expected, "nothing");
  if (value < low || value > high) source.fail(name, expected, std::to_string(value));
  return value;
}

bool isJpeg2000(E_TransferSyntax syntax) {
  return syntax == EXS_JPEG2000LosslessOnly || syntax == EXS_JPEG2000;
}

DcmPixelSequence* encapsulated(DcmDataset& dataset) {
  DcmElement* element = nullptr;
  if (dataset.findAndGetElement(DCM_PixelData, element).bad() || !element) return nullptr;
  auto* data = dynamic_cast<DcmPixelData*>(element);
  if (!data) return nullptr;
  E_TransferSyntax syntax = EXS_Unknown;
  const DcmRepresentationParameter* parameter = nullptr;
  DcmPixelSequence* sequence = nullptr;
  data->getOriginalRepresentationKey(syntax, parameter);
  return data->getEncapsulatedRepresentation(syntax, parameter, sequence).good() ? sequence : nullptr;
}

/// All fragments of the one frame, joined; the first item is the offset table.
std::vector<std::uint8_t> codeStream(DcmDataset& dataset, const Source& source) {
  std::vector<std::uint8_t> stream;
  DcmPixelSequence* sequence = encapsulated(dataset);
  for (unsigned long i = 1; sequence && i < sequence->card(); ++i) {
    DcmPixelItem* item = nullptr;
    Uint8* bytes = nullptr;
    if (sequence->getItem(item, i).bad() || !item || item->getLength() > source.bytes ||
        stream.size() + item->getLength() > source.bytes || item->getUint8Array(bytes).bad() || !bytes)
      source.fail("pixel data", "a whole image", "a damaged one");
    stream.insert(stream.end(), bytes, bytes + item->getLength());
  }
  return stream;
}

void requireOneGreyFrame(DcmDataset& dataset, const Source& source) {
  const std::string photometric = text(dataset, DCM_PhotometricInterpretation);
  Uint16 samples = 1;
  dataset.findAndGetUint16(DCM_SamplesPerPixel, samples);
  if (samples != 1 || (photometric != "MONOCHROME1" && photometric != "MONOCHROME2"))
    source.fail("pixels", "grey values (MONOCHROME1 or MONOCHROME2)",
                (photometric.empty() ? "no photometric interpretation" : photometric) + ", " +
                    std::to_string(samples) + " samples a pixel");
  const double frames = number(dataset, DCM_NumberOfFrames).value_or(1);
  if (frames != 1) source.fail("frames", "one image", std::to_string(long(frames)) + " frames");
}

void requireBytes(DcmDataset& dataset, const PixelFormat& f, const Source& source) {
  const std::uint64_t pixels = std::uint64_t(f.rows) * std::uint64_t(f.columns);
  const std::string size = std::to_string(f.columns) + " x " + std::to_string(f.rows) + " pixels";
  if (pixels > kMaxPixels) source.fail("size", "up to " + std::to_string(kMaxPixels) + " pixels", size);
  DcmElement* element = nullptr;
  if (dataset.findAndGetElement(DCM_PixelData, element).bad() || !element)
    source.fail("pixel data", "an image", "none");
  const std::uint64_t bytes = pixels * std::uint64_t(f.bits_allocated / 8);
  const bool compressed = DcmXfer{dataset.getOriginalXfer()}.isEncapsulated();
  if (compressed ? bytes > kMaxCompression * source.bytes : bytes > source.bytes || element->getLengthField() < bytes)
    source.fail("pixel data", size, "fewer bytes: truncated, or its size is wrong");
}

template <class Raw>
std::vector<std::uint16_t> unpacked(const Raw* raw, std::size_t count, const PixelFormat& f) {
  const int shift = f.high_bit - f.bits_stored + 1;
  const std::uint32_t mask = (1u << f.bits_stored) - 1, sign = f.is_signed ? 1u << (f.bits_stored - 1) : 0;
  std::vector<std::uint16_t> out(count);
  // Two's complement plus half the range is the sign bit flipped.
  for (std::size_t i = 0; i < count; ++i) out[i] = std::uint16_t(((std::uint32_t{raw[i]} >> shift) & mask) ^ sign);
  return out;
}

}  // namespace

PixelFormat pixelFormat(DcmDataset& dataset, const Source& source) {
  requireOneGreyFrame(dataset, source);
  PixelFormat f;
  f.rows = unsignedTag(dataset, DCM_Rows, "Rows", source, 1, kMaxImageSide_px);
  f.columns = unsignedTag(dataset, DCM_Columns, "Columns", source, 1, kMaxImageSide_px);
  f.bits_allocated = unsignedTag(dataset, DCM_BitsAllocated, "Bits Allocated", source, 8, 16);
  if (f.bits_allocated != 8 && f.bits_allocated != 16)
    source.fail("Bits Allocated", "8 or 16", std::to_string(f.bits_allocated));
  f.bits_stored = unsignedTag(dataset, DCM_BitsStored, "Bits Stored", source, 8, f.bits_allocated);
  f.high_bit = unsignedTag(dataset, DCM_HighBit, "High Bit", source, f.bits_stored - 1, f.bits_allocated - 1);
  f.is_signed = unsignedTag(dataset, DCM_PixelRepresentation, "Pixel Representation", source, 0, 1) == 1;
  requireBytes(dataset, f, source);
  return f;
}

std::vector<std::uint16_t> decodePixels(DcmDataset& dataset, const PixelFormat& f, const Source& source) {
  const std::size_t count = std::size_t(f.rows) * std::size_t(f.columns);
  const E_TransferSyntax syntax = dataset.getOriginalXfer();
  const std::string name = DcmXfer{syntax}.getXferName();
  if (isJpeg2000(syntax)) {
    const auto samples = decodeJpeg2000(codeStream(dataset, source), f);
    if (!samples)
      source.fail("pixel data", "a whole " + name + " image of the stated size", "another or a damaged one");
    return unpacked(samples->data(), count, {f.rows, f.columns, 16, f.bits_stored, f.bits_stored - 1, f.is_signed});
  }
  const OFCondition decoded = dataset.chooseRepresentation(EXS_LittleEndianExplicit, nullptr);
  if (decoded.bad())
    source.fail("pixel data", "a readable image", "a damaged one, or a coding that is not supported (" + name + ")");
  unsigned long available = 0;
  if (f.bits_allocated == 8) {
    const Uint8* raw = nullptr;
    if (dataset.findAndGetUint8Array(DCM_PixelData, raw, &available).good() && raw && available >= count)
      return unpacked(raw, count, f);
  } else {
    const Uint16* raw = nullptr;
    if (dataset.findAndGetUint16Array(DCM_PixelData, raw, &available).good() && raw && available >= count)
      return unpacked(raw, count, f);
  }
  source.fail("pixel data", std::to_string(count) + " pixels", "fewer: truncated or damaged");
}

}  // namespace sinew::dicom
