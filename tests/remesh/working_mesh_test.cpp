// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/working_mesh.h"

#include <random>
#include <set>

#include "mesamis/mesh/metric.h"
#include "remesh/small_mesh.h"

namespace mesamis {
namespace {

const FormulaMetric kUniform = uniform_metric(0.3);

/// Cells as sets of the positions of their corners: what a mesh is whatever its numbers.
std::set<std::set<std::array<double, 3>>> cells_in_space(const TetMesh& mesh) {
  std::set<std::set<std::array<double, 3>>> cells;
  for (const Cell& cell : mesh.cells) {
    std::set<std::array<double, 3>> corners;
    for (const Vec3& p : cell_corners(mesh, cell)) corners.insert({p.x, p.y, p.z});
    cells.insert(corners);
  }
  return cells;
}

TEST(WorkingMesh, LoadsAndUnloadsTheSameMesh) {
  const TetMesh mesh = perturbed_box(kUnitBox, {3, 4, 5}, 0.2);
  const WorkingMesh work = load(mesh, kUnitBox);
  expect_neighbors_right(work);
  EXPECT_EQ(unload(work).points, mesh.points);
  EXPECT_EQ(unload(work).cells, mesh.cells);
  EXPECT_EQ(work.vertex_count(), std::ssize(mesh.points));
  EXPECT_EQ(work.cell_count(), std::ssize(mesh.cells));
}

TEST(WorkingMesh, CompactKeepsTheMeshAndDropsUnusedSlots) {
  SmallMesh small(perturbed_box(kUnitBox, {4, 4, 4}, 0.2), kUniform);
  const auto before = cells_in_space(unload(small.mesh));
  // Slots in no order: each of the first is copied to a new slot.
  for (Index c = 0; c < 40; ++c) {
    const Index copy = small.mesh.new_cell();
    small.mesh.cells[copy] = small.mesh.cells[c];
    for (int f = 0; f < 4; ++f) {
      const FaceRef n = small.mesh.cells[c].neighbors[f];
      if (n != kNoIndex) small.mesh.cells[cell_of(n)].neighbors[face_of(n)] = face_ref(copy, f);
    }
    for (const Index v : small.mesh.cells[copy].points) small.mesh.vertices[v].cell = copy;
    small.mesh.free_cell(c);
    small.mesh.free_cells.clear();  // so that the next copy takes a new slot
  }
  compact(small.mesh);
  EXPECT_TRUE(small.mesh.free_cells.empty());
  expect_sound(small.mesh);
  EXPECT_EQ(cells_in_space(unload(small.mesh)), before);
}

TEST(WorkingMesh, CompactNumbersNearVerticesNearly) {
  SmallMesh small(box_mesh(kUnitBox, {16, 16, 16}), kUniform);
  std::mt19937 generator(1);
  TetMesh shuffled = unload(small.mesh);
  std::vector<Index> order(shuffled.points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Index>(i);
  std::shuffle(order.begin(), order.end(), generator);
  const std::vector<Vec3> points = shuffled.points;
  for (std::size_t i = 0; i < order.size(); ++i) shuffled.points[order[i]] = points[i];
  for (Cell& cell : shuffled.cells) {
    for (Index& p : cell) p = order[p];
  }
  WorkingMesh work = load(shuffled, kUnitBox);
  const auto mean_step = [](const TetMesh& mesh) {
    double sum = 0;
    for (std::size_t i = 1; i < mesh.points.size(); ++i) {
      sum += norm(mesh.points[i] - mesh.points[i - 1]);
    }
    return sum / static_cast<double>(mesh.points.size());
  };
  compact(work);
  EXPECT_LT(mean_step(unload(work)), 0.25 * mean_step(shuffled));
  EXPECT_EQ(cells_in_space(unload(work)), cells_in_space(shuffled));
}

TEST(WorkingMesh, FrozenVerticesComeFirstInTheirOrder) {
  SmallMesh small(box_mesh(kUnitBox, {3, 3, 3}), kUniform);
  std::vector<Vec3> frozen;
  for (const Index v : {9, 40, 2, 63}) {
    small.mesh.vertices[v].mask |= kFrozen;
  }
  for (const Index v : {2, 9, 40, 63}) frozen.push_back(small.mesh.vertices[v].position);
  compact(small.mesh);
  for (std::size_t v = 0; v < small.mesh.vertices.size(); ++v) {
    EXPECT_EQ((small.mesh.vertices[v].mask & kFrozen) != 0, v < frozen.size());
    if (v < frozen.size()) {
      EXPECT_EQ(small.mesh.vertices[v].position, frozen[v]);
    }
  }
}

TEST(WorkingMesh, UsesFreedSlotsAgain) {
  WorkingMesh work = load(box_mesh(kUnitBox, {1, 1, 1}), kUnitBox);
  const auto cells = work.cell_count(), vertices = work.vertex_count();
  work.free_cell(2);
  work.free_vertex(1);
  EXPECT_EQ(work.cell_count(), cells - 1);
  EXPECT_EQ(work.vertex_count(), vertices - 1);
  EXPECT_EQ(work.new_cell(), 2);
  EXPECT_EQ(work.new_vertex(), 1);
  EXPECT_EQ(work.new_cell(), cells);
  EXPECT_EQ(work.new_vertex(), vertices);
}

TEST(TakePending, TicksACellOffOnceUnlessAVertexIsFrozen) {
  WorkingMesh work = load(box_mesh(kUnitBox, {1, 1, 1}), kUnitBox);
  EXPECT_TRUE(take_pending(work, 0, kToSwap));
  EXPECT_FALSE(take_pending(work, 0, kToSwap));
  EXPECT_TRUE(take_pending(work, 0, kToSmooth));
  set_pending(work, kToSwap);
  EXPECT_TRUE(take_pending(work, 0, kToSwap));
  work.is_part = true;
  work.vertices[work.cells[1].points[2]].mask |= kFrozen;
  EXPECT_TRUE(take_pending(work, 1, kToSplit));
  EXPECT_TRUE(take_pending(work, 1, kToSplit));
  work.free_cell(3);
  EXPECT_FALSE(take_pending(work, 3, kToSplit));
}

TEST(WorkingMesh, MeasuresQualitiesAndMetrics) {
  const TetMesh mesh = perturbed_box(kUnitBox, {3, 3, 3}, 0.2);
  const SmallMesh small(mesh, kUniform);
  const Sym3 metric = 1 / 0.09 * kIdentity3;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const double quality = metric_quality(metric, cell_corners(mesh, mesh.cells[c]));
    EXPECT_NEAR(small.mesh.cells[c].quality3, std::pow(quality, 3), 1e-5);
  }
  for (const Vertex& v : small.mesh.vertices) EXPECT_NEAR(v.density, std::pow(0.3, -3), 1e-4);
}

}  // namespace
}  // namespace mesamis
