// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/dicom_pixels.h"

#include <gmock/gmock.h>

#include "support/bytes_span.h"
#include "support/jpeg_bytes.h"
#include "support/scan_bytes.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kRle = "1.2.840.10008.1.2.5";
constexpr const char* kLosslessJpeg = "1.2.840.10008.1.2.4.70";

/// A file in memory of 2 x 1 pixels; fields are public so that tests may spoil them.
struct PixelFile {
  std::string syntax, samples = bytes_of(std::uint16_t{1}), photometric = "MONOCHROME2",
                      columns = bytes_of(std::uint16_t{2}), rows = bytes_of(std::uint16_t{1}),
                      allocated = bytes_of(std::uint16_t{16}), stored = bytes_of(std::uint16_t{16}),
                      sign = bytes_of(std::uint16_t{0});
  std::string frames, pixels;
  std::vector<std::string> fragments;

  /// Its elements point into this object.
  DicomFile file() const {
    DicomFile file;
    file.path = "a.dcm";
    file.transfer_syntax = syntax;
    const auto put = [&file](DicomTag tag, const std::string& value) {
      if (!value.empty()) file.elements[tag].value = bytes_in(value);
    };
    put(dicom::kSamplesPerPixel, samples), put(dicom::kPhotometric, photometric);
    put(dicom::kColumns, columns), put(dicom::kRows, rows), put(dicom::kFrames, frames);
    put(dicom::kBitsAllocated, allocated), put(dicom::kBitsStored, stored);
    put(dicom::kPixelRepresentation, sign);
    file.elements[dicom::kPixelData].value = bytes_in(pixels);
    for (const std::string& fragment : fragments) {
      file.elements[dicom::kPixelData].fragments.push_back(bytes_in(fragment));
    }
    return file;
  }
};

std::vector<float> values_of(const PixelFile& bytes, const FrameRescale& rescale = {}) {
  const DicomFile file = bytes.file();
  std::vector<float> out;
  EXPECT_TRUE(append_frame(file, pixels_of(file), rescale, out));
  return out;
}

TEST(DicomPixels, NativeValuesAreRescaled) {
  PixelFile bytes;
  bytes.pixels = bytes_of_all(std::vector<std::uint16_t>{0, 65535});
  EXPECT_THAT(values_of(bytes), ElementsAre(0, 65535));
  EXPECT_THAT(values_of(bytes, {0, 0.5, -1000}), ElementsAre(-1000, 31767.5F));
  bytes.sign = bytes_of(std::uint16_t{1});
  EXPECT_THAT(values_of(bytes), ElementsAre(0, -1));
}

TEST(DicomPixels, EachFrameHasItsOwnPixels) {
  PixelFile bytes;
  bytes.frames = "2";
  bytes.pixels = bytes_of_all(std::vector<std::uint16_t>{1, 2, 3, 4});
  EXPECT_THAT(values_of(bytes, {0}), ElementsAre(1, 2));
  EXPECT_THAT(values_of(bytes, {1}), ElementsAre(3, 4));
}

TEST(DicomPixels, RunLengthsAndLosslessJpegGiveTheSameValues) {
  const std::vector<std::uint16_t> samples{300, 4095};
  PixelFile plain, rle, jpeg;
  plain.pixels = bytes_of_all(samples);
  rle.syntax = kRle;
  rle.fragments = {bytes_of_all(std::vector<std::uint32_t>{2, 64, 67}) + std::string(52, '\0') +
                   std::string("\1\x01\x0f\1\x2c\xff", 6)};
  jpeg.syntax = kLosslessJpeg;
  for (const int bits : {12, 16}) {
    jpeg.fragments = {lossless_jpeg(bits, 2, samples)};
    EXPECT_EQ(values_of(jpeg), values_of(plain)) << bits;
  }
  EXPECT_EQ(values_of(rle), values_of(plain));
}

/// A picture of fewer bits than the words: its values are those of the lower bits.
TEST(DicomPixels, EightBitPicturesFillSixteenBitWords) {
  PixelFile bytes;
  bytes.syntax = kLosslessJpeg;
  bytes.fragments = {lossless_jpeg(8, 2, {7, 255})};
  EXPECT_THAT(values_of(bytes), ElementsAre(7, 255));
}

