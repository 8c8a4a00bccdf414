// SPDX-License-Identifier: Apache-2.0
#include "mesamis/base/each_once.h"

#include <gtest/gtest.h>

#include <string>

namespace mesamis {
namespace {

TEST(EachOnce, SortsAndLeavesEachOnce) {
  std::vector<int> values{3, 1, 2, 3, 1, 1};
  sort_once(values);
  EXPECT_EQ(values, (std::vector<int>{1, 2, 3}));
  std::vector<std::string> none;
  sort_once(none);
  EXPECT_TRUE(none.empty());
}

TEST(EachOnce, AddsWhatIsNotThere) {
  std::vector<int> values{3, 1};
  for (const int value : {1, 2, 3, 2}) add_once(values, value);
  EXPECT_EQ(values, (std::vector<int>{3, 1, 2})) << "in the order of the first";
}

}  // namespace
}  // namespace mesamis
