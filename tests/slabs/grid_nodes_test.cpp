// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/grid_nodes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/temp_folder.h"
#include "support/throws.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

GridWindow window_of_slices(Index slices) {
  GridWindow window{{{0, 0, 1}, {3, 2, 1.0 * slices}}, {4, 3, slices}, {}, {}, {}};
  for (Index n = 0; n < 12 * slices; ++n) {
    const auto at = static_cast<float>(n);
    window.u.push_back(300 * std::sin(at));
    window.v.push_back(std::abs(std::cos(at)));
    window.log_metrics.push_back({-14 + 0.1F * at, 0.001F * at, -at / 40, 2, at / 20, 3.2F});
  }
  return window;
}

TEST(GridNodes, AreWhatWasWrittenButForRounding) {
  const TempFolder temp;
  const GridWindow window = window_of_slices(6);
  write_nodes(temp / "nodes", window);
  const GridWindow read = read_nodes(temp / "nodes", window, 2.4, 4);
  EXPECT_EQ(read.box.lo, (Vec3{0, 0, 2}));
  EXPECT_EQ(read.box.hi, (Vec3{3, 2, 4}));
  ASSERT_EQ(read.size, (std::array<Index, 3>{4, 3, 3}));
  ASSERT_EQ(read.u.size(), 36U);
  for (std::size_t n = 0; n < 36; ++n) {
    EXPECT_NEAR(read.u[n], window.u[n + 12], 0.0051);
    EXPECT_NEAR(read.v[n], window.v[n + 12], 1.6e-5);
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_NEAR(read.log_metrics[n][i], window.log_metrics[n + 12][i], 2.6e-4);
    }
  }
}

TEST(GridNodes, WhatIsTooLargeStaysAtTheBound) {
  const TempFolder temp;
  GridWindow window = window_of_slices(2);
  window.u[0] = 1e9;
  window.u[1] = -1e9;
  write_nodes(temp / "nodes", window);
  const GridWindow read = read_nodes(temp / "nodes", window, 0, 9);
  EXPECT_NEAR(read.u[0], 327.67, 1e-3);
  EXPECT_NEAR(read.u[1], -327.67, 1e-3);
}

TEST(GridNodes, RefusesAFileOfAnotherSize) {
  const TempFolder temp;
  write_nodes(temp / "nodes", window_of_slices(4));
  EXPECT_REFUSED(read_nodes(temp / "nodes", window_of_slices(5), 0, 9),
                 HasSubstr("/nodes: expected"));
}

}  // namespace
}  // namespace mesamis
