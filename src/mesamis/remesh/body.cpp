// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/body.h"

#include <algorithm>
#include <string>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/base/stopwatch.h"
#include "mesamis/remesh/edge_candidates.h"
#include "mesamis/remesh/remesher.h"
#include "mesamis/remesh/skin.h"
#include "mesamis/remesh/split.h"

namespace mesamis {
namespace {

using namespace remeshing;

/// An edge whose ends are of different materials, and where it leaves the first's.
struct Crossing {
  Index a, b, cell;
  double share = 0;
};

std::vector<Material> vertex_materials(const WorkingMesh& mesh) {
  std::vector<Material> materials(mesh.vertices.size());
  parallel_for(materials.size(), [&](std::size_t v) {
    materials[v] = mesh.shape->material_at(mesh.vertices[v].position);
  });
  return materials;
}

/// Each edge between two materials once, with the first of its cells.
std::vector<Crossing> find_crossings(const WorkingMesh& mesh,
                                     const std::vector<Material>& materials) {
  std::vector<Crossing> crossings;
  for (Index c = 0; c < std::ssize(mesh.cells); ++c) {
    for (const auto& [i, j] : kCellEdges) {
      const auto [a, b] = std::minmax(mesh.cells[c].points[i], mesh.cells[c].points[j]);
      if (materials[a] != materials[b]) crossings.push_back({a, b, c});
    }
  }
  auto key = [](const Crossing& x) { return std::tie(x.a, x.b, x.cell); };
  std::sort(crossings.begin(), crossings.end(),
            [&](const Crossing& x, const Crossing& y) { return key(x) < key(y); });
  const auto last =
      std::unique(crossings.begin(), crossings.end(),
                  [](const Crossing& x, const Crossing& y) { return x.a == y.a && x.b == y.b; });
  crossings.erase(last, crossings.end());
  parallel_for(crossings.size(), [&](std::size_t i) {
    Crossing& x = crossings[i];
    x.share = mesh.shape->crossing(mesh.vertices[x.a].position, mesh.vertices[x.b].position);
  });
  return crossings;
}

/// A cell of the edge (a, b): the cell it was found in, or one that has taken its place.
Index find_cell(Workbench& bench, const Crossing& x) {
  for (const Index c : bench.cavity.ball(x.a)) {
    if (local_index(bench.mesh.cells[c].points, x.b) >= 0) return c;
  }
  throw NumericalError("remesh_body: an edge of the start mesh was lost");
}

/// Splits the edges between two materials. No cell has two vertices of different materials then,
/// but for those on the skin, which have none; and each cell keeps one that has.
void split_crossings(Workbench& bench, const std::vector<Crossing>& crossings) {
  for (const Crossing& x : crossings) {
    split_edge_at(bench, {find_cell(bench, x), x.a, x.b}, x.share);
  }
}

/// A cell is of the material of its vertices off the skin.
void set_cell_materials(WorkingMesh& mesh, const std::vector<Material>& materials) {
  for (WorkCell& cell : mesh.cells) {
    cell.material = kOutside;
    for (const Index p : cell.points) {
      if (mesh.vertices[p].mask & kOnSkin) continue;
      cell.material = std::max(cell.material, materials[p]);
    }
  }
}

void drop_outside(WorkingMesh& mesh) {
  for (Vertex& vertex : mesh.vertices) vertex.cell = kNoIndex;
  for (Index c = 0; c < std::ssize(mesh.cells); ++c) {
    WorkCell& cell = mesh.cells[c];
    if (cell.material == kOutside) {
      mesh.free_cell(c);
      continue;
    }
    for (FaceRef& n : cell.neighbors) {
      if (n != kNoIndex && mesh.cells[cell_of(n)].material == kOutside) n = kNoIndex;
    }
    for (const Index p : cell.points) mesh.vertices[p].cell = c;
  }
  for (Index v = 0; v < std::ssize(mesh.vertices); ++v) {
    if (mesh.vertices[v].cell == kNoIndex) mesh.free_vertices.push_back(v);
  }
  if (mesh.cell_count() == 0) {
    throw InputError("body: expected an object that fills at least one element, found none");
  }
}

/// The start mesh without what lies outside.
WorkingMesh cut(const TetMesh& start, const Box& box, const BodyShape& shape,
                const MetricSampler& sampler) {
  WorkingMesh mesh = load(start, box);
  mesh.shape = &shape;
  measure_all(mesh, sampler);
  const auto materials = vertex_materials(mesh);
  const auto crossings = find_crossings(mesh, materials);
  Workbench bench(mesh, sampler);
  split_crossings(bench, crossings);
  set_cell_materials(mesh, materials);
  drop_outside(mesh);
  return mesh;
}

BodyMesh unload_body(const WorkingMesh& mesh) {
  BodyMesh body{unload(mesh), {}};
  body.materials.reserve(mesh.cells.size());
  for (const WorkCell& cell : mesh.cells) body.materials.push_back(cell.material);
  return body;
}

}  // namespace

BodyMesh remesh_body(const TetMesh& start, const MetricField& metric, const BodyShape& shape,
                     const RemeshOptions& options) {
  Stopwatch watch;
  const Box box = bounding_box(start.points);
  const std::string flaw = find_flaw(start, box);
  if (!flaw.empty()) throw InputError("remesh_body: the start mesh is not valid: " + flaw);
  const MetricSampler sampler(metric, box);
  Remesher remesher(cut(start, box, shape, sampler), sampler, options);
  remesher.adapt();
  remesher.polish();
  remesher.repair();
  BodyMesh body = unload_body(remesher.result());
  body.report = remesher.report();
  body.report.seconds = watch.lap();
  return body;
}

}  // namespace mesamis
