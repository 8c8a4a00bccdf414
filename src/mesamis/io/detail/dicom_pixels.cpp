// SPDX-License-Identifier: Apache-2.0
#include <gdcmImage.h>
#include <gdcmSequenceOfFragments.h>
#include <gdcmTrace.h>
#include <gdcmTransferSyntax.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <exception>

#include "mesamis/io/detail/dicom_slice.h"
#include "mesamis/io/detail/refuse.h"

namespace mesamis::detail {
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

std::uint64_t frame_bytes(const DicomPixels& p) {
  return static_cast<std::uint64_t>(p.rows) * static_cast<std::uint64_t>(p.columns) *
         static_cast<std::uint64_t>(p.bits_allocated / 8);
}

/// What a compressed picture says of itself, read before any decoder is let near it.
struct PictureHeader {
  int columns = 0, rows = 0, components = 0, bits = 0;
};

int big16(Bytes b, std::size_t at) { return b[at] << 8 | b[at + 1]; }

/// JPEG and JPEG-LS: the start-of-frame segment.
std::optional<PictureHeader> jpeg_header(Bytes b) {
  for (std::size_t at = 2; at + 10 <= b.size() && b[at] == 0xff;) {
    const int marker = b[at + 1];
    if (marker == 0xff) {  // fill byte
      ++at;
      continue;
    }
    const bool frame = marker == 0xf7 || (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 &&
                                          marker != 0xc8 && marker != 0xcc);
    if (frame) return PictureHeader{big16(b, at + 7), big16(b, at + 5), b[at + 9], b[at + 4]};
    at += 2 + static_cast<std::size_t>(big16(b, at + 2));
  }
  return std::nullopt;
}

/// JPEG 2000: the SIZ segment comes first in every codestream. Image and tile must agree.
std::optional<PictureHeader> jpeg2000_header(Bytes b) {
  if (b.size() < 43 || big16(b, 0) != 0xff4f || big16(b, 2) != 0xff51) return std::nullopt;
  const auto big32 = [b](std::size_t at) {
    return static_cast<std::int64_t>(big16(b, at)) << 16 | big16(b, at + 2);
  };
  const std::int64_t columns = big32(8) - big32(16), rows = big32(12) - big32(20);
  if (columns < 1 || rows < 1 || columns > 65535 || rows > 65535) return std::nullopt;
  return PictureHeader{static_cast<int>(columns), static_cast<int>(rows), big16(b, 40),
                       (b[42] & 0x7f) + 1};
}

/// Decoders fill up what is cut off without a word; the end marker (JPEG's EOI, JPEG 2000's EOC)
/// shows that it is all there. Padding may follow it.
bool has_end_marker(Bytes picture) {
  constexpr std::size_t kMostPadding = 16;
  const Bytes end = picture.last(std::min(picture.size(), kMostPadding + 2));
  constexpr std::array<unsigned char, 2> kMarker{0xff, 0xd9};
  return std::search(end.begin(), end.end(), kMarker.begin(), kMarker.end()) != end.end();
}

/// @return the precision the picture is coded with.
int require_same_picture(const DicomFile& file, const DicomPixels& p, Bytes picture,
                         Coding coding) {
  const bool jpeg2000 = coding == Coding::kJpeg2000;
  const auto header = jpeg2000 ? jpeg2000_header(picture) : jpeg_header(picture);
  if (!header) refuse(file.path, "the compressed pixels have no readable header");
  if (!has_end_marker(picture)) refuse(file.path, "the compressed pixels are cut off");
  if (header->columns != p.columns || header->rows != p.rows || header->components != 1 ||
      header->bits > p.bits_allocated) {
    refuse(file.path, say("expected compressed pixels of ", p.columns, " x ", p.rows, ", 1 x ",
                          p.bits_allocated, " bits, found ", header->columns, " x ", header->rows,
                          ", ", header->components, " x ", header->bits, " bits"));
  }
  return header->bits;
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
  if (capsule.empty()) refuse(file.path, say("frame ", frame, " has no pixel data"));
  return capsule;
}

/// One RLE segment (PackBits) fills `out`, whose bytes lie `stride` apart.
bool unpack_segment(Bytes in, unsigned char* out, std::size_t count, std::size_t stride) {
  std::size_t at = 0, done = 0;
  while (done < count && at < in.size()) {
    const int n = static_cast<signed char>(in[at++]);  // NOLINT(bugprone-signed-char-misuse)
    if (n == -128) continue;
    const auto run = static_cast<std::size_t>(n >= 0 ? n + 1 : 1 - n);
    const std::size_t stored = n >= 0 ? run : 1;
    if (run > count - done || stored > in.size() - at) return false;
    for (std::size_t i = 0; i < run; ++i) out[(done + i) * stride] = in[at + (n >= 0 ? i : 0)];
    at += stored;
    done += run;
  }
  return done == count;
}

/// PS3.5 annex G: one segment per byte of the pixel, the most significant first.
std::vector<unsigned char> decode_rle(const DicomFile& file, const DicomPixels& p, Bytes in) {
  const auto width = static_cast<std::size_t>(p.bits_allocated / 8);
  const auto little32 = [in](std::size_t at) {
    return std::size_t{in[at]} | std::size_t{in[at + 1]} << 8 | std::size_t{in[at + 2]} << 16 |
           std::size_t{in[at + 3]} << 24;
  };
  if (in.size() < 64 || little32(0) != width) {
    refuse(file.path, say("expected RLE pixels in ", width, " segments"));
  }
  std::vector<unsigned char> out(frame_bytes(p));
  for (std::size_t s = 0; s < width; ++s) {
    const std::size_t begin = little32(4 + 4 * s);
    const std::size_t end = s + 1 < width ? little32(8 + 4 * s) : in.size();
    if (begin < 64 || begin > end || end > in.size() ||
        !unpack_segment(in.subspan(begin, end - begin), out.data() + (width - 1 - s),
                        out.size() / width, width)) {
      refuse(file.path, say("the RLE pixels are broken in segment ", s));
    }
  }
  return out;
}

gdcm::PixelFormat gdcm_format(const DicomPixels& p) {
  const auto bits = [](int n) { return static_cast<unsigned short>(n); };
  return gdcm::PixelFormat(1, bits(p.bits_allocated), bits(p.bits_stored), bits(p.bits_stored - 1),
                           bits(p.is_signed));
}

/// GDCM's JPEG decoders print to C's stderr while they try out precisions and where data are
/// broken. For as long as this lives, that name stands for nowhere; the file descriptor and
/// std::cerr stay what they are.
class Silence {
 public:
  Silence() {
    gdcm::Trace::WarningOff();
    gdcm::Trace::ErrorOff();
    gdcm::Trace::DebugOff();
    static FILE* const nowhere = std::fopen("/dev/null", "w");
    if (nowhere) stderr = nowhere;
  }
  ~Silence() { stderr = before_; }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  FILE* before_ = stderr;
};

/// JPEG, JPEG-LS and JPEG 2000 through GDCM's decoders.
std::vector<unsigned char> decode_picture(const DicomFile& file, const DicomPixels& p,
                                          Bytes capsule) {
  gdcm::Fragment fragment;
  fragment.SetByteValue(reinterpret_cast<const char*>(capsule.data()),
                        static_cast<std::uint32_t>(capsule.size()));
  gdcm::SmartPointer<gdcm::SequenceOfFragments> fragments = new gdcm::SequenceOfFragments;
  fragments->AddFragment(fragment);
  gdcm::DataElement pixels(gdcm::Tag(0x7fe0, 0x0010));
  pixels.SetVR(gdcm::VR::OB);
  pixels.SetValue(*fragments);
  gdcm::Image image;
  image.SetNumberOfDimensions(2);
  image.SetDimension(0, static_cast<unsigned>(p.columns));
  image.SetDimension(1, static_cast<unsigned>(p.rows));
  image.SetPixelFormat(gdcm_format(p));
  image.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
  image.SetTransferSyntax(gdcm::TransferSyntax::GetTSType(file.transfer_syntax.c_str()));
  image.SetDataElement(pixels);
  std::vector<unsigned char> out(std::max<std::uint64_t>(image.GetBufferLength(), frame_bytes(p)));
  bool decoded = false;
  const Silence silence;
  try {
    decoded = image.GetBuffer(reinterpret_cast<char*>(out.data()));
  } catch (const std::exception&) {
    decoded = false;
  }
  if (!decoded || image.GetBufferLength() != frame_bytes(p)) {
    refuse(file.path, "the compressed pixels are broken");
  }
  return out;
}

/// Cuts the stored bits out of each word and applies the rescale.
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

void append_words(Bytes words, const WordReader& reader, const DicomSlice& slice,
                  std::vector<float>& out) {
  for (std::size_t at = 0; at < words.size(); at += static_cast<std::size_t>(reader.bytes)) {
    out.push_back(static_cast<float>(slice.slope * reader.value(&words[at]) + slice.intercept));
  }
}

void require_bits(const DicomFile& file, const DicomPixels& p) {
  const bool whole = p.bits_allocated == 8 || p.bits_allocated == 16 || p.bits_allocated == 32;
  if (!whole || p.bits_stored < 1 || p.bits_stored > p.bits_allocated ||
      p.high_bit < p.bits_stored - 1 || p.high_bit >= p.bits_allocated) {
    refuse(file.path, say("expected pixels of 8, 16 or 32 bits, found ", p.bits_allocated,
                          " bits allocated, ", p.bits_stored, " stored, high bit ", p.high_bit));
  }
}

/// Before anything is allocated: can the bytes that are there make so many pixels?
void require_pixel_bytes(const DicomFile& file, const DicomPixels& p) {
  const DicomElement& data = file.elements.at(dicom::kPixelData);
  const std::uint64_t needed = frame_bytes(p) * static_cast<std::uint64_t>(p.frames);
  if (coding_of(file) == Coding::kNative) {
    if (data.value.size() >= needed) return;
    refuse(file.path, say("expected ", needed, " bytes of pixels (", p.columns, " x ", p.rows,
                          " x ", p.frames, "), found ", data.value.size()));
  }
  std::uint64_t packed = 0;
  for (const Bytes fragment : data.fragments) packed += fragment.size();
  // An empty picture in JPEG 2000 packs some thousands to one; a real one never does.
  constexpr std::uint64_t kMostGrowth = 8192;
  if (needed > packed * kMostGrowth) {
    refuse(file.path,
           say("expected compressed pixels for ", needed, " bytes, found only ", packed, " bytes"));
  }
}

}  // namespace

