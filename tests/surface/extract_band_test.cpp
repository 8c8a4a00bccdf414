// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mesamis/base/error.h"
#include "mesamis/surface/extract.h"
#include "support/perturbed_box.h"

namespace mesamis {
namespace {

constexpr Box kUnit{{0, 0, 0}, {1, 1, 1}};

double volume_of(const TetMesh& mesh, const std::vector<Index>& cells) {
  double sum = 0;
  for (const Index c : cells) sum += cell_volume(mesh, c);
  return sum;
}

/// Area of the faces that only one of the cells has.
double skin_area(const TetMesh& mesh, const std::vector<Index>& cells) {
  TetMesh part{mesh.points, {}};
  for (const Index c : cells) part.cells.push_back(mesh.cells[c]);
  const auto neighbors = cell_neighbors(part);
  double sum = 0;
  for (std::size_t c = 0; c < part.cells.size(); ++c) {
    for (std::size_t f = 0; f < 4; ++f) {
      if (neighbors[c][f] != kNoIndex) continue;
      const auto& [i, j, k] = kCellFaces[f];
      const Vec3& a = mesh.points[part.cells[c][i]];
      sum +=
          0.5 * norm(cross(mesh.points[part.cells[c][j]] - a, mesh.points[part.cells[c][k]] - a));
    }
  }
  return sum;
}

void expect_skin_of_the_band(const TetMesh& mesh, const std::vector<double>& v, double threshold) {
  const auto band = band_cells(mesh, v, threshold);
  const SurfaceCheck check = check_surface(extract_band(mesh, v, threshold));
  EXPECT_TRUE(check.closed());
  EXPECT_TRUE(check.manifold()) << check.nonmanifold_edges << ' ' << check.nonmanifold_points << ' '
                                << check.misoriented_edges << ' ' << check.degenerate_triangles;
  EXPECT_NEAR(check.volume, volume_of(mesh, band), 1e-12);
  EXPECT_NEAR(check.area, skin_area(mesh, band), 1e-10);
}

TEST(Band, HoldsTheCellsBelowTheThreshold) {
  const TetMesh mesh = box_mesh(kUnit, {1, 1, 1});
  std::vector<double> v(8, 1);
  v[1] = 0;  // in the two cells whose walk begins along x
  const auto band = band_cells(mesh, v, 0.8);
  for (const Index c : band) {
    EXPECT_EQ(std::count(mesh.cells[c].begin(), mesh.cells[c].end(), 1), 1);
  }
  EXPECT_EQ(band.size(), 2u);
  EXPECT_TRUE(band_cells(mesh, v, 0.75).empty());  // at the threshold is not below it
  EXPECT_EQ(band_cells(mesh, v, 2).size(), 6u);
}

TEST(Band, OfAShellHasTwoSkins) {
  const TetMesh mesh = box_mesh({{-1, -1, -1}, {1, 1, 1}}, {16, 16, 16});
  std::vector<double> v;
  for (const Vec3& p : mesh.points) v.push_back(std::min(1.0, std::abs(norm(p) - 0.6) / 0.15));
  const SurfaceCheck check = check_surface(extract_band(mesh, v, 0.9));
  EXPECT_TRUE(check.closed() && check.manifold());
  EXPECT_EQ(check.components, 2);
  expect_skin_of_the_band(mesh, v, 0.9);
}

TEST(Band, IsManifoldForAnySetOfCells) {
  // Random sets touch along edges and at points in every way, also with themselves.
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const TetMesh mesh = perturbed_box(kUnit, {4, 4, 4}, 0.2, seed);
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<double> v;
    for (std::size_t i = 0; i < mesh.points.size(); ++i) v.push_back(uniform(generator));
    expect_skin_of_the_band(mesh, v, 0.3 + 0.004 * seed);
  }
}

/// A mesh whose nodes are the cells' own values cannot give every set of cells; so each cell gets
/// a node of its own amid it, and the four cells around that node its value.
TEST(Band, IsManifoldForAnySetOfBricksCells) {
  const TetMesh coarse = box_mesh(kUnit, {2, 2, 2});
  TetMesh mesh{coarse.points, {}};
  for (const Cell& cell : coarse.cells) {
    Vec3 center;
    for (const Index p : cell) center += 0.25 * coarse.points[p];
    const auto node = static_cast<Index>(mesh.points.size());
    mesh.points.push_back(center);
    for (std::size_t i = 0; i < 4; ++i) {
      Cell part = cell;
      part[i] = node;
      mesh.cells.push_back(part);
    }
  }
  std::mt19937 generator(7);
  for (int round = 0; round < 300; ++round) {
    std::vector<double> v(coarse.points.size(), 0);
    for (std::size_t c = 0; c < coarse.cells.size(); ++c) {
      v.push_back(generator() % 2 == 0 ? 0 : 1);
    }
    expect_skin_of_the_band(mesh, v, 0.1);
  }
}

TEST(Band, OfEverythingIsTheBoxAndOfNothingIsEmpty) {
  const TetMesh mesh = box_mesh(kUnit, {3, 3, 3});
  const std::vector<double> v(mesh.points.size(), 0.5);
  const TriMesh whole = extract_band(mesh, v, 0.6);
  EXPECT_NEAR(check_surface(whole).volume, 1, 1e-14);
  EXPECT_NEAR(check_surface(whole).area, 6, 1e-13);
  EXPECT_TRUE(extract_band(mesh, v, 0.5).points.empty());
}

TEST(Band, RefusesValuesThatDoNotFit) {
  const TetMesh mesh = box_mesh(kUnit, {1, 1, 1});
  std::vector<double> v(8, 1);
  EXPECT_THROW(extract_band(mesh, std::span(v).first(7), 0), InputError);
  EXPECT_THROW(extract_band(mesh, v, std::nan("")), InputError);
  v[2] = std::nan("");
  EXPECT_THROW(band_cells(mesh, v, 0.5), InputError);
}

}  // namespace
}  // namespace mesamis
