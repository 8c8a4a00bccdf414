// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/working_mesh.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "mesamis/base/morton_code.h"
#include "mesamis/base/parallel.h"
#include "mesamis/remesh/geometry.h"

namespace mesamis::detail::remesh {
namespace {

/// New numbers for the items with a key; kNoIndex for the rest.
struct Renumbering {
  std::vector<Index> order;       ///< old number of each new one
  std::vector<Index> new_number;  ///< by old number
};

Renumbering renumber(std::vector<std::pair<std::uint64_t, Index>>& keys, std::size_t old_count) {
  std::sort(keys.begin(), keys.end());
  Renumbering result{{}, std::vector<Index>(old_count, kNoIndex)};
  result.order.reserve(keys.size());
  for (const auto& [key, old_number] : keys) {
    result.new_number[old_number] = static_cast<Index>(result.order.size());
    result.order.push_back(old_number);
  }
  return result;
}

void compact_vertices(WorkingMesh& mesh) {
  std::vector<std::pair<std::uint64_t, Index>> keys;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vertex& vertex = mesh.vertices[v];
    if (vertex.cell == kNoIndex) continue;
    const bool frozen = vertex.mask & kFrozen;
    const std::uint64_t key = frozen ? 0 : 1 + morton_code(mesh.box, vertex.position);
    keys.emplace_back(key, static_cast<Index>(v));
  }
  const Renumbering numbers = renumber(keys, mesh.vertices.size());
  std::vector<Vertex> vertices;
  vertices.reserve(numbers.order.size());
  for (const Index v : numbers.order) vertices.push_back(mesh.vertices[v]);
  mesh.vertices.swap(vertices);
  mesh.free_vertices.clear();
  for (WorkCell& cell : mesh.cells) {
    if (!cell.alive()) continue;
    for (Index& p : cell.points) p = numbers.new_number[p];
  }
}

/// Cells in the order of their lowest vertex; counted, not compared.
Renumbering renumber_by_first_vertex(const WorkingMesh& mesh) {
  auto first_vertex = [](const WorkCell& cell) {
    return static_cast<std::size_t>(*std::min_element(cell.points.begin(), cell.points.end()));
  };
  std::vector<Index> next(mesh.vertices.size() + 1, 0);
  for (const WorkCell& cell : mesh.cells) {
    if (cell.alive()) ++next[first_vertex(cell) + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  Renumbering result{std::vector<Index>(static_cast<std::size_t>(next.back())),
                     std::vector<Index>(mesh.cells.size(), kNoIndex)};
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    if (!mesh.cells[c].alive()) continue;
    const Index number = next[first_vertex(mesh.cells[c])]++;
    result.new_number[c] = number;
    result.order[number] = static_cast<Index>(c);
  }
  return result;
}

void compact_cells(WorkingMesh& mesh) {
  const Renumbering numbers = renumber_by_first_vertex(mesh);
  std::vector<WorkCell> cells;
  cells.reserve(numbers.order.size());
  for (const Index old_number : numbers.order) {
    WorkCell cell = mesh.cells[old_number];
    cell.mark = 0;
    for (FaceRef& n : cell.neighbors) {
      if (n != kNoIndex) n = face_ref(numbers.new_number[cell_of(n)], face_of(n));
    }
    for (const Index p : cell.points) mesh.vertices[p].cell = static_cast<Index>(cells.size());
    cells.push_back(cell);
  }
  mesh.cells.swap(cells);
  mesh.free_cells.clear();
}

}  // namespace

Index WorkingMesh::new_vertex() {
  if (!free_vertices.empty()) {
    const Index v = free_vertices.back();
    free_vertices.pop_back();
    return v;
  }
  vertices.emplace_back();
  return static_cast<Index>(vertices.size() - 1);
}

void WorkingMesh::free_vertex(Index v) {
  vertices[v].cell = kNoIndex;
  free_vertices.push_back(v);
}

Index WorkingMesh::new_cell() {
  if (!free_cells.empty()) {
    const Index c = free_cells.back();
    free_cells.pop_back();
    return c;
  }
  cells.emplace_back();
  return static_cast<Index>(cells.size() - 1);
}

void WorkingMesh::free_cell(Index c) {
  cells[c].points[0] = kNoIndex;
  free_cells.push_back(c);
}

void set_pending(WorkingMesh& mesh, std::uint8_t operations) {
  for (WorkCell& cell : mesh.cells) {
    cell.pending = static_cast<std::uint8_t>(cell.pending | operations);
    if (operations & kToSwap) cell.tried = 0;
  }
  if (!(operations & kToSmooth)) return;
  for (Vertex& vertex : mesh.vertices) vertex.failures = vertex.rest = 0;
}

WorkingMesh load(const TetMesh& start, const Box& box) {
  WorkingMesh mesh;
  mesh.box = box;
  mesh.vertices.resize(start.points.size());
  for (std::size_t v = 0; v < start.points.size(); ++v) {
    mesh.vertices[v].position = start.points[v];
    mesh.vertices[v].mask = planes_of(box, start.points[v]);
  }
  const auto neighbors = cell_neighbors(start);
  mesh.cells.resize(start.cells.size());
  for (std::size_t c = 0; c < start.cells.size(); ++c) {
    const auto cell = static_cast<Index>(c);
    mesh.cells[c].points = start.cells[c];
    for (int f = 0; f < 4; ++f) {
      const Index n = neighbors[c][f];
      if (n == kNoIndex) continue;
      const auto& back = neighbors[n];
      const auto mirror = std::find(back.begin(), back.end(), cell) - back.begin();
      mesh.cells[c].neighbors[f] = face_ref(n, static_cast<int>(mirror));
    }
    for (const Index p : start.cells[c]) mesh.vertices[p].cell = cell;
  }
  return mesh;
}

void measure_all(WorkingMesh& mesh, const MetricSampler& sampler) {
  // Neighbours on the Morton curve hand their hint on; blocks are fixed, so the hints are too.
  parallel_blocks(mesh.vertices.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    Index hint = 0;
    for (std::size_t v = begin; v < end; ++v) {
      Vertex& vertex = mesh.vertices[v];
      measure(vertex, sampler, hint);
      hint = vertex.hint;
    }
  });
  parallel_for(mesh.cells.size(), [&](std::size_t c) {
    mesh.cells[c].quality3 = static_cast<float>(quality3(mesh, mesh.cells[c].points));
  });
}

void compact(WorkingMesh& mesh) {
  compact_vertices(mesh);
  compact_cells(mesh);
}

TetMesh unload(const WorkingMesh& mesh) {
  TetMesh result;
  result.points.reserve(mesh.vertices.size());
  for (const Vertex& vertex : mesh.vertices) result.points.push_back(vertex.position);
  result.cells.reserve(mesh.cells.size());
  for (const WorkCell& cell : mesh.cells) result.cells.push_back(cell.points);
  return result;
}

}  // namespace mesamis::detail::remesh
