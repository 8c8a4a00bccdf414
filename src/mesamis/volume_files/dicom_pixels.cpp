// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/dicom_pixels.h"

#include <algorithm>
#include <array>

#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/dicom_jpeg.h"
#include "mesamis/volume_files/dicom_rle.h"
#include "mesamis/volume_files/gdcm_picture.h"
#include "mesamis/volume_files/rounding_record.h"

namespace mesamis::detail::volume_files {
namespace {

enum class Coding { kNative, kRle, kJpeg, kJpegLs, kJpeg2000 };

Coding coding_of(const DicomFile& file) {
  struct Known {
    const char* uid;
    Coding coding;
  };
  constexpr std::array<Known, 16> kKnown{{{"", Coding::kNative},
                                          {"1.2.840.10008.1.2", Coding::kNative},
                                          {"1.2.840.10008.1.2.1", Coding::kNative},
                                          {"1.2.840.10008.1.2.1.99", Coding::kNative},
                                          {"1.2.840.10008.1.2.2", Coding::kNative},
                                          {"1.2.840.10008.1.2.5", Coding::kRle},
                                          {"1.2.840.10008.1.2.4.50", Coding::kJpeg},
                                          {"1.2.840.10008.1.2.4.51", Coding::kJpeg},
                                          {"1.2.840.10008.1.2.4.53", Coding::kJpeg},
                                          {"1.2.840.10008.1.2.4.55", Coding::kJpeg},
                                          {"1.2.840.10008.1.2.4.57", Coding::kJpeg},
                                          {"1.2.840.10008.1.2.4.70", Coding::kJpeg},
                                          {"1.2.840.10008.1.2.4.80", Coding::kJpegLs},
                                          {"1.2.840.10008.1.2.4.81", Coding::kJpegLs},
                                          {"1.2.840.10008.1.2.4.90", Coding::kJpeg2000},
                                          {"1.2.840.10008.1.2.4.91", Coding::kJpeg2000}}};
  for (const Known& known : kKnown) {
    if (file.transfer_syntax == known.uid) return known.coding;
  }
  refuse(file.path,
         "expected pixels coded natively, as RLE, JPEG, JPEG-LS or JPEG 2000, found "
         "the transfer syntax " +
             in_quotes(file.transfer_syntax));
}

std::uint64_t frame_pixels(const DicomPixels& p) {
  return static_cast<std::uint64_t>(p.rows) * static_cast<std::uint64_t>(p.columns);
}

std::uint64_t frame_bytes(const DicomPixels& p) {
  return frame_pixels(p) * static_cast<std::uint64_t>(p.bits_allocated / 8);
}

/// Of all frames: those of single bits follow one another without a gap.
std::uint64_t all_bytes(const DicomPixels& p) {
  const auto bits = static_cast<std::uint64_t>(p.bits_allocated);
  return (frame_pixels(p) * static_cast<std::uint64_t>(p.frames) * bits + 7) / 8;
}

/// Checks the header of a compressed picture against the file's.
PictureHeader require_same_picture(const DicomFile& file, const DicomPixels& p, Bytes picture,
                                   Coding coding) {
  const bool jpeg2000 = coding == Coding::kJpeg2000;
  const auto header = jpeg2000 ? jpeg2000_header(picture) : jpeg_header(picture);
  if (!header) refuse(file.path, "the compressed pixels have no readable header");
  if (!has_end_marker(picture)) refuse(file.path, "the compressed pixels are cut off");
  if (header->columns != p.columns || header->rows != p.rows || header->components != 1 ||
      header->bits > p.bits_allocated) {
    refuse(file.path,
           message("expected compressed pixels of ", p.columns, " x ", p.rows, ", 1 x ",
                   p.bits_allocated, " bits, found ", header->columns, " x ", header->rows, ", ",
                   header->components, " x ", header->bits, " bits"));
  }
  return *header;
}

/// The fragments of one frame, joined. A fragment that begins a picture begins a frame.
std::vector<unsigned char> frame_capsule(const DicomFile& file, const DicomPixels& p, int frame,
                                         Coding coding) {
  const auto& fragments = file.elements.at(dicom::kPixelData).fragments;
  const bool one_each =
      coding == Coding::kRle || fragments.size() == static_cast<std::size_t>(p.frames);
  const auto begins = [one_each](Bytes b) {
    return one_each ||
           (b.size() > 3 && b[0] == 0xff && (b[1] == 0xd8 || b[1] == 0x4f) && b[2] == 0xff);
  };
  std::vector<unsigned char> capsule;
  int at = -1;
  for (const Bytes fragment : fragments) {
    if (at < 0 || (p.frames > 1 && begins(fragment))) ++at;
    if (at == frame) capsule.insert(capsule.end(), fragment.begin(), fragment.end());
  }
  if (capsule.empty()) refuse(file.path, message("frame ", frame, " has no pixel data"));
  return capsule;
}

/// Takes the stored bits of a word as a number with or without a sign.
struct WordReader {
  int bytes, shift, bits;
  bool big_endian, is_signed;

