// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/zip_archive.h"

#include <gtest/gtest.h>

#include "support/throws.h"
#include "support/zip_bytes.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::optional<std::string> part_of(const std::string& bytes, std::string_view name,
                                   double memory_gb = 1) {
  MemoryBudget budget("a.zip", {memory_gb});
  return ZipArchive("a.zip", bytes, budget).part(name);
}

TEST(ZipArchive, GivesStoredAndDeflatedParts) {
  for (const bool deflated : {false, true}) {
    const std::string bytes = zip_bytes(
        {{"one.txt", "first"}, {"In/Two", std::string(100'000, 'x')}, {"empty", ""}}, deflated);
    EXPECT_EQ(part_of(bytes, "one.txt"), "first");
    EXPECT_EQ(part_of(bytes, "in/TWO"), std::string(100'000, 'x'));
    EXPECT_EQ(part_of(bytes, "empty"), "");
    EXPECT_EQ(part_of(bytes, "two"), std::nullopt);
    EXPECT_EQ(part_of(bytes + "a comment behind it", "one.txt"), "first");
  }
}

TEST(ZipArchive, WhatIsCutOffOrBrokenIsRefused) {
  const std::string bytes = zip_bytes({{"a", std::string(1000, 'x')}, {"b", "second"}});
  EXPECT_REFUSED(part_of("", "a"), HasSubstr("a.zip: is not a ZIP archive"));
  EXPECT_REFUSED(part_of("PK but nothing else, twenty-two", "a"), HasSubstr("is not a ZIP"));
  for (std::size_t size = 1; size < bytes.size(); ++size) {
    EXPECT_REFUSED(part_of(bytes.substr(0, size), "a"), HasSubstr("ZIP archive"));
    EXPECT_REFUSED(part_of(bytes.substr(size), "a"), testing::Not(HasSubstr("internal")));
  }
  for (std::size_t at = 0; at < bytes.size(); ++at) {  // refused, or as it was
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x81);
    try {
      const auto part = part_of(damaged, "a");
      EXPECT_TRUE(!part || *part == std::string(1000, 'x')) << at;
    } catch (const InputError&) {
    }
  }
}

/// 1 GB in a file of 200 bytes, and 40 MB that are really there.
TEST(ZipArchive, AClaimIsComparedWithTheBytesAndTheMemoryBeforeItIsUnpacked) {
  std::string liar = zip_bytes({{"a", "little"}});
  const std::size_t size_at = liar.find("PK\1\2") + 24;
  liar.replace(size_at, 4, std::string("\0\0\0\x40", 4));
  EXPECT_REFUSED(part_of(liar, "a", 10), HasSubstr("claims 1073741824 bytes"));
  const std::string bomb = zip_bytes({{"a", std::string(40'000'000, '\0')}});
  EXPECT_REFUSED(part_of(bomb, "a", 0.02), AllOf(HasSubstr("memory"), HasSubstr("40 MB")));
  EXPECT_EQ(part_of(bomb, "a", 0.05)->size(), 40'000'000u);
}

}  // namespace
}  // namespace mesamis
