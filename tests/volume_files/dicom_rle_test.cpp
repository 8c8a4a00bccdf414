// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/dicom_rle.h"

#include <gmock/gmock.h>

#include "support/bytes_span.h"
#include "support/scan_bytes.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// The header of 64 bytes and the segments behind it.
std::string rle(const std::vector<std::string>& segments) {
  std::string header = bytes_of(static_cast<std::uint32_t>(segments.size())), data;
  for (const std::string& segment : segments) {
    header += bytes_of(static_cast<std::uint32_t>(64 + data.size()));
    data += segment;
  }
  header.resize(64, '\0');
  return header + data;
}

std::vector<unsigned char> decode(const std::string& packed, std::size_t pixels,
                                  std::size_t width) {
  return decode_rle("a.dcm", bytes_in(packed), pixels, width);
}

TEST(DicomRle, UnpacksLiteralsAndRuns) {
  // Three bytes as they are; byte 9 four times; a byte to be skipped; one byte.
  const std::string segment("\2\1\2\3\xfd\x09\x80\0\7", 9);
  EXPECT_THAT(decode(rle({segment}), 8, 1), ElementsAre(1, 2, 3, 9, 9, 9, 9, 7));
}

TEST(DicomRle, TheMostSignificantByteComesFirst) {
  const std::string high("\1\x12\x34", 3), low("\1\x56\x78", 3);
  EXPECT_THAT(decode(rle({high, low}), 2, 2), ElementsAre(0x56, 0x12, 0x78, 0x34));
}

TEST(DicomRle, RefusesSegmentsThatEndEarlyOrRunOver) {
  const std::string two("\1\1\2", 3);
  EXPECT_REFUSED(decode(rle({two}), 3, 1),
                 HasSubstr("a.dcm: the RLE pixels are broken in segment 0"));
  EXPECT_REFUSED(decode(rle({two}), 1, 1), HasSubstr("segment 0"));
  EXPECT_REFUSED(decode(rle({two, "\1"}), 2, 2), HasSubstr("segment 1"));
  EXPECT_REFUSED(decode(rle({two}), 2, 2), HasSubstr("expected RLE pixels in 2 segments"));
  EXPECT_REFUSED(decode("", 2, 1), HasSubstr("segments"));
  std::string wild = rle({two});
  wild.replace(4, 4, bytes_of(std::uint32_t{0xfffffff0}));
  EXPECT_REFUSED(decode(wild, 2, 1), HasSubstr("segment 0"));
}

}  // namespace
}  // namespace mesamis
