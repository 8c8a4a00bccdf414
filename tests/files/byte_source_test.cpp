// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/byte_source.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdint>
#include <filesystem>
#include <limits>

#include "support/scan_bytes.h"
#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
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

std::string read_whole(const std::filesystem::path& file, double memory_gb = 1,
                       MostBytes most = nullptr) {
  MemoryBudget budget(file, {memory_gb});
  return read_all(file, budget, most);
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

TEST(ByteSource, SkipsPlainBytesWithoutReadingThem) {
  const TempFolder folder;
  write_bytes(folder / "a", "head");
  std::filesystem::resize_file(folder / "a", std::uint64_t{1} << 40);
  ByteSource source(folder / "a", Packing::kPlain, 2);
  EXPECT_FALSE(source.is_packed());
  EXPECT_EQ(read(source, 2), "ad");
  EXPECT_EQ(source.skip((std::uint64_t{1} << 40) - 5), (std::uint64_t{1} << 40) - 5);
  EXPECT_EQ(source.skip(std::numeric_limits<std::uint64_t>::max()), 1u);
  EXPECT_EQ(read(source, 1), "");
  EXPECT_EQ(source.skip(1), 0u);
  write_bytes(folder / "b", packed("bytes"));
  EXPECT_TRUE(ByteSource(folder / "b", Packing::kSniffed).is_packed());
}

TEST(ByteSource, JoinedGzipFilesAreOneAndPaddingIsPassedOver) {
  const TempFolder folder;
  write_bytes(folder / "two", packed("first ") + packed("second") + std::string(100, '\0'));
  EXPECT_EQ(read_whole(folder / "two"), "first second");
}

TEST(ByteSource, ReadAllGivesTheWholeFile) {
  const TempFolder folder;
  for (const std::size_t size : {0u, 1u, 1u << 22, (1u << 22) + 1}) {
    const std::string bytes = sample(size);
    write_bytes(folder / "a", bytes);
    EXPECT_TRUE(read_whole(folder / "a") == bytes) << size;
  }
}

/// 40 MB in 40 kB: refused before they are unpacked.
TEST(ByteSource, ReadAllClaimsTheBytesBeforeItTakesThem) {
  const TempFolder folder;
  write_bytes(folder / "bomb.gz", packed(std::string(40'000'000, '\0')));
  write_bytes(folder / "plain", std::string(2'000'000, 'x'));
  EXPECT_REFUSED(read_whole(folder / "bomb.gz", 0.02), HasSubstr("bomb.gz: memory: expected a"));
  EXPECT_REFUSED(read_whole(folder / "plain", 0.001), HasSubstr("claims 2 MB"));
  MemoryBudget budget(folder / "plain", {0.0021});
  EXPECT_EQ(read_all(folder / "plain", budget).size(), 2'000'000u);
  EXPECT_NEAR(static_cast<double>(budget.held()), 2e6, 100);
  EXPECT_EQ(read_whole(folder / "bomb.gz", 0.2).size(), 40'000'000u);
}

TEST(ByteSource, ReadAllStopsWhereTheFirstBytesJustifyNoMore) {
  const TempFolder folder;
  const std::string bytes = "7" + std::string(40'000'000, 'x');
  write_bytes(folder / "a.gz", packed(bytes));
  write_bytes(folder / "b.gz", packed("0" + bytes));
  const auto most = [](std::string_view first) {
    return std::uint64_t{1000} * static_cast<unsigned char>(first[0] - '0');
  };
  EXPECT_EQ(read_whole(folder / "a.gz", 0.001, most), bytes.substr(0, 7000));
  EXPECT_REFUSED(read_whole(folder / "b.gz", 0.001, most), HasSubstr("memory"));
}

/// A pipe that nobody writes would be waited for for ever.
TEST(ByteSource, APipeIsRefusedWithoutWaiting) {
  const TempFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_REFUSED(ByteSource(folder / "pipe", Packing::kPlain),
                 HasSubstr("expected a file or a directory, found neither"));
}

TEST(ByteSource, CutOffOrBrokenDataAreRefused) {
  const TempFolder folder;
  const std::string whole = packed(sample(100'000));
  write_bytes(folder / "cut", whole.substr(0, whole.size() / 2));
  EXPECT_REFUSED(read_whole(folder / "cut"), HasSubstr("cut: the compressed data are cut off"));
  std::string damaged = whole;
  damaged[damaged.size() - 8] ^= 1;  // the check sum
  write_bytes(folder / "damaged", damaged);
  EXPECT_REFUSED(read_whole(folder / "damaged"),
                 HasSubstr("damaged: the compressed data are broken"));
}

TEST(ByteSource, AFileThatIsMissingOrTooShortIsRefused) {
  const TempFolder folder;
  write_bytes(folder / "a", "12345");
  EXPECT_REFUSED(ByteSource(folder / "none", Packing::kPlain),
                 HasSubstr("none: cannot be read: no such file or directory"));
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
}  // namespace mesamis
