// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/deflate.h"

#include <gtest/gtest.h>

#include "mesamis/files/byte_source.h"
#include "support/temp_folder.h"

namespace mesamis {
namespace {

TEST(Deflate, ReadsBack) {
  const TempFolder folder;
  std::string many;
  for (int n = 0; n < 300'000; ++n) many += static_cast<char>(n * n % 251);
  for (const std::string& bytes : {std::string(), std::string("a"), many}) {
    const std::string packed = gzipped("a.gz", bytes);
    write_bytes(folder / "a.gz", packed);
    MemoryBudget budget(folder / "a.gz", {1});
    EXPECT_EQ(read_all(folder / "a.gz", budget), bytes);
  }
  EXPECT_LT(gzipped("a.gz", many).size(), many.size() / 10);
}

/// Parts shorter and longer than the window of the compression, 32 KiB, and none.
TEST(Deflater, GivesTheSameBytesHoweverTheyAreCut) {
  std::string bytes;
  std::uint32_t state = 1;
  for (int n = 0; n < 600'000; ++n) {
    state = state * 1664525u + 1013904223u;
    bytes += static_cast<char>(n % 70'000 < 20'000 ? n / 100 : state >> 29);
  }
  for (const std::size_t size : {97, 32'768, 65'399, 250'000, 1'000'000}) {
    Deflater deflater("a.gz");
    std::string packed = deflater.add({});
    for (std::size_t at = 0; at < bytes.size(); at += size) {
      packed += deflater.add(std::string_view(bytes).substr(at, size));
    }
    EXPECT_TRUE(packed + deflater.finish() == gzipped("a.gz", bytes)) << size;
  }
}

TEST(Deflate, AHigherLevelIsSmallerAndReadsBackToo) {
  const TempFolder folder;
  std::string words;
  for (int n = 0; n < 20'000; ++n) words += std::to_string(n * 7919LL % 1000) + " voxels; ";
  const std::string small = gzipped("a.gz", words, 9);
  EXPECT_LT(small.size(), gzipped("a.gz", words, 1).size());
  write_bytes(folder / "a.gz", small);
  MemoryBudget budget(folder / "a.gz", {1});
  EXPECT_EQ(read_all(folder / "a.gz", budget), words);
}

}  // namespace
}  // namespace mesamis
