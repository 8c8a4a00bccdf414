// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/explore.h"

#include "remesh/small_mesh.h"

namespace mesamis {
namespace {

/// Fine in a ball that no vertex or edge of a coarse mesh meets.
const FormulaMetric kHidden([](const Vec3& p) {
  const Vec3 center{0.63, 0.29, 0.41};
  const double h = norm(p - center) < 0.06 ? 0.01 : 1;
  return 1 / (h * h) * kIdentity3;
});

TEST(Explore, FindsDetailThatNoVertexHasMet) {
  SmallMesh small(box_mesh(kUnitBox, {2, 2, 2}), kHidden);
  EXPECT_EQ(split_long_edges(small.bench, {}), 0);
  EXPECT_GT(split_unseen_detail(small.bench, {}), 0);
  expect_sound(small.mesh);
  EXPECT_TRUE(std::any_of(small.mesh.vertices.begin(), small.mesh.vertices.end(),
                          [](const Vertex& v) { return v.density > 1e5; }));
}

TEST(Explore, LeavesAMeshWithoutSecretsAlone) {
  const FormulaMetric metric = uniform_metric(0.25);
  SmallMesh small(box_mesh(kUnitBox, {4, 4, 4}), metric);
  EXPECT_EQ(split_unseen_detail(small.bench, {}), 0);
}

TEST(Explore, ProbesIntegrateTheComplexity) {
  const FormulaMetric metric([](const Vec3& p) {
    const double density = 1 + 6 * p.x * p.y;  // the integral over the unit cube is 2.5
    return std::pow(density, 2.0 / 3) * kIdentity3;
  });
  EXPECT_NEAR(probe_complexity(MetricSampler(metric, kUnitBox), kUnitBox), 2.5, 1e-3);
}

}  // namespace
}  // namespace mesamis
