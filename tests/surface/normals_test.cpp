// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/normals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/extract.h"
#include "support/shapes.h"

namespace mesamis {
namespace {

TEST(VertexNormals, OfASphereAreRadial) {
  const TetMesh mesh = box_mesh({{-1, -1, -1}, {1, 1, 1}}, {24, 24, 24});
  std::vector<double> u;
  for (const Vec3& p : mesh.points) u.push_back(-norm(p));
  const TriMesh sphere = extract_solid(mesh, u, -0.7);
  const std::vector<Vec3> normals = vertex_normals(sphere);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    EXPECT_NEAR(norm(normals[i]), 1, 1e-12);
    EXPECT_GT(dot(normals[i], sphere.points[i]), 0.98 * norm(sphere.points[i]));
  }
}

TEST(VertexNormals, AreZeroWhereThereIsNoTriangle) {
  TriMesh surface = cube();
  surface.points.push_back({5, 5, 5});
  surface.triangles.push_back({0, 0, 8});
  EXPECT_EQ(vertex_normals(surface)[8], (Vec3{0, 0, 0}));
}

}  // namespace
}  // namespace mesamis
