// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/memory_budget.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "mesamis/base/available_memory.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

constexpr double kKilobyte = 1e-6;  // in GB
constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();

TEST(MemoryBudget, GivesWhatIsAllowedAndNoByteMore) {
  MemoryBudget budget("a.stl", {kKilobyte});
  EXPECT_EQ(budget.limit(), 1000u);
  budget.claim(99, 10, "triangles");
  EXPECT_EQ(budget.held(), 990u);
  EXPECT_REFUSED(budget.claim(11, 1, "points"),
                 AllOf(StartsWith("a.stl: memory: expected"), HasSubstr("at most 0.001 MB"),
                       HasSubstr("claims 1.1e-05 MB for points beside 0.00099 MB")));
  EXPECT_EQ(budget.held(), 990u);  // what was refused is not held
  budget.claim(10, 1, "points");
  budget.give_back(400);
  budget.claim(1, 400, "points");
  EXPECT_REFUSED(budget.claim(1, 1, "points"), HasSubstr("memory"));
  budget.claim(kMost, 0, "nothing");
}

/// 2^32 times 2^32 is 0 in 64 bits.
TEST(MemoryBudget, CountsWhoseProductLeaves64BitsAreRefused) {
  MemoryBudget budget("a", {1e3});
  const std::uint64_t big = std::uint64_t{1} << 32;
  EXPECT_REFUSED(budget.claim(big, big, "values"), HasSubstr("claims 1.84467e+13 MB for values"));
  EXPECT_REFUSED(budget.claim(kMost, kMost, "values"), HasSubstr("memory"));
  EXPECT_REFUSED(budget.claim(kMost, 1, "values"), HasSubstr("memory"));
  EXPECT_EQ(budget.held(), 0u);
}

TEST(MemoryBudget, WithoutALimitIsWhatIsFree) {
  const auto before = available_memory();
  if (!before) GTEST_SKIP() << "this system does not tell";
  const MemoryBudget budget("a", {});
  EXPECT_NEAR(static_cast<double>(budget.limit()), *before, 0.5 * *before);
}

TEST(MemoryBudget, AScopedClaimIsGivenBack) {
  MemoryBudget budget("a", {kKilobyte});
  {
    const ScopedClaim claim(budget, 100, 8, "pixels");
    EXPECT_EQ(budget.held(), 800u);
    EXPECT_REFUSED(ScopedClaim(budget, 100, 8, "pixels"), HasSubstr("for pixels"));
  }
  EXPECT_EQ(budget.held(), 0u);
}

/// While a vector grows, its old and its new elements are held.
TEST(MemoryBudget, AVectorGrowsAsFarAsItIsAllowed) {
  MemoryBudget budget("a", {kKilobyte});
  std::vector<std::uint64_t> numbers;
  EXPECT_REFUSED(for (std::uint64_t n = 0; n < 1000; ++n)
                     append_within(budget, numbers, n, "numbers"),
                 HasSubstr("for numbers"));
  EXPECT_EQ(numbers.size(), 64u);  // 128 of them beside 64 would be 1536 bytes
  EXPECT_EQ(numbers.back(), 63u);
  EXPECT_EQ(budget.held(), 8 * numbers.capacity());
  std::string text;
  reserve_within(budget, text, 400, "text");
  EXPECT_GE(text.capacity(), 400u);
  EXPECT_REFUSED(reserve_within(budget, text, 500, "text"), HasSubstr("for text"));
}

}  // namespace
}  // namespace mesamis
