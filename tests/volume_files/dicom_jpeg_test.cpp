// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/dicom_jpeg.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/bytes_span.h"
#include "support/jpeg_bytes.h"

namespace mesamis {
namespace {

/// Samples that use the whole range of a precision.
std::vector<std::uint16_t> samples_of(int bits, std::size_t count) {
  std::vector<std::uint16_t> samples(count);
  const unsigned largest = (1u << bits) - 1;
  for (std::size_t n = 0; n < count; ++n) {
    samples[n] = static_cast<std::uint16_t>((n * n * 977 + n) & largest);
  }
  samples[0] = 0;
  samples[1] = static_cast<std::uint16_t>(largest);
  return samples;
}

TEST(DicomJpeg, LosslessPicturesComeBackExactlyInEveryPrecision) {
  for (int bits = 2; bits <= 16; ++bits) {
    const auto samples = samples_of(bits, 35);
    const std::string picture = lossless_jpeg(bits, 7, samples);
    const auto header = jpeg_header(bytes_in(picture));
    ASSERT_TRUE(header) << bits;
    EXPECT_EQ(header->columns, 7);
    EXPECT_EQ(header->rows, 5);
    EXPECT_EQ(header->components, 1);
    EXPECT_EQ(header->bits, bits);
    const auto decoded = decode_jpeg(bytes_in(picture), *header);
    ASSERT_TRUE(decoded) << bits;
    EXPECT_TRUE(decoded->intact) << bits;
    EXPECT_EQ(decoded->values, samples) << bits;
  }
}

TEST(DicomJpeg, AFlatPictureOfTheCosineTransformIsFlat) {
  for (const auto& [bits, value] : {std::pair{8, 0}, {8, 200}, {8, 255}, {12, 1}, {12, 4095}}) {
    const std::string picture = flat_jpeg(bits, value);
    const auto decoded = decode_jpeg(bytes_in(picture), *jpeg_header(bytes_in(picture)));
    ASSERT_TRUE(decoded) << bits;
    EXPECT_TRUE(decoded->intact);
    EXPECT_EQ(decoded->values, std::vector<std::uint16_t>(64, static_cast<std::uint16_t>(value)));
  }
}

/// Whatever is cut off or changed: no crash, nothing printed, and no picture that claims to be
/// intact but lacks its end.
TEST(DicomJpeg, CutOffPicturesAreNotIntactAndNothingIsPrinted) {
  for (const int bits : {8, 12, 16}) {
    const std::string whole = lossless_jpeg(bits, 7, samples_of(bits, 35));
    const auto header = *jpeg_header(bytes_in(whole));
    testing::internal::CaptureStderr();
    for (std::size_t size = 0; size + 2 < whole.size(); ++size) {
      const auto decoded = decode_jpeg(bytes_in(whole).first(size), header);
      EXPECT_FALSE(decoded && decoded->intact) << bits << " bits, " << size << " bytes";
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  }
}

TEST(DicomJpeg, APictureOfAnotherSizeThanItsHeaderClaimedIsRefused) {
  const std::string picture = lossless_jpeg(12, 7, samples_of(12, 35));
  PictureHeader header = *jpeg_header(bytes_in(picture));
  header.rows = 4;
  EXPECT_FALSE(decode_jpeg(bytes_in(picture), header));
  header = *jpeg_header(bytes_in(picture));
  header.bits = 8;
  EXPECT_FALSE(decode_jpeg(bytes_in(picture), header)) << "another precision";
  header.components = 3;
  EXPECT_FALSE(decode_jpeg(bytes_in(picture), header));
}

TEST(DicomJpeg, WhatIsNoJpegHasNoHeader) {
  for (const std::string text : {"", "\xff", "\xff\xd8", "no picture at all, only text"}) {
    EXPECT_FALSE(jpeg_header(bytes_in(text)));
    EXPECT_FALSE(jpeg2000_header(bytes_in(text)));
    EXPECT_FALSE(has_end_marker(bytes_in(text)));
  }
}

TEST(DicomJpeg, ReadsTheHeaderOfAJpeg2000Codestream) {
  std::string siz = std::string("\xff\x4f\xff\x51\0\x29\0\0", 8);
  for (const int value : {300, 200, 44, 0, 300, 200, 0, 0}) {  // size, offset, tile, its offset
    siz += big16_bytes(0) + big16_bytes(value);
  }
  siz += big16_bytes(1) + std::string("\x8b\1\1", 3);  // one component, signed, 12 bits
  const auto header = jpeg2000_header(bytes_in(siz));
  ASSERT_TRUE(header);
  EXPECT_EQ(header->columns, 256);
  EXPECT_EQ(header->rows, 200);
  EXPECT_EQ(header->components, 1);
  EXPECT_EQ(header->bits, 12);
  EXPECT_FALSE(jpeg2000_header(bytes_in(siz).first(42)));
}

/// SIZ and COD of a picture of 256 x 256.
struct CodestreamBytes {
  int tile = 256, layers = 1, levels = 5, block = 4, precinct = -1;  // exponents; -1: the largest

  std::string bytes() const {
    std::string out = std::string("\xff\x4f\xff\x51\0\x29\0\0", 8);
    for (const int value : {256, 256, 0, 0, tile, tile, 0, 0})
      out += big16_bytes(0) + big16_bytes(value);
    out += big16_bytes(1) + std::string("\x0b\1\1", 3);
    const std::size_t sizes = precinct < 0 ? 0 : static_cast<std::size_t>(levels) + 1;
    out += "\xff\x52" + big16_bytes(12 + static_cast<int>(sizes));
    out += std::string(1, precinct < 0 ? '\0' : '\1') + std::string(1, '\0') + big16_bytes(layers) +
           '\0';
    out +=
        {static_cast<char>(levels), static_cast<char>(block), static_cast<char>(block), '\0', '\1'};
    out += std::string(sizes, static_cast<char>(precinct * 17));
    return out + "\xff\xd9";
  }
  std::uint64_t cost() const { return jpeg2000_structure_bytes(bytes_in(bytes()), 256 * 256); }
};

/// Headers of a hundred bytes of which OpenJPEG makes hundreds of megabytes.
TEST(DicomJpeg, WhatAJpeg2000HeaderClaimsOfStructureIsCounted) {
  EXPECT_LT(CodestreamBytes{}.cost(), 1'000'000u);
  EXPECT_LT((CodestreamBytes{.layers = 12, .precinct = 7}.cost()), 1'000'000u);
  EXPECT_GT((CodestreamBytes{.tile = 1}.cost()), 500'000'000u);
  EXPECT_GT((CodestreamBytes{.block = 0, .precinct = 0}.cost()), 60'000'000u);
  EXPECT_GT((CodestreamBytes{.layers = 65535, .precinct = 0}.cost()), 50'000'000'000u);
  constexpr auto kMost = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ((CodestreamBytes{.tile = 0}.cost()), kMost);
  EXPECT_EQ((CodestreamBytes{.levels = 33}.cost()), kMost);
  EXPECT_EQ(jpeg2000_structure_bytes({}, 1), kMost);
  const std::string bytes = CodestreamBytes{.precinct = 0}.bytes();
  for (std::size_t size = 44; size + 4 < bytes.size(); ++size) {
    EXPECT_EQ(jpeg2000_structure_bytes(bytes_in(bytes).first(size), 1), kMost) << size;
  }
}

TEST(DicomJpeg, TheEndMarkerMayBeFollowedByPadding) {
  EXPECT_TRUE(has_end_marker(bytes_in("data\xff\xd9")));
  const std::string padded = "data\xff\xd9" + std::string(16, '\0');
  EXPECT_TRUE(has_end_marker(bytes_in(padded)));
  const std::string far = "data\xff\xd9" + std::string(17, '\0');
  EXPECT_FALSE(has_end_marker(bytes_in(far)));
}

}  // namespace
}  // namespace mesamis