DicomPixels pixels_of(const DicomFile& file) {
  const DicomSet& set = file.elements;
  if (!set.count(dicom::kPixelData)) {
    const bool real = set.count(dicom::kFloatPixelData) || set.count(dicom::kDoublePixelData);
    refuse(file.path, real ? "expected whole-numbered Pixel Data, found Float Pixel Data"
                           : "expected Pixel Data (7fe0,0010), found none");
  }
  const auto need = [&](DicomTag tag, const char* name) {
    const auto number = number_of(file, set, tag);
    if (!number) refuse(file.path, say("expected ", name, ", found none"));
    return *number;
  };
  const std::string photometric = text_of(set, dicom::kPhotometric);
  if (need(dicom::kSamplesPerPixel, "Samples per Pixel (0028,0002)") != 1 ||
      !photometric.starts_with("MONOCHROME")) {
    refuse(file.path, "expected grey pixels, found " + in_quotes(photometric));
  }
  if (set.count(dicom::kModalityLut)) {
    refuse(file.path, "expected a linear rescale, found a Modality LUT (0028,3000)");
  }
  DicomPixels p;
  p.columns = need(dicom::kColumns, "Columns (0028,0011)");
  p.rows = need(dicom::kRows, "Rows (0028,0010)");
  const auto frames = decimals_of(set, dicom::kFrames, 1).value_or(std::vector<double>{1})[0];
  if (p.columns < 1 || p.rows < 1 || !(frames >= 1) || frames > 65535) {
    refuse(file.path, say("expected a picture, found ", p.columns, " x ", p.rows, " pixels, ",
                          frames, " frames"));
  }
  p.frames = static_cast<int>(frames);
  p.bits_allocated = need(dicom::kBitsAllocated, "Bits Allocated (0028,0100)");
  p.bits_stored = number_of(file, set, dicom::kBitsStored).value_or(p.bits_allocated);
  p.high_bit = number_of(file, set, dicom::kHighBit).value_or(p.bits_stored - 1);
  p.is_signed = number_of(file, set, dicom::kPixelRepresentation).value_or(0) == 1;
  require_bits(file, p);
  require_pixel_bytes(file, p);
  return p;
}

void append_frame(const DicomFile& file, const DicomPixels& p, const DicomSlice& slice,
                  std::vector<float>& out) {
  const Coding coding = coding_of(file);
  WordReader reader{p.bits_allocated / 8, p.high_bit + 1 - p.bits_stored, p.bits_stored,
                    file.big_endian, p.is_signed};
  if (coding == Coding::kNative) {
    const Bytes all = file.elements.at(dicom::kPixelData).value;
    const std::uint64_t size = frame_bytes(p);
    append_words(all.subspan(size * static_cast<std::uint64_t>(slice.frame), size), reader, slice,
                 out);
    return;
  }
  const auto capsule = frame_capsule(file, p, slice.frame, coding);
  if (coding == Coding::kRle) {
    append_words(decode_rle(file, p, capsule), reader, slice, out);
    return;
  }
  // Decoders give the coded precision from bit 0 up.
  if (require_same_picture(file, p, capsule, coding) <= p.bits_stored) reader.shift = 0;
  append_words(decode_picture(file, p, capsule), reader, slice, out);
}

}  // namespace mesamis::detail