  double value(const unsigned char* at) const {
    std::uint32_t word = 0;
    for (int i = 0; i < bytes; ++i) {
      word |= std::uint32_t{at[big_endian ? bytes - 1 - i : i]} << 8 * i;
    }
    const std::uint32_t mask = bits == 32 ? 0xffffffffu : (1u << bits) - 1;
    word = word >> shift & mask;
    if (!is_signed || !(word >> (bits - 1) & 1)) return word;
    return static_cast<double>(word) - static_cast<double>(mask) - 1;
  }
};

void append_words(Bytes words, const WordReader& reader, const FrameRescale& rescale,
                  std::vector<float>& out) {
  const double slope = rescale.slope, intercept = rescale.intercept;
  const bool rounds = reader.bits <= 16 ? may_be_rounded<std::uint16_t>(slope, intercept)
                                        : may_be_rounded<std::uint32_t>(slope, intercept);
  RoundedSamples rounded;
  for (std::size_t at = 0; at < words.size(); at += static_cast<std::size_t>(reader.bytes)) {
    const double value = slope * reader.value(&words[at]) + intercept;
    out.push_back(static_cast<float>(value));
    if (rounds) rounded.note(value, out.back());
  }
  if (rounds) note_rounded(rounded);
}

void require_bits(const DicomFile& file, const DicomPixels& p, PixelUse use) {
  const bool packed = use == PixelUse::kLabels && p.bits_allocated == 1;
  if (packed && (coding_of(file) != Coding::kNative || file.big_endian)) {
    refuse(file.path, "expected single bits coded natively, little endian, found " +
                          in_quotes(file.transfer_syntax));
  }
  const bool whole =
      packed || p.bits_allocated == 8 || p.bits_allocated == 16 || p.bits_allocated == 32;
  if (!whole || p.bits_stored < 1 || p.bits_stored > p.bits_allocated ||
      p.high_bit < p.bits_stored - 1 || p.high_bit >= p.bits_allocated) {
    refuse(file.path, message("expected pixels of 8, 16 or 32 bits, found ", p.bits_allocated,
                              " bits allocated, ", p.bits_stored, " stored, high bit ", p.high_bit,
                              p.bits_allocated == 1 ? " (--labels reads segmentations)" : ""));
  }
}

/// Refuses, before anything is allocated, pixels that the bytes of the file cannot contain.
void require_pixel_bytes(const DicomFile& file, const DicomPixels& p) {
  const DicomElement& data = file.elements.at(dicom::kPixelData);
  const std::uint64_t needed = all_bytes(p);
  if (coding_of(file) == Coding::kNative) {
    if (data.value.size() >= needed) return;
    refuse(file.path, message("expected ", needed, " bytes of pixels (", p.columns, " x ", p.rows,
                              " x ", p.frames, "), found ", data.value.size()));
  }
  std::uint64_t packed = 0;
  for (const Bytes fragment : data.fragments) packed += fragment.size();
  // An empty picture in JPEG 2000 is compressed some thousands to one, a real one never.
  constexpr std::uint64_t kMostGrowth = 8192;
  if (needed > packed * kMostGrowth) {
    refuse(file.path, message("expected compressed pixels for ", needed, " bytes, found only ",
                              packed, " bytes"));
  }
}

/// Samples as words of `width` bytes, little endian.
std::vector<unsigned char> words_of(const std::vector<std::uint16_t>& samples, std::size_t width) {
  std::vector<unsigned char> words(samples.size() * width);
  for (std::size_t n = 0; n < samples.size(); ++n) {
    words[n * width] = static_cast<unsigned char>(samples[n] & 0xff);
    if (width > 1) words[n * width + 1] = static_cast<unsigned char>(samples[n] >> 8);
  }
  return words;
}

/// The words of one compressed frame, and whether they are intact.
struct Decoded {
  std::vector<unsigned char> words;
  bool intact = true;
  int bits = 0;  ///< coded precision; 0: that of the words
};

Decoded decode_frame(const DicomFile& file, const DicomPixels& p, int frame, Coding coding) {
  const auto capsule = frame_capsule(file, p, frame, coding);
  const auto width = static_cast<std::size_t>(p.bits_allocated / 8);
  if (coding == Coding::kRle) {
    return {decode_rle(file.path, capsule, frame_bytes(p) / width, width)};
  }
  const PictureHeader header = require_same_picture(file, p, capsule, coding);
  if (coding == Coding::kJpeg) {
    if (auto jpeg = decode_jpeg(capsule, header)) {
      return {words_of(jpeg->values, width), jpeg->intact, header.bits};
    }
  } else if (auto words = decode_by_gdcm(capsule, file.transfer_syntax, p)) {
    return {std::move(*words), true, header.bits};
  }
  refuse(file.path, "the compressed pixels are broken");
}

/// Single bits, the least significant of a byte first; a frame may begin within a byte.
void append_bits(Bytes all, const DicomPixels& p, const FrameRescale& rescale,
                 std::vector<float>& out) {
  const std::uint64_t count = frame_pixels(p);
  const std::uint64_t begin = count * static_cast<std::uint64_t>(rescale.frame);
  const auto off = static_cast<float>(rescale.intercept);
  const auto on = static_cast<float>(rescale.slope + rescale.intercept);
  for (std::uint64_t bit = begin; bit < begin + count; ++bit) {
    out.push_back(all[bit / 8] >> (bit % 8) & 1 ? on : off);
  }
}

}  // namespace

DicomPixels pixels_of(const DicomFile& file, PixelUse use) {
  const DicomSet& set = file.elements;
  if (!set.count(dicom::kPixelData)) {
    const bool real = set.count(dicom::kFloatPixelData) || set.count(dicom::kDoublePixelData);
    refuse(file.path, real ? "expected whole-numbered Pixel Data, found Float Pixel Data"
                           : "expected Pixel Data (7fe0,0010), found none");
  }
  const auto need = [&](DicomTag tag, const char* name) {
    const auto number = number_of(file, set, tag);
    if (!number) refuse(file.path, message("expected ", name, ", found none"));
    return *number;
  };
  const std::string photometric = text_of(set, dicom::kPhotometric);
  const bool indices = use == PixelUse::kLabels && photometric == "PALETTE COLOR";
  if (need(dicom::kSamplesPerPixel, "Samples per Pixel (0028,0002)") != 1 ||
      !(photometric.starts_with("MONOCHROME") || indices)) {
    refuse(file.path, "expected grey pixels, found " + in_quotes(photometric));
  }
  if (set.count(dicom::kModalityLut)) {
    refuse(file.path, "expected a linear rescale, found a Modality LUT (0028,3000)");
  }
  DicomPixels p;
  p.columns = need(dicom::kColumns, "Columns (0028,0011)");
  p.rows = need(dicom::kRows, "Rows (0028,0010)");
  const auto frames = decimals_of(set, dicom::kFrames, 1).value_or(std::vector<double>{1})[0];
  // A segmentation has a frame per segment and slice.
  const int most_frames = use == PixelUse::kLabels ? 1 << 24 : 65535;
  if (p.columns < 1 || p.rows < 1 || !(frames >= 1) || frames > most_frames) {
    refuse(file.path, message("expected a picture, found ", p.columns, " x ", p.rows, " pixels, ",
                              frames, " frames"));
  }
  p.frames = static_cast<int>(frames);
  p.bits_allocated = need(dicom::kBitsAllocated, "Bits Allocated (0028,0100)");
  p.bits_stored = number_of(file, set, dicom::kBitsStored).value_or(p.bits_allocated);
  p.high_bit = number_of(file, set, dicom::kHighBit).value_or(p.bits_stored - 1);
  p.is_signed = number_of(file, set, dicom::kPixelRepresentation).value_or(0) == 1;
  require_bits(file, p, use);
  require_pixel_bytes(file, p);
  return p;
}

std::uint64_t decoding_bytes(const DicomFile& file, const DicomPixels& p, int frame) {
  // Words, samples of 16 or 32 bits, and as much again within a decoder (the coefficients of a
  // progressive JPEG, the lines and the picture of JPEG 2000).
  constexpr std::uint64_t kPerPixel = 24, kMostStructure = std::uint64_t{1} << 40;
  const Coding coding = coding_of(file);
  if (coding == Coding::kNative) return 0;
  const auto capsule = frame_capsule(file, p, frame, coding);
  const std::uint64_t bytes = 2 * capsule.size() + kPerPixel * frame_pixels(p);
  if (coding != Coding::kRle) require_same_picture(file, p, capsule, coding);
  if (coding != Coding::kJpeg2000) return bytes;
  const std::uint64_t structure = jpeg2000_structure_bytes(capsule, frame_pixels(p));
  if (structure > kMostStructure) {
    refuse(file.path,
           "the compressed pixels state more tiles, layers, precincts or blocks than a "
           "picture needs, or none that can be followed");
  }
  return bytes + structure;
}

bool append_frame(const DicomFile& file, const DicomPixels& p, const FrameRescale& rescale,
                  std::vector<float>& out) {
  const Coding coding = coding_of(file);
  WordReader reader{p.bits_allocated / 8, p.high_bit + 1 - p.bits_stored, p.bits_stored,
                    file.big_endian, p.is_signed};
  if (coding == Coding::kNative) {
    const Bytes all = file.elements.at(dicom::kPixelData).value;
    if (p.bits_allocated == 1) return append_bits(all, p, rescale, out), true;
    const std::uint64_t size = frame_bytes(p);
    append_words(all.subspan(size * static_cast<std::uint64_t>(rescale.frame), size), reader,
                 rescale, out);
    return true;
  }
  const Decoded decoded = decode_frame(file, p, rescale.frame, coding);
  // Decoded samples begin at bit 0.
  if (decoded.bits > 0 && decoded.bits <= p.bits_stored) reader.shift = 0;
  append_words(decoded.words, reader, rescale, out);
  return decoded.intact;
}

}  // namespace mesamis::detail::volume_files
