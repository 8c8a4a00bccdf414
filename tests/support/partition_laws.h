// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "mesamis/surface/partition.h"
#include "mesamis/surface/self_intersections.h"

namespace mesamis {

/// What holds for every partition of a box: each object closed, 2-manifold and outward, nothing
/// intersects, and the objects' volumes add up to that of the box.
inline void expect_partition_laws(const PartitionSurface& partition, double volume,
                                  const std::string& what) {
  ASSERT_EQ(partition.sides.size(), partition.triangles.size()) << what;
  double sum = 0;
  for (const Index material : materials_of(partition)) {
    const SurfaceCheck check = check_surface(object_surface(partition, material));
    EXPECT_EQ(solid_flaws_of(check), "") << what << ", material " << material;
    sum += check.volume;
  }
  EXPECT_NEAR(sum, volume, 1e-12 * volume) << what;
  EXPECT_TRUE(find_self_intersections({partition.points, partition.triangles}).empty()) << what;
}

}  // namespace mesamis
