// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fit/boundary_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "mesamis/surface/extract_net.h"
#include "support/label_grids.h"

namespace mesamis {
namespace {

/// Label 1: a block with a cavity, and a cube beside it that label 2 touches.
PartitionSurface three_parts() {
  const OwnedLabels labels = labels_where({24, 14, 14}, {1, 1, 1}, [](const Vec3& p) {
    const auto within = [&](double lo, double hi, double x) { return p.x >= lo && p.x < hi && x; };
    const bool wide = std::min(p.y, p.z) >= 3 && std::max(p.y, p.z) < 10;
    if (p == Vec3{6, 6, 6}) return 0;
    if (within(3, 10, wide ? 1 : 0)) return 1;
    if (within(13, 16, wide ? 1 : 0)) return 1;
    return within(16, 20, wide ? 1 : 0) ? 2 : 0;
  });
  return extract_net_on_grid(smooth_memberships(labels.grid()));
}

TEST(BoundaryParts, AreThoseThatHangTogether) {
  const PartitionSurface net = three_parts();
  const TriMesh surface{net.points, net.triangles};
  const BoundaryParts parts = parts_of_boundaries(surface, net.sides);
  ASSERT_EQ(parts.material.size(), 5U);
  EXPECT_EQ(std::ranges::count(parts.material, 1), 3);
  EXPECT_EQ(std::ranges::count(parts.material, 2), 1);
  double whole = 0;
  int cavities = 0;
  for (std::size_t p = 1; p < parts.material.size(); ++p) {
    if (parts.material[p] != 1) continue;
    whole += parts.volumes[p];
    if (parts.volumes[p] < 0) ++cavities;
  }
  EXPECT_EQ(cavities, 1);
  EXPECT_NEAR(whole, check_surface(object_surface(net, 1)).volume, 1e-9);
  for (std::size_t t = 0; t < net.sides.size(); ++t) {
    for (const std::size_t side : {0, 1}) {
      const Index part = parts.sides[t][side];
      EXPECT_EQ(part > 0 ? parts.material[static_cast<std::size_t>(part)] : part,
                net.sides[t][side]);
    }
  }
}

TEST(BoundaryParts, AreScaledToTheVolumesOfTheirMaterials) {
  const PartitionSurface net = three_parts();
  BoundaryParts parts = parts_of_boundaries({net.points, net.triangles}, net.sides);
  const std::vector<double> before = parts.volumes;
  parts.scale_to(std::vector<double>{0, 1000});
  double sum = 0;
  for (std::size_t p = 1; p < before.size(); ++p) {
    if (parts.material[p] == 2) {
      EXPECT_EQ(parts.volumes[p], before[p]) << "nothing is told of it";
    } else {
      sum += parts.volumes[p];
      EXPECT_NEAR(parts.volumes[p] / before[p], parts.volumes[1] / before[1], 1e-12);
    }
  }
  EXPECT_NEAR(sum, 1000, 1e-9);
}

}  // namespace
}  // namespace mesamis
