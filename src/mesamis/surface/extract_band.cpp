// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/surface/disjoint_sets.h"
#include "mesamis/surface/extract.h"
#include "mesamis/surface/half_edges.h"

namespace mesamis::detail::surface {
namespace {

/// Corners of all triangles are numbered 3 t + i; side i runs from corner i to the next.
std::size_t next_corner(std::size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

/// The boundary of a set of cells, still with one point per mesh node.
struct Skin {
  std::vector<Triangle> triangles;    ///< mesh nodes, counter-clockwise seen from outside
  std::vector<std::size_t> opposite;  ///< of each side 3 t + i, the side of the triangle across
};

/// Turns around mesh edges, inside a set of cells, from boundary face to boundary face.
class Turner {
 public:
  explicit Turner(const std::vector<Cell>& cells)
      : cells_(cells), neighbors_(cell_neighbors({{}, cells})), triangle_of_(cells.size()) {}

  Skin skin() {
    Skin skin;
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      for (std::size_t f = 0; f < 4; ++f) {
        if (neighbors_[c][f] != kNoIndex) continue;
        triangle_of_[c][f] = static_cast<Index>(skin.triangles.size());
        faces_.push_back({c, f});
        const auto& [i, j, k] = kCellFaces[f];
        skin.triangles.push_back({cells_[c][i], cells_[c][j], cells_[c][k]});
      }
    }
    for (std::size_t t = 0; t < skin.triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) skin.opposite.push_back(side_across(skin, t, i));
    }
    return skin;
  }

 private:
  struct Face {
    std::size_t cell, face;
  };

  /// Cells that only touch along the edge are never entered, so that their skins stay apart.
  std::size_t side_across(const Skin& skin, std::size_t t, std::size_t i) const {
    const Index from = skin.triangles[t][i], to = skin.triangles[t][(i + 1) % 3];
    Face at = faces_[t];
    while (true) {
      at.face = other_face(at, from, to);
      const Index next = neighbors_[at.cell][at.face];
      if (next == kNoIndex) break;
      at = {static_cast<std::size_t>(next),
            face_towards(static_cast<std::size_t>(next), static_cast<Index>(at.cell))};
    }
    const auto across = static_cast<std::size_t>(triangle_of_[at.cell][at.face]);
    const Triangle& triangle = skin.triangles[across];
    return 3 * across + static_cast<std::size_t>(std::find(triangle.begin(), triangle.end(), to) -
                                                 triangle.begin());
  }

  /// The cell's second face on the edge {a, b}.
  std::size_t other_face(const Face& at, Index a, Index b) const {
    const Cell& cell = cells_[at.cell];
    std::size_t f = 0;
    while (f == at.face || cell[f] == a || cell[f] == b) ++f;
    return f;
  }

  std::size_t face_towards(std::size_t cell, Index neighbor) const {
    const auto& around = neighbors_[cell];
    return static_cast<std::size_t>(std::find(around.begin(), around.end(), neighbor) -
                                    around.begin());
  }

  const std::vector<Cell>& cells_;
  std::vector<std::array<Index, 4>> neighbors_;
  std::vector<std::array<Index, 4>> triangle_of_;  // of boundary faces
  std::vector<Face> faces_;                        // of triangles
};

/// One point per fan of triangles around a mesh node, in the order of the triangles.
TriMesh split_fans(const Skin& skin, const std::vector<Vec3>& nodes) {
  DisjointSets fans(3 * skin.triangles.size());
  for (std::size_t side = 0; side < skin.opposite.size(); ++side) {
    fans.unite(side, next_corner(skin.opposite[side]));
  }
  const std::vector<Index> of_corner = fans.numbers().of_item;
  TriMesh surface;
  surface.triangles.resize(skin.triangles.size());
  for (std::size_t t = 0; t < skin.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Index fan = of_corner[3 * t + i];
      if (fan == std::ssize(surface.points)) surface.points.push_back(nodes[skin.triangles[t][i]]);
      surface.triangles[t][i] = fan;
    }
  }
  return surface;
}

/// A fan can pass the same mesh edge twice, at both of the edge's ends: then two pairs of triangles
/// share one pair of points. All pairs but the first get a point of their own amid the edge.
/// @return for each side its new point or kNoIndex.
std::vector<Index> add_middles(const Skin& skin, TriMesh& surface) {
  std::vector<Index> middles(skin.opposite.size(), kNoIndex);
  const auto half_edges = sorted_half_edges(surface.triangles, surface.points.size());
  for_each_edge(half_edges, [&](std::span<const HalfEdge> edge) {
    if (edge.size() == 2) return;
    const Vec3 middle = 0.5 * (surface.points[edge[0].lo] + surface.points[edge[0].hi]);
    bool first = true;
    for (const HalfEdge& s : edge) {
      if (!s.forward) continue;  // one side of each pair is forward
      if (!first) {
        const std::size_t side = s.corner_at_lo();
        middles[side] = middles[skin.opposite[side]] = static_cast<Index>(surface.points.size());
        surface.points.push_back(middle);
      }
      first = false;
    }
  });
  return middles;
}

/// Cuts the triangles at the points amid their sides.
void cut_at_middles(const std::vector<Index>& middles, std::vector<Triangle>& triangles) {
  const std::size_t count = triangles.size();
  for (std::size_t t = 0; t < count; ++t) {
    std::size_t first = 0;
    while (first < 3 && middles[3 * t + first] == kNoIndex) ++first;
    if (first == 3) continue;
    // A fan around a point amid a side: none of its triangles is flat.
    std::vector<Index> ring;
    for (std::size_t step = 0; step < 3; ++step) {
      const std::size_t side = (first + step) % 3;
      if (middles[3 * t + side] != kNoIndex) ring.push_back(middles[3 * t + side]);
      ring.push_back(triangles[t][(side + 1) % 3]);
    }
    triangles[t] = {ring[0], ring[1], ring[2]};
    for (std::size_t i = 2; i + 1 < ring.size(); ++i) {
      triangles.push_back({ring[0], ring[i], ring[i + 1]});
    }
  }
}

}  // namespace

std::vector<Index> band_cells(const TetMesh& mesh, std::span<const double> v, double threshold) {
  if (v.size() != mesh.points.size()) {
    throw InputError("band: expected one value per node (" + std::to_string(mesh.points.size()) +
                     "), found " + std::to_string(v.size()));
  }
  const auto bad = std::find_if_not(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
  if (bad != v.end() || !std::isfinite(threshold)) {
    throw InputError("band: " +
                     (bad == v.end() ? "the threshold"
                                     : "the value at node " + std::to_string(bad - v.begin())) +
                     " is not finite");
  }
  std::vector<Index> band;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const Cell& k = mesh.cells[c];
    if (0.25 * (v[k[0]] + v[k[1]] + v[k[2]] + v[k[3]]) < threshold) {
      band.push_back(static_cast<Index>(c));
    }
  }
  return band;
}

TriMesh extract_band(const TetMesh& mesh, std::span<const double> v, double threshold) {
  std::vector<Cell> cells;
  for (const Index c : band_cells(mesh, v, threshold)) cells.push_back(mesh.cells[c]);
  const Skin skin = Turner(cells).skin();
  TriMesh surface = split_fans(skin, mesh.points);
  const std::vector<Index> middles = add_middles(skin, surface);
  cut_at_middles(middles, surface.triangles);
  return surface;
}

}  // namespace mesamis::detail::surface
