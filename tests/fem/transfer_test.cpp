// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/transfer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesamis/base/parallel.h"
#include "support/perturbed_box.h"
#include "support/sampled_volume.h"

namespace mesamis {
namespace {

double linear(const Vec3& p) { return 10 + 3 * p.x - 2 * p.y + 0.5 * p.z; }

Volume linear_image(const std::array<Index, 3>& size, const Vec3& spacing) {
  return sampled_volume(size, spacing, linear);
}

TEST(ProjectImage, ReproducesLinearImagesOnAnyMesh) {
  const Volume image = linear_image({13, 11, 9}, {1, 0.8, 1.5});
  const double unit = 0.5;  // mesh coordinates are mm / unit
  const Vec3 extent = (1 / unit) * image.box().extent();
  for (const std::array<Index, 3> n : {std::array<Index, 3>{2, 3, 2}, {20, 14, 25}}) {
    const TetMesh mesh = perturbed_box({{0, 0, 0}, extent}, n, 0.25);
    const MeshSpace space(mesh);
    SolveReport report;
    const auto f = project_image(image, space, unit, {1e-12, 500, 500}, &report);
    EXPECT_TRUE(report.converged);
    for (std::size_t i = 0; i < f.size(); ++i)
      EXPECT_NEAR(f[i], linear(unit * mesh.points[i]), 1e-4);
  }
}

TEST(ProjectImage, KeepsTheMean) {
  // The projection has the integral of the image: test function one.
  Volume image = linear_image({17, 17, 17}, {1, 1, 1});
  for (std::size_t i = 0; i < image.samples.size(); ++i) {
    image.samples[i] = static_cast<float>(100 + 50 * std::sin(0.3 * static_cast<double>(i % 289)));
  }
  const TetMesh mesh = perturbed_box({{0, 0, 0}, {16, 16, 16}}, {16, 16, 16}, 0.0);
  const MeshSpace space(mesh);
  const auto f = project_image(image, space, 1, {1e-12, 500, 500});
  double projected = 0, exact = 0;
  for (std::size_t n = 0; n < f.size(); ++n) {
    projected += space.lumped_mass()[n] * f[n];
    exact += space.lumped_mass()[n] * image.samples[n];
  }
  EXPECT_NEAR(projected / exact, 1, 2e-3);
}

TEST(ProjectImage, OntoTheVoxelsOwnGridIsTheIdentity) {
  const Volume image = linear_image({6, 5, 4}, {1, 2, 3});
  const auto f = project_image(image, KuhnGrid{{6, 5, 4}, {1, 2, 3}});
  for (std::size_t n = 0; n < f.size(); ++n) EXPECT_EQ(f[n], image.samples[n]);
}

TEST(ProjectImage, OntoACoarseGridSeesEveryVoxel) {
  Volume image = linear_image({9, 9, 9}, {1, 1, 1});
  const KuhnGrid grid{{5, 5, 5}, {2, 2, 2}};
  const auto before = project_image(image, grid);
  for (std::size_t v = 0; v < image.samples.size(); ++v) {
    image.samples[v] += 100;
    EXPECT_NE(project_image(image, grid), before);
    image.samples[v] -= 100;
  }
}

TEST(ProjectImage, OntoACoarseGridKeepsLinearImages) {
  const Volume image = linear_image({9, 9, 9}, {1, 1, 1});
  const auto f = project_image(image, KuhnGrid{{5, 5, 5}, {2, 2, 2}});
  for (int n = 0; n < 125; ++n) {
    EXPECT_NEAR(f[static_cast<std::size_t>(n)],
                linear({2.0 * (n % 5), 2.0 * (n / 5 % 5), 2.0 * (n / 25)}), 1e-5);
  }
}

TEST(InterpolateFields, MeshToMeshIsExactForLinearFields) {
  const TetMesh from = perturbed_box({{0, 0, 0}, {3, 2, 1}}, {6, 5, 4}, 0.25, 1);
  const TetMesh to = perturbed_box({{0, 0, 0}, {3, 2, 1}}, {5, 7, 3}, 0.25, 2);
  std::vector<double> u, v(from.points.size(), 1);
  for (const Vec3& p : from.points) u.push_back(linear(p));
  const std::vector<std::span<const double>> fields{u, v};
  const auto result = interpolate_fields(from, fields, to.points);
  for (std::size_t n = 0; n < to.points.size(); ++n) {
    EXPECT_NEAR(result[0][n], linear(to.points[n]), 1e-12);
    EXPECT_NEAR(result[1][n], 1, 1e-14);
  }
}

TEST(InterpolateFields, GridAgreesWithTheMeshOfItsCells) {
  const KuhnGrid grid{{5, 6, 4}, {1, 0.5, 2}};
  const TetMesh mesh = box_mesh(grid.box(), {4, 5, 3});
  const TetMesh to = perturbed_box(grid.box(), {7, 7, 7}, 0.25);
  std::vector<double> u;
  for (std::size_t n = 0; n < mesh.points.size(); ++n)
    u.push_back(std::sin(static_cast<double>(n)));
  const std::vector<std::span<const double>> fields{u};
  const auto a = interpolate_fields(grid, fields, to.points);
  const auto b = interpolate_fields(mesh, fields, to.points);
  for (std::size_t n = 0; n < to.points.size(); ++n) EXPECT_NEAR(a[0][n], b[0][n], 1e-10);
}

}  // namespace
}  // namespace mesamis
