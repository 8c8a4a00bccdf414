// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/deflate.h"

#include <gtest/gtest.h>

#include "mesamis/files/byte_source.h"
#include "support/temp_folder.h"

namespace mesamis::detail {
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

}  // namespace
}  // namespace mesamis::detail
