// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/adapt_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesamis/base/error.h"
#include "support/throws.h"

namespace mesamis {
namespace {

const Box kCube{{0, 0, 0}, {1, 1, 1}};

std::vector<Sym3> uniform(const TetMesh& mesh, double size) {
  return std::vector<Sym3>(mesh.points.size(), 1 / (size * size) * kIdentity3);
}

TEST(AdaptMesh, ReachesTheSizesAsked) {
  const TetMesh mesh = box_mesh(kCube, {3, 3, 3});
  const AdaptedMesh adapted = adapt_mesh(mesh, uniform(mesh, 0.15));
  EXPECT_NO_THROW(validate(adapted.mesh, kCube));
  EXPECT_TRUE(adapted.report.converged);
  EXPECT_GT(adapted.fit.unit_edge_fraction, 0.9);
  EXPECT_EQ(adapted.fit.unit_edge_fraction,
            measure_fit(adapted.mesh, uniform(adapted.mesh, 0.15)).unit_edge_fraction);
}

TEST(AdaptMesh, KeepsAMeshThatFits) {
  const TetMesh mesh = box_mesh(kCube, {4, 4, 4});
  const AdaptedMesh first = adapt_mesh(mesh, uniform(mesh, 0.2));
  const AdaptedMesh second = adapt_mesh(first.mesh, uniform(first.mesh, 0.2));
  EXPECT_TRUE(second.kept_start);
  EXPECT_LT(second.report.splits, first.report.splits);
}

TEST(AdaptMesh, StartsFromTheBoxWhereTheMeshDoesNotFit) {
  const TetMesh mesh = box_mesh(kCube, {12, 12, 12});
  const AdaptedMesh adapted = adapt_mesh(mesh, uniform(mesh, 0.5));
  EXPECT_FALSE(adapted.kept_start);
  EXPECT_LT(adapted.mesh.cells.size(), mesh.cells.size());
}

TEST(AdaptMesh, TheFitIsToTheEnlargedMetric) {
  const TetMesh mesh = box_mesh(kCube, {3, 3, 3});
  RemeshOptions options;
  options.max_cells = 500;
  const AdaptedMesh adapted = adapt_mesh(mesh, uniform(mesh, 0.05), options);
  EXPECT_GT(adapted.report.size_factor, 1);
  EXPECT_GT(adapted.fit.unit_edge_fraction, 0.8);
}

TEST(AdaptMesh, RefusesAMetricThatIsNone) {
  const TetMesh mesh = box_mesh(kCube, {2, 2, 2});
  EXPECT_REFUSED(adapt_mesh(mesh, std::vector<Sym3>(mesh.points.size(), -1 * kIdentity3)),
                 testing::HasSubstr("positive definite"));
  EXPECT_THROW(adapt_mesh(mesh, std::vector<Sym3>(3, kIdentity3)), InputError);
}

}  // namespace
}  // namespace mesamis
