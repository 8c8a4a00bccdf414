// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "slabs/three_slabs.h"

namespace mesamis {
namespace {

using ListParts = OnMeshedSlabs;

// One rod in three slabs.
TEST_F(ListParts, AddUpToThoseOfTheWhole) {
  ThreeSlabs slabs;
  slabs.extract();
  slabs.follow();
  slabs.choose();
  const SurfaceParts& parts = slabs.run->parts;
  const TriMesh whole = followed_surface(*slabs.run);
  const SurfaceCheck check = check_surface(whole);
  ASSERT_EQ(parts.sizes.size(), 1u);
  EXPECT_EQ(parts.sizes[0].triangles, std::ssize(whole.triangles));
  EXPECT_NEAR(parts.sizes[0].volume / check.volume, 1, 1e-9);
  EXPECT_NEAR(parts.sizes[0].area / check.area, 1, 1e-9);
  EXPECT_NEAR(parts.mean_error / expected_shape_error(slabs.mesh->input, whole).mean, 1, 1e-9);
  for (const auto& of_slab : parts.of_slab) {
    EXPECT_FALSE(of_slab.empty());
    for (const Index part : of_slab) EXPECT_EQ(part, 0);  // a slab may hold it in pieces
  }
  EXPECT_GT(parts.shift, 0);
  EXPECT_LT(parts.shift, 1e-5) << "mm";
  EXPECT_EQ(slabs.run->choice.goes, std::vector<char>{0});
  EXPECT_EQ(slabs.run->choice.report.islands, 1);
}

// Slabs work on what lies between the others: what they change cannot meet.
TEST_F(ListParts, TellTheHeightsOfTheirPieces) {
  ThreeSlabs slabs;
  slabs.extract();
  slabs.follow();
  slabs.choose();
  const SurfaceParts& parts = slabs.run->parts;
  for (std::size_t s = 0; s < 2; ++s) {
    EXPECT_LT(parts.core[s].high, parts.core[s + 1].low);
    EXPECT_GE(parts.border[s].high, parts.core[s + 1].low) << "they share a rim";
    EXPECT_LE(parts.border[s].low, parts.core[s].high);
  }
  EXPECT_GT(parts.border[2].low, parts.border[2].high) << "nothing lies above the last slab";
}

}  // namespace
}  // namespace mesamis