TEST(DicomPixels, CorruptJpegDataAreReported) {
  PixelFile bytes;
  bytes.syntax = kLosslessJpeg;
  std::string picture = lossless_jpeg(16, 2, {300, 4095});
  picture.erase(picture.size() - 5, 3);  // the end marker stays
  bytes.fragments = {picture};
  const DicomFile file = bytes.file();
  std::vector<float> out;
  EXPECT_FALSE(append_frame(file, pixels_of(file), {}, out));
  EXPECT_EQ(out.size(), 2u);
}

TEST(DicomPixels, RefusesWhatItCannotDecode) {
  const auto refused = [](auto&& change, const char* words) {
    PixelFile bytes;
    bytes.pixels = bytes_of_all(std::vector<std::uint16_t>{1, 2});
    change(bytes);
    EXPECT_REFUSED(values_of(bytes), HasSubstr(words));
  };
  refused([](PixelFile& f) { f.syntax = "1.2.840.10008.1.2.4.100"; }, "the transfer syntax");
  refused([](PixelFile& f) { f.samples = bytes_of(std::uint16_t{3}); }, "expected grey pixels");
  refused([](PixelFile& f) { f.photometric = "PALETTE COLOR"; }, "PALETTE");
  refused([](PixelFile& f) { f.rows.clear(); }, "expected Rows (0028,0010), found none");
  refused([](PixelFile& f) { f.rows = bytes_of(std::uint16_t{0}); }, "2 x 0 pixels");
  refused([](PixelFile& f) { f.allocated = bytes_of(std::uint16_t{12}); }, "12 bits allocated");
  refused([](PixelFile& f) { f.stored = bytes_of(std::uint16_t{17}); }, "17 stored");
  refused([](PixelFile& f) { f.pixels.pop_back(); }, "expected 4 bytes of pixels");
  refused([](PixelFile& f) { f.frames = "2"; }, "expected 8 bytes of pixels");
  refused([](PixelFile& f) { f.syntax = kRle; }, "found only 0 bytes");
}

TEST(DicomPixels, RefusesPicturesThatContradictTheFile) {
  PixelFile bytes;
  bytes.syntax = kLosslessJpeg;
  bytes.fragments = {lossless_jpeg(16, 1, {1, 2})};
  EXPECT_REFUSED(values_of(bytes), HasSubstr("expected compressed pixels of 2 x 1"));
  bytes.fragments = {lossless_jpeg(16, 2, {1, 2}).substr(0, 40)};
  EXPECT_REFUSED(values_of(bytes), HasSubstr("cut off"));
  bytes.fragments = {"no picture at all"};
  EXPECT_REFUSED(values_of(bytes), HasSubstr("no readable header"));
}

/// Frames of 3 x 1 bits follow one another without a gap: 1 0 1 | 1 1 0 | 0 1 0.
TEST(DicomPixels, SingleBitsAreReadForLabelsOnly) {
  PixelFile bytes;
  bytes.columns = bytes_of(std::uint16_t{3});
  bytes.allocated = bytes.stored = bytes_of(std::uint16_t{1});
  bytes.frames = "3";
  bytes.pixels = std::string("\x9d\x00", 2);
  const DicomFile file = bytes.file();
  EXPECT_REFUSED(pixels_of(file), HasSubstr("1 bits allocated"));
  const DicomPixels pixels = pixels_of(file, PixelUse::kLabels);
  std::vector<float> out;
  for (int frame = 0; frame < 3; ++frame) append_frame(file, pixels, {frame, 2, 1}, out);
  EXPECT_THAT(out, ElementsAre(3, 1, 3, 3, 3, 1, 1, 3, 1));
  bytes.pixels.resize(1);
  EXPECT_REFUSED(pixels_of(bytes.file(), PixelUse::kLabels), HasSubstr("expected 2 bytes"));
  bytes.pixels = "ab";
  bytes.syntax = kRle;
  EXPECT_REFUSED(pixels_of(bytes.file(), PixelUse::kLabels), HasSubstr("single bits coded"));
}

TEST(DicomPixels, IndicesOfAPaletteAreReadForLabelsOnly) {
  PixelFile bytes;
  bytes.photometric = "PALETTE COLOR";
  bytes.pixels = bytes_of_all(std::vector<std::uint16_t>{7, 300});
  const DicomFile file = bytes.file();
  EXPECT_REFUSED(pixels_of(file), HasSubstr("expected grey pixels"));
  std::vector<float> out;
  append_frame(file, pixels_of(file, PixelUse::kLabels), {}, out);
  EXPECT_THAT(out, ElementsAre(7, 300));
}

}  // namespace
}  // namespace mesamis
