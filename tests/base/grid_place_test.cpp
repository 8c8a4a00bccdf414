// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>

#include "mesamis/base/types.h"

namespace mesamis {
namespace {

TEST(GridPlace, CountsLineByLineAndLayerByLayer) {
  const std::array<Index, 3> size{3, 4, 2};
  Index n = 0;
  for (Index k = 0; k < size[2]; ++k) {
    for (Index j = 0; j < size[1]; ++j) {
      for (Index i = 0; i < size[0]; ++i, ++n) {
        const std::array<Index, 3> place{i, j, k};
        EXPECT_EQ(grid_place(size, n), place);
        EXPECT_EQ(grid_place(size, static_cast<std::size_t>(n)), place);
      }
    }
  }
}

TEST(GridPlace, OfMoreThan32Bits) {
  const std::array<Index, 3> size{4096, 4096, 1024}, place{17, 4000, 1000};
  EXPECT_EQ(grid_place(size, (std::int64_t{1000} * 4096 + 4000) * 4096 + 17), place);
}

}  // namespace
}  // namespace mesamis
