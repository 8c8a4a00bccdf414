// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "mesamis/remesh/geometry.h"
#include "mesamis/remesh/workbench.h"
#include "mesamis/remesh/working_mesh.h"
#include "support/metric_fields.h"
#include "support/perturbed_box.h"

namespace mesamis {

/// A small mesh on the bench, ready for single operations.
struct SmallMesh {
  SmallMesh(const TetMesh& start, const MetricField& field)
      : sampler(field, bounding_box(start.points)),
        mesh(load(start, bounding_box(start.points))),
        bench(mesh, sampler) {
    measure_all(mesh, sampler);
  }
  MetricSampler sampler;
  WorkingMesh mesh;
  Workbench bench;
};

inline void expect_neighbors_right(const WorkingMesh& mesh) {
  for (Index c = 0; c < std::ssize(mesh.cells); ++c) {
    const WorkCell& cell = mesh.cells[c];
    if (!cell.alive()) continue;
    for (int f = 0; f < 4; ++f) {
      const FaceRef n = cell.neighbors[f];
      if (n == kNoIndex) continue;
      const WorkCell& other = mesh.cells[cell_of(n)];
      ASSERT_TRUE(other.alive());
      ASSERT_EQ(other.neighbors[face_of(n)], face_ref(c, f));
      for (const int i : kCellFaces[f]) {
        ASSERT_NE(local_index(other.points, cell.points[i]), face_of(n));
        ASSERT_GE(local_index(other.points, cell.points[i]), 0);
      }
    }
  }
}

/// The working mesh is a valid mesh of its box, and all that it keeps beside it is right.
inline void expect_sound(const WorkingMesh& mesh) {
  expect_neighbors_right(mesh);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vertex& vertex = mesh.vertices[v];
    if (vertex.cell == kNoIndex) continue;
    ASSERT_GE(local_index(mesh.cells[vertex.cell].points, static_cast<Index>(v)), 0);
    ASSERT_EQ(vertex.mask, planes_of(mesh.box, vertex.position));
  }
  for (const WorkCell& cell : mesh.cells) {
    if (!cell.alive()) continue;
    ASSERT_FLOAT_EQ(cell.quality3, static_cast<float>(quality3(mesh, cell.points)));
  }
  WorkingMesh copy = mesh;
  compact(copy);
  ASSERT_EQ(find_flaw(unload(copy), mesh.box), "");
}

/// A cell that has both points.
inline Index cell_with(const WorkingMesh& mesh, Index a, Index b) {
  for (Index c = 0; c < std::ssize(mesh.cells); ++c) {
    const Cell& points = mesh.cells[c].points;
    if (mesh.cells[c].alive() && local_index(points, a) >= 0 && local_index(points, b) >= 0)
      return c;
  }
  return kNoIndex;
}

inline double worst_quality3(const WorkingMesh& mesh) {
  double worst = 1;
  for (const WorkCell& cell : mesh.cells) {
    if (cell.alive()) worst = std::min(worst, double{cell.quality3});
  }
  return worst;
}

inline double total_energy(const WorkingMesh& mesh) {
  double sum = 0;
  for (const WorkCell& cell : mesh.cells) {
    if (cell.alive()) sum += energy(cell.quality3);
  }
  return sum;
}

}  // namespace mesamis
