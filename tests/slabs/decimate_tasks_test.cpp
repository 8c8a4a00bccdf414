// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "mesamis/decimate/decimate.h"
#include "mesamis/surface/distance.h"
#include "mesamis/surface/self_intersections.h"
#include "slabs/three_slabs.h"

namespace mesamis {
namespace {

using DecimateSlab = OnMeshedSlabs;

TEST_F(DecimateSlab, KeepsThePromisesOfDecimateAndLeavesNoSeams) {
  ThreeSlabs slabs;
  slabs.extract();
  slabs.follow();
  slabs.choose();
  constexpr double kTolerance = 0.1;
  slabs.decimate(kTolerance);
  const TriMesh before = followed_surface(*slabs.run), after = decimated_surface(*slabs.run);
  EXPECT_EQ(solid_flaws_of(check_surface(after)), "");
  EXPECT_TRUE(find_self_intersections(after).empty());
  EXPECT_LE(max_distance(before, after, 1e-3), kTolerance);
  EXPECT_LE(max_distance(after, before, 1e-3), kTolerance);
  const TriMesh whole = decimate(before, {.tolerance = kTolerance});
  EXPECT_LT(static_cast<double>(after.triangles.size()),
            1.1 * static_cast<double>(whole.triangles.size()));
  const PrintableReport report = printable_report(*slabs.run);
  EXPECT_EQ(report.triangles_extracted, std::ssize(before.triangles));
  EXPECT_TRUE(report.within(kTolerance));
  EXPECT_NEAR(report.extracted_to_result, max_distance(before, after, 1e-3), 2e-3);
  EXPECT_NEAR(report.result_to_extracted, max_distance(after, before, 1e-3), 2e-3);
  EXPECT_EQ(report.parts->islands, 1);
}

}  // namespace
}  // namespace mesamis
