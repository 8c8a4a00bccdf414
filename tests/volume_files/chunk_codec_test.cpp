// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/chunk_codec.h"

#include <gtest/gtest.h>

#include "support/throws.h"
#include "volume_files/chunk_bytes.h"

namespace mesamis {
namespace {

using Kind = ChunkCodec::Kind;
using testing::HasSubstr;

const std::string kBytes = bytes_of_all(ramp<std::int16_t>(1000));

std::string unpack(const std::string& packed, const std::vector<ChunkCodec>& codecs,
                   std::size_t size = kBytes.size()) {
  return unpack_chunk("chunk", packed, codecs, size);
}

std::string packed_as(Kind kind) {
  switch (kind) {
    case Kind::kDeflate:
      return packed(kBytes, 15);
    case Kind::kBlosc:
      return with_blosc(kBytes);
    default:
      return with_zstd(kBytes);
  }
}

TEST(ChunkCodec, GivesBackWhatWasPacked) {
  for (const Kind kind : {Kind::kDeflate, Kind::kBlosc, Kind::kZstd}) {
    EXPECT_EQ(unpack(packed_as(kind), {{kind}}), kBytes);
  }
  EXPECT_EQ(unpack(packed(kBytes, 31), {{Kind::kDeflate}}), kBytes);
  EXPECT_EQ(unpack(kBytes, {}), kBytes);
  for (const char* inner : {"blosclz", "lz4", "lz4hc", "zlib", "zstd"}) {
    EXPECT_EQ(unpack(with_blosc(kBytes, inner, 2, BLOSC_BITSHUFFLE), {{Kind::kBlosc}}), kBytes);
  }
}

TEST(ChunkCodec, RefusesAnyOtherLength) {
  for (const Kind kind : {Kind::kDeflate, Kind::kBlosc, Kind::kZstd}) {
    for (const std::size_t size : {kBytes.size() - 1, kBytes.size() + 1, std::size_t{0}}) {
      EXPECT_REFUSED(unpack(packed_as(kind), {{kind}}, size), HasSubstr("expected a chunk of"));
    }
  }
  EXPECT_REFUSED(unpack(kBytes, {}, 7), HasSubstr("expected a chunk of 7 bytes, found 2000"));
}

TEST(ChunkCodec, RefusesWhatIsCutOffOrNotPacked) {
  for (const Kind kind : {Kind::kDeflate, Kind::kBlosc, Kind::kZstd}) {
    const std::string whole = packed_as(kind);
    for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 50) {
      EXPECT_REFUSED(unpack(whole.substr(0, size), {{kind}}), HasSubstr("expected a chunk"));
    }
    EXPECT_REFUSED(unpack(kBytes, {{kind}}), HasSubstr("expected a chunk"));
  }
}

TEST(ChunkCodec, SurvivesEveryChangedByte) {
  for (const Kind kind : {Kind::kDeflate, Kind::kBlosc, Kind::kZstd}) {
    const std::string whole = packed_as(kind);
    for (std::size_t n = 0; n < whole.size(); ++n) {
      std::string broken = whole;
      broken[n] = static_cast<char>(~broken[n]);
      try {
        EXPECT_EQ(unpack(broken, {{kind}}).size(), kBytes.size());
      } catch (const InputError&) {
      }
    }
  }
}

TEST(ChunkCodec, UnshufflesWholeElements) {
  EXPECT_EQ(unpack("acebdf", {{Kind::kShuffle, 2}}, 6), "abcdef");
  EXPECT_EQ(unpack("acebdfX", {{Kind::kShuffle, 2}}, 7), "abcdefX");
  EXPECT_EQ(unpack("abc", {{Kind::kShuffle, 0}}, 3), "abc");
  EXPECT_EQ(unpack("abc", {{Kind::kShuffle, 8}}, 3), "abc");
  EXPECT_EQ(unpack("abc", {{Kind::kShuffle, ~std::size_t{0}}}, 3), "abc");
}

TEST(ChunkCodec, ChecksTheSumOfCastagnoli) {
  // The check value of CRC-32C: that of the digits 1 to 9.
  const std::string digits = "123456789";
  const std::string sum = bytes_of(std::uint32_t{0xe3069283});
  EXPECT_EQ(unpack(digits + sum, {{Kind::kCrc32c}}, 9), digits);
  EXPECT_REFUSED(unpack("123456780" + sum, {{Kind::kCrc32c}}, 9), HasSubstr("checksum"));
  EXPECT_REFUSED(unpack("123", {{Kind::kCrc32c}}, 9), HasSubstr("cut off"));
  EXPECT_EQ(unpack(packed(digits + sum), {{Kind::kCrc32c}, {Kind::kDeflate}}, 9), digits);
}

TEST(ChunkCodec, AllowsOneCompressionAndSumsAfterIt) {
  EXPECT_NO_THROW(require_chain("f", {}));
  EXPECT_NO_THROW(require_chain("f", {{Kind::kShuffle, 2}, {Kind::kZstd}, {Kind::kCrc32c}}));
  EXPECT_REFUSED(require_chain("f", {{Kind::kDeflate}, {Kind::kZstd}}), HasSubstr("once"));
  EXPECT_REFUSED(require_chain("f", {{Kind::kDeflate}, {Kind::kShuffle, 2}}), HasSubstr("once"));
}

}  // namespace
}  // namespace mesamis
