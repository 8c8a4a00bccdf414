// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/remesh/metric_sampler.h"

/// The remesher's own mesh: data that changes often lies close together in memory.
namespace mesamis::detail::remesh {
class BodyShape;
}

namespace mesamis::detail::remesh {

/// Bits of Vertex::mask: the planes of the box that hold the vertex, see planes_of().
inline constexpr std::uint8_t kPlanes = 0x3f;
/// The vertex is on the skin of a body, see skin.h; never again off it once it is there.
inline constexpr std::uint8_t kOnSkin = 0x40;
/// The vertex is shared with another part and must not change now.
inline constexpr std::uint8_t kFrozen = 0x80;

/// Bits of WorkCell::pending: the operations that have not tried the cell since it was made.
inline constexpr std::uint8_t kToSplit = 1, kToCollapse = 2, kToSwap = 4, kToSmooth = 8,
                              kToExplore = 16, kToRepair = 32, kToAll = 63;

struct alignas(64) Vertex {
  Vec3 position;
  MetricFactor metric;
  float density = 0;      ///< sqrt(det M), to find a cell's finest vertex
  Index cell = kNoIndex;  ///< one of the cells around it; kNoIndex: unused slot
  Index hint = 0;         ///< where the metric field found it
  std::uint8_t mask = 0;
  /// Smoothing's: how often in a row no better place was found since a cell around the vertex was
  /// made, and for how many requests it rests.
  std::uint8_t failures = 0, rest = 0;
};

/// A face as seen from one of its cells: 4 * cell + local face, or kNoIndex.
using FaceRef = Index;
inline constexpr Index cell_of(FaceRef face) { return face >> 2; }
inline constexpr int face_of(FaceRef face) { return face & 3; }
inline constexpr FaceRef face_ref(Index cell, int face) { return 4 * cell + face; }
/// The most cells that a FaceRef can number.
inline constexpr std::int64_t kMostCells = (std::int64_t{1} << 29) - 1;

struct WorkCell {
  Cell points{kNoIndex, kNoIndex, kNoIndex, kNoIndex};  ///< points[0] == kNoIndex: unused slot
  std::array<FaceRef, 4> neighbors{kNoIndex, kNoIndex, kNoIndex, kNoIndex};
  float quality3 = 0;      ///< cube of the mean ratio in the metric
  std::uint32_t mark = 0;  ///< Cavity's
  std::uint8_t pending = kToAll;
  std::uint8_t material = 1;  ///< of a body: see Material; 1 where there is no body
  /// Swap's: bit e, the removal of edge e was found useless; bit 6 + f, that of face f. Holds
  /// until a cell around the edge or face changes, which then is new and tries again itself.
  std::uint16_t tried = 0;

  bool alive() const { return points[0] != kNoIndex; }
};

/// Local index of a point in a cell, or -1.
inline int local_index(const Cell& cell, Index point) {
  for (int i = 0; i < 4; ++i) {
    if (cell[i] == point) return i;
  }
  return -1;
}

struct WorkingMesh {
  Box box;
  std::vector<Vertex> vertices;
  std::vector<WorkCell> cells;
  std::vector<Index> free_vertices, free_cells;
  bool is_part = false;  ///< some vertices may be frozen, and faces between them have one side
  /// Of a body: where its skin is kept. The cells outside it, of material kOutside, are there as
  /// well: the cells fill the box, so that the skin cannot pass through itself.
  const BodyShape* shape = nullptr;

  std::int64_t vertex_count() const { return std::ssize(vertices) - std::ssize(free_vertices); }
  std::int64_t cell_count() const { return std::ssize(cells) - std::ssize(free_cells); }
  Index new_vertex();
  void free_vertex(Index v);
  Index new_cell();
  void free_cell(Index c);
};

/// Whether the operation has not tried this cell since it was made; clears the cell's bit. Cells at
/// a frozen vertex keep the bit, since not every operation is possible there.
inline bool take_pending(WorkingMesh& mesh, Index cell, std::uint8_t operation) {
  WorkCell& c = mesh.cells[cell];
  if (!c.alive() || !(c.pending & operation)) return false;
  auto is_frozen = [&mesh](Index p) { return mesh.vertices[p].mask & kFrozen; };
  if (!mesh.is_part || std::none_of(c.points.begin(), c.points.end(), is_frozen)) {
    c.pending = static_cast<std::uint8_t>(c.pending & ~operation);
  }
  return true;
}

/// Puts every cell on the lists of the operations given; for kToSmooth no vertex rests any more.
void set_pending(WorkingMesh& mesh, std::uint8_t operations);

/// @param start  a valid mesh of the box. Metrics and qualities are left to measure_all.
WorkingMesh load(const TetMesh& start, const Box& box);

/// Asks for the metric at every vertex and sets all qualities. Needs a compact mesh.
void measure_all(WorkingMesh& mesh, const MetricSampler& sampler);

/// Numbers vertices and cells along a Morton curve and drops unused slots. Frozen vertices come
/// first, in their old order.
void compact(WorkingMesh& mesh);

/// Points and cells of a compact mesh.
TetMesh unload(const WorkingMesh& mesh);

}  // namespace mesamis::detail::remesh
