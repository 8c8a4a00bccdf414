// SPDX-License-Identifier: Apache-2.0
#include "mesamis/fem/transfer.h"

#include <gtest/gtest.h>

#include <algorithm>
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
    const ProjectedImage projected = project_image(
        interpolating_spline(image), space, {.point_scale = unit, .solver = {1e-12, 500, 500}});
    EXPECT_TRUE(projected.solve.converged);
    const std::vector<double>& f = projected.values;
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
  const auto f =
      project_image(interpolating_spline(image), space, {.solver = {1e-12, 500, 500}}).values;
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

/// The volume turned, and the mesh that fills its box in the world.
struct Placed {
  Volume volume;
  TetMesh mesh;

  explicit Placed(bool left_handed) : volume(linear_image({13, 11, 9}, {1, 0.8, 1.5})) {
    const double c = 0.6, s = left_handed ? 0.8 : -0.8;
    volume.direction.rows = {Vec3{c, s, 0}, Vec3{0.8, left_handed ? -c : c, 0}, Vec3{0, 0, 1}};
    volume.origin = {-40, 7, 1000};
    mesh = perturbed_box(volume.box(), {4, 5, 12}, 0.25);
    for (Vec3& p : mesh.points) p = volume.to_world(p);
    if (left_handed) {
      for (Cell& cell : mesh.cells) std::swap(cell[2], cell[3]);
    }
  }
  /// The linear function at a place in the world.
  double value(const Vec3& world) const {
    const Vec3 d = world - volume.origin;
    const auto& r = volume.direction.rows;
    return linear(d.x * r[0] + d.y * r[1] + d.z * r[2]);
  }
};

TEST(AverageImage, IsExactOnCellsForLinearImagesHoweverTheGridLies) {
  for (const bool left_handed : {false, true}) {
    const Placed placed(left_handed);
    ASSERT_GT(cell_volume(placed.mesh, 0), 0);
    const ImageMeans means = average_image(placed.volume, placed.mesh);
    ASSERT_EQ(means.cells.size(), placed.mesh.cells.size());
    for (std::size_t k = 0; k < means.cells.size(); ++k) {
      const auto p = cell_corners(placed.mesh, placed.mesh.cells[k]);
      EXPECT_NEAR(means.cells[k], placed.value(0.25 * (p[0] + p[1] + p[2] + p[3])), 1e-4);
    }
  }
}

TEST(AverageImage, OfNodesHasTheCellsIntegralAndStaysInTheRange) {
  Placed placed(true);
  for (std::size_t i = 0; i < placed.volume.samples.size(); ++i) {
    placed.volume.samples[i] = i % 13 < 6 ? -1000.0f : 3000.0f;  // far beyond any window
  }
  const ImageMeans means = average_image(placed.volume, placed.mesh);
  double of_cells = 0, of_nodes = 0;
  for (std::size_t k = 0; k < placed.mesh.cells.size(); ++k) {
    const double volume = cell_volume(placed.mesh, static_cast<Index>(k));
    of_cells += volume * means.cells[k];
    for (const Index n : placed.mesh.cells[k]) of_nodes += volume / 4 * means.nodes[n];
  }
  EXPECT_NEAR(of_nodes / of_cells, 1, 1e-12);
  const auto [low, high] = std::minmax_element(means.nodes.begin(), means.nodes.end());
  EXPECT_GT(*low, -1000 - 0.02 * 4000);  // the quadrature's share
  EXPECT_LT(*high, 3000 + 0.02 * 4000);
  EXPECT_GT(*high, 2500);
}

TEST(AverageImage, HasTheSameBitsForAnyNumberOfThreads) {
  const Placed placed(false);
  const ImageMeans one = with_threads(1, [&] { return average_image(placed.volume, placed.mesh); });
  const ImageMeans two = with_threads(2, [&] { return average_image(placed.volume, placed.mesh); });
  EXPECT_EQ(one.cells, two.cells);
  EXPECT_EQ(one.nodes, two.nodes);
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
  const std::vector<float> rounded(u.begin(), u.end());
  u.assign(rounded.begin(), rounded.end());
  const auto a = interpolate_fields(grid, std::vector<std::span<const float>>{rounded}, to.points);
  const auto b = interpolate_fields(mesh, std::vector<std::span<const double>>{u}, to.points);
  for (std::size_t n = 0; n < to.points.size(); ++n) EXPECT_NEAR(a[0][n], b[0][n], 1e-10);
}

}  // namespace
}  // namespace mesamis
