// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/byte_source.h"

#include <gtest/gtest.h>

#include "support/scan_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis::detail {
namespace {

using testing::HasSubstr;

/// Bytes that do not repeat within any buffer.
std::string sample(std::size_t size) {
  std::string bytes(size, '\0');
  std::uint32_t state = 1;
  for (char& c : bytes) c = static_cast<char>((state = state * 1664525 + 1013904223) >> 24);
  return bytes;
}

std::string read(ByteSource& source, std::size_t n) {
  std::string bytes(n, '\0');
  bytes.resize(source.read(bytes.data(), n));
  return bytes;
}

TEST(ByteSource, GivesTheSameBytesPlainAndPacked) {
  const TempFolder folder;
  const std::string bytes = sample(200'000);  // several buffers
  write_bytes(folder / "plain", "head" + bytes);
  write_bytes(folder / "gzip", "head" + packed(bytes));
  write_bytes(folder / "zlib", "head" + packed(bytes, 15));
  for (const auto& [name, packing] : {std::pair{"plain", Packing::kPlain},
                                      {"plain", Packing::kSniffed},
                                      {"gzip", Packing::kDeflated},
                                      {"gzip", Packing::kSniffed},
                                      {"zlib", Packing::kDeflated}}) {
    ByteSource source(folder / name, packing, 4);
    EXPECT_EQ(read(source, 70'001), bytes.substr(0, 70'001)) << name;
    EXPECT_EQ(source.skip(9'999), 9'999u);
    EXPECT_EQ(read(source, 1'000'000), bytes.substr(80'000)) << name;
    EXPECT_EQ(source.read(nullptr, 0), 0u);
    EXPECT_EQ(source.skip(1), 0u);
    EXPECT_GE(source.most_bytes(), bytes.size());
  }
}

TEST(ByteSource, JoinedGzipFilesAreOneAndPaddingIsPassedOver) {
  const TempFolder folder;
  write_bytes(folder / "two", packed("first ") + packed("second") + std::string(100, '\0'));
  EXPECT_EQ(read_all(folder / "two"), "first second");
}

TEST(ByteSource, ReadAllGivesTheWholeFile) {
  const TempFolder folder;
  for (const std::size_t size : {0u, 1u, 1u << 22, (1u << 22) + 1}) {
    const std::string bytes = sample(size);
    write_bytes(folder / "a", bytes);
    EXPECT_TRUE(read_all(folder / "a") == bytes) << size;
  }
}

TEST(ByteSource, CutOffOrBrokenDataAreRefused) {
  const TempFolder folder;
  const std::string whole = packed(sample(100'000));
  write_bytes(folder / "cut", whole.substr(0, whole.size() / 2));
  EXPECT_REFUSED(read_all(folder / "cut"), HasSubstr("cut: the compressed data are cut off"));
  std::string damaged = whole;
  damaged[damaged.size() - 8] ^= 1;  // the check sum
  write_bytes(folder / "damaged", damaged);
  EXPECT_REFUSED(read_all(folder / "damaged"),
                 HasSubstr("damaged: the compressed data are broken"));
}

TEST(ByteSource, AFileThatIsMissingOrTooShortIsRefused) {
  const TempFolder folder;
  write_bytes(folder / "a", "12345");
  EXPECT_REFUSED(ByteSource(folder / "none", Packing::kPlain), HasSubstr("none: cannot be read"));
  EXPECT_REFUSED(ByteSource(folder.path(), Packing::kPlain), HasSubstr("cannot be read"));
  EXPECT_REFUSED(ByteSource(folder / "a", Packing::kPlain, 6),
                 HasSubstr("should begin at byte 6, but the file has 5"));
  EXPECT_NO_THROW(ByteSource(folder / "a", Packing::kPlain, 5));
}

/// 1032 bytes per byte: no reader allocates more than the packed file can hold.
TEST(ByteSource, MostBytesBoundsWhatAFileCanHold) {
  const TempFolder folder;
  const std::string zeros(5'000'000, '\0');
  write_bytes(folder / "a", packed(zeros));
  ByteSource source(folder / "a", Packing::kSniffed);
  EXPECT_GE(source.most_bytes(), zeros.size());
  EXPECT_EQ(source.most_bytes(), std::filesystem::file_size(folder / "a") * 1032);
}

}  // namespace
}  // namespace mesamis::detail
