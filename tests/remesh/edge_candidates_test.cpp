// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/edge_candidates.h"

#include <map>
#include <utility>

#include "mesamis/mesh/edges.h"
#include "remesh/small_mesh.h"

namespace mesamis {
namespace {

const FormulaMetric kGraded([](const Vec3& p) {
  const double h = 0.1 * std::exp(1.5 * p.x);
  return Sym3{1 / (h * h), 0, 0, 1 / (h * h), 0, 4 / (h * h)};
});

/// Lengths of the edges that `accept` takes.
template <class Accept>
std::map<Edge, double> lengths_of_edges(const WorkingMesh& mesh, Accept accept) {
  std::map<Edge, double> lengths;
  for (const auto& [a, b] : unique_edges(unload(mesh))) {
    const double l = length(mesh.vertices[a], mesh.vertices[b]);
    if (accept(l)) lengths[{a, b}] = l;
  }
  return lengths;
}

/// Each edge once for every cell around it, its copies side by side.
void expect_edges(const WorkingMesh& mesh, const std::vector<EdgeCandidate>& found,
                  const std::map<Edge, double>& expected) {
  std::map<Edge, int> copies;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const EdgeCandidate& e = found[i];
    ASSERT_EQ(expected.count({e.a, e.b}), 1u);
    EXPECT_FLOAT_EQ(e.length, static_cast<float>(expected.at({e.a, e.b})));
    EXPECT_FALSE(e.is_gone(mesh));
    const bool is_new = i == 0 || !e.is_same_edge(found[i - 1]);
    if (is_new) {
      EXPECT_EQ(copies.count({e.a, e.b}), 0u);
    }
    ++copies[{e.a, e.b}];
  }
  EXPECT_EQ(copies.size(), expected.size());
  for (const auto& [edge, count] : copies) {
    int around = 0;
    for (const WorkCell& cell : mesh.cells) {
      around += local_index(cell.points, edge[0]) >= 0 && local_index(cell.points, edge[1]) >= 0;
    }
    EXPECT_EQ(count, around);
  }
}

TEST(EdgeCandidates, AreTheEdgesBeyondTheLimitInOrder) {
  SmallMesh small(perturbed_box(kUnitBox, {4, 4, 4}, 0.2), kGraded);
  constexpr double kLong = 2, kShort = 1;
  const auto longer = long_edges(small.mesh, kLong);
  const auto shorter = short_edges(small.mesh, kShort);
  expect_edges(small.mesh, longer,
               lengths_of_edges(small.mesh, [](double l) { return l > kLong; }));
  expect_edges(small.mesh, shorter,
               lengths_of_edges(small.mesh, [](double l) { return l < kShort; }));
  const auto by_length = [](const EdgeCandidate& x, const EdgeCandidate& y) {
    return x.length < y.length;
  };
  EXPECT_TRUE(std::is_sorted(shorter.begin(), shorter.end(), by_length));
  EXPECT_TRUE(std::is_sorted(longer.rbegin(), longer.rend(), by_length));
  EXPECT_FALSE(longer.empty());
  EXPECT_FALSE(shorter.empty());
}

TEST(EdgeCandidates, ComeFromCellsThatWaitAndOnlyOnce) {
  SmallMesh small(box_mesh(kUnitBox, {2, 2, 2}), kGraded);
  EXPECT_FALSE(long_edges(small.mesh, 0.01).empty());
  EXPECT_TRUE(long_edges(small.mesh, 0.01).empty());
  EXPECT_FALSE(short_edges(small.mesh, 100).empty());  // another list
  small.mesh.cells[3].pending = kToSplit;
  const auto again = long_edges(small.mesh, 0.01);
  EXPECT_EQ(again.size(), 6u);
  for (const EdgeCandidate& e : again) EXPECT_EQ(e.cell, 3);
}

TEST(EdgeCandidates, AreGoneWithTheirCell) {
  SmallMesh small(box_mesh(kUnitBox, {1, 1, 1}), kGraded);
  const auto edges = long_edges(small.mesh, 0.01);
  const Index cell = edges[0].cell;
  small.mesh.free_cell(cell);
  for (const EdgeCandidate& e : edges) EXPECT_EQ(e.is_gone(small.mesh), e.cell == cell);
}

}  // namespace
}  // namespace mesamis
