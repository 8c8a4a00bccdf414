// SPDX-License-Identifier: Apache-2.0
#include "mesamis/printing/prusa_info.h"

#include <gmock/gmock.h>

namespace mesamis {
namespace {

using testing::Pair;

TEST(PrusaInfo, OfASoundSurface) {
  const PrusaInfo info = parse_prusa_info(
      "[2026-01-01 00:00:00.1] [0x00] [trace]   Initializing StaticPrintConfigs\n"
      "[cube.stl]\nsize_x = 20.000000\nmin_x = -110.000000\nmax_x = -90.000000\n"
      "number_of_facets = 12\nmanifold = yes\nnumber_of_parts =  2\nvolume = 8000.000488\n");
  EXPECT_TRUE(info.sound());
  EXPECT_EQ(info.parts, 2);
  EXPECT_NEAR(info.volume, 8000, 1e-3);
}

TEST(PrusaInfo, OfAnUnsoundSurface) {
  const PrusaInfo open = parse_prusa_info(
      "number_of_facets = 11\nmanifold = no\nopen_edges = 3\nnumber_of_parts =  1\n");
  EXPECT_FALSE(open.sound());
  EXPECT_EQ(open.open_edges, 3);
  const PrusaInfo flipped = parse_prusa_info("manifold = yes\nfacets_reversed = 1\n");
  EXPECT_FALSE(flipped.sound()) << "what was repaired was not sound";
  EXPECT_THAT(flipped.repairs, testing::ElementsAre(Pair("facets_reversed", 1)));
  for (const auto* text : {"", "manifold", "manifold = no\n", "volume = 3\n"}) {
    EXPECT_FALSE(parse_prusa_info(text).sound()) << text;
  }
}

TEST(PrusaInfo, NumbersThatAreNoneAreSkipped) {
  const PrusaInfo info =
      parse_prusa_info("manifold = yes\nvolume = nan\nopen_edges = many\nedges_fixed = 1e300\n");
  EXPECT_EQ(info.volume, 0);
  EXPECT_EQ(info.open_edges, 0);
  ASSERT_EQ(info.repairs.size(), 1u);
  EXPECT_EQ(info.repairs[0].second, std::int64_t{1000000000000000000});
}

TEST(PrusaInfo, FlawsAreListed) {
  EXPECT_EQ(flaws_of(parse_prusa_info("manifold = yes\n")), "");
  EXPECT_EQ(flaws_of(parse_prusa_info("manifold = no\n")), "manifold = no");
  EXPECT_EQ(flaws_of(parse_prusa_info("manifold = no\nopen_edges = 3\nfacets_reversed = 2\n")),
            "open_edges = 3, facets_reversed = 2");
}

}  // namespace
}  // namespace mesamis
