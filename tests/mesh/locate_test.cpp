// SPDX-License-Identifier: Apache-2.0
#include "mesamis/mesh/locate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "mesamis/mesh/region.h"
#include "support/perturbed_box.h"

namespace mesamis {
namespace {

class Points {
 public:
  explicit Points(const Box& box, unsigned seed) : box_(box), generator_(seed) {}
  Vec3 next() {
    std::uniform_real_distribution<double> uniform(0, 1);
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = box_.lo[axis] + uniform(generator_) * box_.extent()[axis];
    }
    return p;
  }

 private:
  Box box_;
  std::mt19937 generator_;
};

Vec3 place(const TetMesh& mesh, const Location& where) {
  Vec3 p;
  for (std::size_t i = 0; i < 4; ++i) {
    const Index n = mesh.cells[static_cast<std::size_t>(where.cell)][i];
    p += where.weights[i] * mesh.points[static_cast<std::size_t>(n)];
  }
  return p;
}

void expect_convex(const Location& where) {
  for (const double w : where.weights) EXPECT_GE(w, 0);
  EXPECT_NEAR(std::accumulate(where.weights.begin(), where.weights.end(), 0.0), 1, 1e-12);
}

TEST(Locate, FindsPointsFromAnyStartOnFlatCells) {
  // Sizes 1000 : 30 : 1.
  const Box box{{0, 0, 0}, {5000, 150, 5}};
  const TetMesh mesh = perturbed_box(box, {5, 5, 5}, 0.3);
  const auto neighbors = cell_neighbors(mesh);
  Points points(box, 1);
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 p = points.next();
    for (Index start = 0; start < static_cast<Index>(mesh.cells.size()); start += 97) {
      const Location where = locate(mesh, neighbors, p, start);
      expect_convex(where);
      const Vec3 found = place(mesh, where);
      EXPECT_NEAR(found.x, p.x, 1e-6);
      EXPECT_NEAR(found.y, p.y, 1e-6);
      EXPECT_NEAR(found.z, p.z, 1e-6);
    }
  }
}

TEST(Locate, FindsTheVertices) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  const TetMesh mesh = perturbed_box(box, {3, 3, 3}, 0.2);
  const auto neighbors = cell_neighbors(mesh);
  for (const Vec3& p : mesh.points) {
    const Location where = locate(mesh, neighbors, p, 0);
    EXPECT_NEAR(norm(place(mesh, where) - p), 0, 1e-9);
    EXPECT_NEAR(*std::max_element(where.weights.begin(), where.weights.end()), 1, 1e-8);
  }
}

TEST(Locate, GivesAPointOfTheMeshForOneOutside) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  const TetMesh mesh = perturbed_box(box, {3, 3, 3}, 0.2);
  const auto neighbors = cell_neighbors(mesh);
  for (const Vec3& p : {Vec3{-5, 0.5, 0.5}, Vec3{0.3, 0.3, 1.01}, Vec3{2, 2, 2}}) {
    const Location where = locate(mesh, neighbors, p, 40);
    ASSERT_GE(where.cell, 0);
    expect_convex(where);
  }
  // Just outside a face the answer is the point below it, not somewhere else in the box.
  const Location close = locate(mesh, neighbors, {0.4, 0.6, 1 + 1e-6}, 0);
  EXPECT_NEAR(norm(place(mesh, close) - Vec3{0.4, 0.6, 1}), 0, 1e-5);
}

TEST(LocateInPiece, FindsPointsBehindANotch) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  const TetMesh whole = perturbed_box(box, {6, 6, 6}, 0.3);
  std::vector<Index> kept;
  for (Index c = 0; c < std::ssize(whole.cells); ++c) {
    Vec3 middle;
    for (const Index n : whole.cells[c]) middle += 0.25 * whole.points[n];
    if (middle.x > 0.4 || middle.z < 0.4) kept.push_back(c);
  }
  const TetMesh piece = restrict_mesh(whole, kept).mesh;
  const auto all = cell_neighbors(whole), some = cell_neighbors(piece);
  Points points(box, 3);
  int inside = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Vec3 p = points.next();
    const Location here = locate(whole, all, p, 0);
    const Location found = locate_in_piece(piece, some, p, trial);
    expect_convex(found);
    if (!std::binary_search(kept.begin(), kept.end(), here.cell)) continue;
    ++inside;
    EXPECT_EQ(kept[found.cell], here.cell);
    EXPECT_LT(norm(place(piece, found) - p), 1e-9);
  }
  EXPECT_GT(inside, 200);
}

}  // namespace
}  // namespace mesamis
