// SPDX-License-Identifier: Apache-2.0
#include "mesamis/mesh/tet_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "mesamis/base/error.h"
#include "mesamis/mesh/edges.h"
#include "mesamis/mesh/predicates.h"
#include "support/perturbed_box.h"

namespace mesamis {
namespace {

using testing::HasSubstr;

const Box kBox{{-1, 2, 0.5}, {2, 4, 1.25}};

TEST(BoxMesh, IsValidAndHasSixCellsPerBrick) {
  const TetMesh mesh = box_mesh(kBox, {3, 4, 5});
  EXPECT_EQ(find_flaw(mesh, kBox), "");
  EXPECT_EQ(mesh.cells.size(), 6u * 3 * 4 * 5);
  EXPECT_EQ(bounding_box(mesh.points), kBox);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    EXPECT_NEAR(cell_volume(mesh, static_cast<Index>(c)), kBox.volume() / 360, 1e-14);
  }
}

TEST(BoxMesh, RefusesWhatHasNoBricks) {
  EXPECT_THROW(box_mesh(kBox, {0, 1, 1}), InputError);
  EXPECT_THROW(box_mesh({{0, 0, 0}, {1, 0, 1}}, {1, 1, 1}), InputError);
  EXPECT_THROW(box_mesh(kBox, {1000, 1000, 1000}), InputError);
}

TEST(PlanesOf, AreABitEach) {
  const Box box{{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(planes_of(box, {1, 2, 3}), 0);
  EXPECT_EQ(planes_of(box, {0, 2, 3}), 1);
  EXPECT_EQ(planes_of(box, {3, 2, 3}), 2);
  EXPECT_EQ(planes_of(box, {1, 1, 3}), 4);
  EXPECT_EQ(planes_of(box, {1, 4, 3}), 8);
  EXPECT_EQ(planes_of(box, {1, 2, 2}), 16);
  EXPECT_EQ(planes_of(box, {1, 2, 5}), 32);
  EXPECT_EQ(planes_of(box, {3, 4, 2}), 2 + 8 + 16);
  EXPECT_EQ(planes_of(box, {std::nextafter(3.0, 0), 2, 3}), 0);
}

TEST(Edges, FulfilEulersFormulaOfABall) {
  const TetMesh mesh = perturbed_box(kBox, {3, 2, 4}, 0.2);
  std::size_t inner = 0, outer = 0;
  for (const auto& neighbors : cell_neighbors(mesh)) {
    for (const Index n : neighbors) ++(n == kNoIndex ? outer : inner);
  }
  const auto edges = unique_edges(mesh);
  const std::size_t faces = inner / 2 + outer;
  EXPECT_EQ(mesh.points.size() + faces, edges.size() + mesh.cells.size() + 1);
  EXPECT_TRUE(std::is_sorted(edges.begin(), edges.end()));
  EXPECT_EQ(std::set<Edge>(edges.begin(), edges.end()).size(), edges.size());
}

TEST(Neighbors, ShareTheFaceOppositeTheVertex) {
  const TetMesh mesh = perturbed_box(kBox, {3, 3, 3}, 0.2);
  const auto neighbors = cell_neighbors(mesh);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    for (std::size_t i = 0; i < 4; ++i) {
      if (neighbors[c][i] == kNoIndex) continue;
      const auto other = static_cast<std::size_t>(neighbors[c][i]);
      EXPECT_THAT(neighbors[other], testing::Contains(static_cast<Index>(c)));
      for (const int local : kCellFaces[i]) {
        EXPECT_THAT(mesh.cells[other],
                    testing::Contains(mesh.cells[c][static_cast<std::size_t>(local)]));
      }
      EXPECT_THAT(mesh.cells[other], testing::Not(testing::Contains(mesh.cells[c][i])));
    }
  }
}

TEST(Neighbors, RefuseAFaceOfThreeCells) {
  TetMesh mesh = box_mesh(kBox, {1, 1, 1});
  mesh.cells.push_back(mesh.cells[0]);
  mesh.cells.push_back(mesh.cells[0]);
  EXPECT_THROW(cell_neighbors(mesh), InputError);
}

TEST(CellFaces, TurnOutwards) {
  const std::array<Vec3, 4> p{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  ASSERT_GT(six_volume(p[0], p[1], p[2], p[3]), 0);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& f = kCellFaces[i];
    const Vec3 a = p[static_cast<std::size_t>(f[0])], b = p[static_cast<std::size_t>(f[1])],
               c = p[static_cast<std::size_t>(f[2])];
    EXPECT_LT(dot(cross(b - a, c - a), p[i] - a), 0) << "face " << i;
  }
}

TEST(PointCells, AreTheCellsThatNameThePoint) {
  const TetMesh mesh = box_mesh(kBox, {2, 3, 2});
  const PointCells around = point_cells(mesh);
  for (Index n = 0; n < static_cast<Index>(mesh.points.size()); ++n) {
    std::vector<Index> expected;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
      const Cell& k = mesh.cells[c];
      if (std::find(k.begin(), k.end(), n) != k.end()) expected.push_back(static_cast<Index>(c));
    }
    EXPECT_THAT(around.of(n), testing::ElementsAreArray(expected));
  }
}

/// What find_flaw says of a small mesh after something was done to it.
template <class Damage>
std::string flaw_after(Damage&& damage) {
  TetMesh mesh = perturbed_box(kBox, {3, 3, 3}, 0.1);
  damage(mesh);
  return find_flaw(mesh, kBox);
}

TEST(FindFlaw, NamesWhatIsWrong) {
  EXPECT_EQ(flaw_after([](TetMesh&) {}), "");
  EXPECT_THAT(flaw_after([](TetMesh& m) {
                m.points.push_back({0, 3, 1});
              }),
              HasSubstr("belongs to no cell"));
  EXPECT_THAT(flaw_after([](TetMesh& m) { m.points[0].x -= 1; }), HasSubstr("inside the box"));
  EXPECT_THAT(flaw_after([](TetMesh& m) { m.points[30].y = std::nan(""); }), HasSubstr("point 30"));
  EXPECT_THAT(flaw_after([](TetMesh& m) { std::swap(m.cells[7][0], m.cells[7][1]); }),
              HasSubstr("cell 7"));
  EXPECT_THAT(flaw_after([](TetMesh& m) { m.cells[5][2] = 100000; }), HasSubstr("cell 5"));
  EXPECT_THAT(flaw_after([](TetMesh& m) { m.cells[5][2] = -1; }), HasSubstr("cell 5"));
  EXPECT_THAT(flaw_after([](TetMesh& m) { m.cells.pop_back(); }), HasSubstr("one cell"));
  EXPECT_THAT(flaw_after([](TetMesh& m) { m.cells.push_back(m.cells[80]); }),
              HasSubstr("shared by 3"));
  EXPECT_THAT(flaw_after([](TetMesh& m) { m.points[1].z += 1e-9; }),
              HasSubstr("does not lie on the box"));
}

TEST(FindFlaw, MakesValidateThrow) {
  TetMesh mesh = box_mesh(kBox, {1, 1, 1});
  EXPECT_NO_THROW(validate(mesh, kBox));
  mesh.cells.pop_back();
  EXPECT_THROW(validate(mesh, kBox), NumericalError);
}

TEST(Predicates, NeverCertifyWhatIsNotPositive) {
  // Whole numbers, so that the exact sign is known; nearly flat, so that it is hard to see.
  std::mt19937 generator(1);
  std::uniform_int_distribution<std::int64_t> coordinate(-(1 << 18), 1 << 18), nudge(-1, 1);
  using Point = std::array<std::int64_t, 3>;
  auto to_vec = [](const Point& p) {
    return Vec3{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
  };
  int certified = 0;
  for (int trial = 0; trial < 100'000; ++trial) {
    Point q{}, r{}, s{};
    for (std::size_t i = 0; i < 3; ++i) {
      q[i] = coordinate(generator);
      r[i] = coordinate(generator);
      s[i] = (q[i] + r[i]) / 2 + nudge(generator);
    }
    const std::int64_t exact = q[0] * (r[1] * s[2] - r[2] * s[1]) -
                               q[1] * (r[0] * s[2] - r[2] * s[0]) +
                               q[2] * (r[0] * s[1] - r[1] * s[0]);
    if (!certified_positive({0, 0, 0}, to_vec(q), to_vec(r), to_vec(s))) continue;
    ASSERT_GT(exact, 0);
    ++certified;
  }
  EXPECT_GT(certified, 10'000);
}

TEST(Predicates, CertifyAnyClearlyPositiveCell) {
  for (const double scale : {1e-30, 1.0, 1e30}) {
    EXPECT_TRUE(certified_positive({0, 0, 0}, {scale, 0, 0}, {0, scale, 0}, {0, 0, scale}));
    EXPECT_FALSE(certified_positive({0, 0, 0}, {0, scale, 0}, {scale, 0, 0}, {0, 0, scale}));
  }
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(certified_positive({0, 0, kNaN}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}));
}

}  // namespace
}  // namespace mesamis
