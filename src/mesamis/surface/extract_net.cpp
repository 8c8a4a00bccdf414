// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/extract_net.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

#include "mesamis/base/each_once.h"
#include "mesamis/base/parallel.h"
#include "mesamis/surface/disjoint_sets.h"
#include "mesamis/surface/exact_predicates.h"
#include "mesamis/surface/grid_field.h"
#include "mesamis/surface/partition_cells.h"

namespace mesamis::detail::surface {
namespace {

/// Key of a cube's own point among sites: its lowest node, four times.
Simplex site_of_cube(Index cube) { return {cube, cube, cube, cube}; }
bool is_of_cube(const Simplex& site) { return site[0] == site[3]; }

/// Of each material the object that it is part of: its label, or 0 where that is not chosen.
std::vector<Index> objects_of(const GridMemberships& grid, const std::vector<char>& chosen) {
  std::vector<Index> objects = grid.label;
  if (chosen.empty()) return objects;
  for (Index& l : objects) {
    if (l >= std::ssize(chosen) || chosen[static_cast<std::size_t>(l)] == 0) l = 0;
  }
  return objects;
}

class Net {
 public:
  Net(const GridMemberships& grid, const NetOptions& options)
      : grid_(grid),
        field_(grid, options.close_at_box),
        marcher_(field_),
        objects_(objects_of(grid, options.chosen)),
        stride_{1, grid.size[0], grid.size[0] * grid.size[1]},
        tame_(grid.material.size(), 0),
        straight_(grid.material.size(), 0) {
    const auto layers = static_cast<std::size_t>(grid.size[2] - 1);
    parallel_for_each(layers, [this](std::size_t k) {
      std::vector<PartitionPiece> pieces;
      field_.for_cubes_above(static_cast<Index>(k), [&](Index cube) {
        if (!field_.is_uniform(cube) && is_disc_of_all(cube, pieces)) tame_[cube] = 1;
      });
    });
    parallel_for_each(layers, [this](std::size_t k) {
      field_.for_cubes_above(static_cast<Index>(k), [&](Index cube) {
        unsigned straight = 0;
        for (int a = 0; a < 3; ++a) straight |= (may_be_straight(cube, a) ? 1U : 0U) << a;
        straight_[cube] = static_cast<std::uint8_t>(straight);
      });
    });
  }

  JoinedBlocks extract(const NodeSlices& slices) const {
    std::vector<PartitionBlock> blocks(slices.count());
    parallel_for_each(blocks.size(), [&](std::size_t b) {
      const Index k = slices.begin + static_cast<Index>(b);
      std::vector<PartitionPiece> pieces;
      field_.for_cubes_above(k, [&](Index cube) { add_cube(cube, pieces); });
      for_edges_at(k, [&](Index node, int axis) { add_edge(node, axis, pieces); });
      std::erase_if(pieces, [this](const PartitionPiece& piece) { return is_within(piece); });
      blocks[b] = block_of(pieces);
    });
    return joined(blocks, [this](const Simplex& site) { return position(site); });
  }

 private:
  template <class Visit>
  void for_edges_at(Index k, Visit visit) const {
    for (Index j = 0; j < grid_.size[1]; ++j) {
      for (Index i = 0; i < grid_.size[0]; ++i) {
        const Index node = i + j * stride_[1] + k * stride_[2];
        const std::array<Index, 3> at{i, j, k};
        for (int a = 0; a < 3; ++a) {
          if (at[a] + 1 < grid_.size[a] && is_cut(node, a)) visit(node, a);
        }
      }
    }
  }

  bool is_cut(Index node, int axis) const {
    return object(field_.material(node)) != object(field_.material(node + stride_[axis]));
  }

  Index object(Index material) const { return objects_[static_cast<std::size_t>(material)]; }
  /// Whether a piece lies between materials of one object.
  bool is_within(const PartitionPiece& piece) const {
    const auto [behind, before] = piece.sides;
    return before != kNoIndex && object(behind) == object(before);
  }
  bool is_tame(Index cube) const { return tame_[cube] != 0; }
  /// Whether the boundaries cross the face with this lowest node, normal to an axis, in one line
  /// between the points of two cubes.
  bool is_straight(Index node, int axis) const { return (straight_[node] >> axis & 1U) != 0; }

  /// The four nodes around a face.
  std::array<Index, 4> around(Index node, int axis) const {
    const Index u = stride_[(axis + 1) % 3], v = stride_[(axis + 2) % 3];
    return {node, node + u, node + u + v, node + v};
  }

  bool may_be_straight(Index node, int axis) const {
    if (field_.place(node)[static_cast<std::size_t>(axis)] == 0) return false;
    if (!is_tame(node) || !is_tame(node - stride_[axis])) return false;
    const auto n = around(node, axis);
    std::array<Index, 4> o;
    for (std::size_t i = 0; i < 4; ++i) o[i] = object(field_.material(n[i]));
    for (std::size_t i = 0; i < 2; ++i) {
      if (o[i] == o[i + 2] && o[i] != o[i + 1] && o[i] != o[(i + 3) % 4]) return false;
    }
    return true;
  }

  /// Whether the boundaries in a cube make one disc for each object in it: so they hang together.
  bool is_disc_of_all(Index cube, std::vector<PartitionPiece>& pieces) const {
    pieces.clear();
    field_.for_cells(cube, [&](const Cell& cell) { marcher_.march_inside(cell, pieces); });
    std::vector<PartitionPiece> of_object;
    std::vector<Index> objects;
    for (const auto& [corners, sides] : pieces) {
      for (const Index m : sides) add_once(objects, object(m));
    }
    for (const Index o : objects) {
      of_object.clear();
      std::ranges::copy_if(pieces, std::back_inserter(of_object), [&](const auto& piece) {
        return (object(piece.sides[0]) == o) != (object(piece.sides[1]) == o);
      });
      if (!of_object.empty() && !is_disc(of_object)) return false;
    }
    return true;
  }

  /// Whether some pieces hang together and have the Euler characteristic of a disc.
  static bool is_disc(std::span<const PartitionPiece> pieces) {
    const auto [sites, triangles, sides] = block_of(pieces);
    std::vector<std::array<Index, 2>> edges;
    for (const Triangle& t : triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = t[i], b = t[(i + 1) % 3];
        edges.push_back({std::min(a, b), std::max(a, b)});
      }
    }
    sort_once(edges);
    DisjointSets sets(sites.size());
    for (const auto& [a, b] : edges) {
      sets.unite(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
    }
    return sets.numbers().count == 1 && sites.size() + triangles.size() == edges.size() + 1;
  }

  /// The mean of the points where a cube's edges are cut.
  Vec3 point_of(Index cube) const {
    Vec3 sum;
    int count = 0;
    for (int a = 0; a < 3; ++a) {
      for (const Index node : around(cube, a)) {
        if (!is_cut(node, a)) continue;
        sum += marcher_.position(simplex_of({node, node + stride_[a]}));
        ++count;
      }
    }
    return (1.0 / count) * sum;
  }

  Vec3 position(const Simplex& site) const {
    return is_of_cube(site) ? point_of(site[0]) : marcher_.position(site);
  }

  /// What of the boundaries lies within a cube, or at faces that keep their points.
  void add_cube(Index cube, std::vector<PartitionPiece>& out) const {
    if (!is_tame(cube)) {
      field_.for_cells(cube, [&](const Cell& cell) { marcher_.march_inside(cell, out); });
    } else {
      for (int a = 0; a < 3; ++a) {
        if (!is_straight(cube, a)) add_face(cube, cube, a, false, out);
        const Index far = cube + stride_[a];
        if (!is_straight(far, a)) add_face(cube, far, a, true, out);
      }
    }
    field_.for_cells(cube, [&](const Cell& cell) { marcher_.add_caps(cell, out); });
  }

  /// The cone from a cube's point over the lines on one of its faces.
  void add_face(Index cube, Index node, int axis, bool is_far,
                std::vector<PartitionPiece>& out) const {
    const auto [a, b, c, d] = around(node, axis);
    for (Triangle t : {Triangle{a, b, c}, Triangle{a, c, d}}) {
      if (!is_far) std::swap(t[1], t[2]);
      marcher_.add_cone(site_of_cube(cube), t, out);
    }
  }

  /// The boundary around the point where an edge is cut, as far as faces around it are straight.
  void add_edge(Index node, int axis, std::vector<PartitionPiece>& out) const {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const Index su = stride_[u], sv = stride_[v];
    // Around the edge, and the faces between each of them and the next.
    const std::array<Index, 4> cube{node - su - sv, node - sv, node, node - su};
    const std::array<std::pair<Index, int>, 4> face{
        {{node - sv, u}, {node, v}, {node, u}, {node - su, v}}};
    const auto at = field_.place(node);
    const bool low_u = at[static_cast<std::size_t>(u)] == 0;
    const bool low_v = at[static_cast<std::size_t>(v)] == 0;
    std::array<bool, 4> straight{};
    int count = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      if ((i == 0 && low_v) || (i == 3 && low_u)) continue;
      straight[i] = is_straight(face[i].first, face[i].second);
      count += straight[i] ? 1 : 0;
    }
    const Index behind = field_.material(node), before = field_.material(node + stride_[axis]);
    const auto site = [&](std::size_t i) { return site_of_cube(cube[i % 4]); };
    if (count == 4) {
      if (const auto first = diagonal(node, axis, cube)) {
        marcher_.add({site(*first), site(*first + 1), site(*first + 2)}, behind, before, out);
        marcher_.add({site(*first), site(*first + 2), site(*first + 3)}, behind, before, out);
        return;
      }
    }
    const Simplex amid = simplex_of({node, node + stride_[axis]});
    for (std::size_t i = 0; i < 4; ++i) {
      if (straight[i]) marcher_.add({amid, site(i), site(i + 1)}, behind, before, out);
    }
  }

  /// Where the quadrilateral around an edge may be cut: from the first corner, or the second, to the
  /// one across; the shorter one of two.
  std::optional<std::size_t> diagonal(Index node, int axis,
                                      const std::array<Index, 4>& cube) const {
    std::array<Vec3, 4> p;
    for (std::size_t i = 0; i < 4; ++i) p[i] = point_of(cube[i]);
    const Vec3 low = field_.point(node), high = field_.point(node + stride_[axis]);
    const auto separates = [&](std::size_t i, std::size_t j, std::size_t k) {
      return orientation(p[i], p[j], p[k], high) > 0 && orientation(p[i], p[j], p[k], low) < 0;
    };
    const bool first = separates(0, 1, 2) && separates(0, 2, 3);
    const bool other = separates(1, 2, 3) && separates(1, 3, 0);
    if (!first && !other) return std::nullopt;
    if (!first || !other) return first ? 0 : 1;
    const Vec3 d02 = p[2] - p[0], d13 = p[3] - p[1];
    return dot(d02, d02) <= dot(d13, d13) ? 0 : 1;
  }

  const GridMemberships& grid_;
  GridField field_;
  PartitionMarcher<GridField> marcher_;
  std::vector<Index> objects_;  // of each material
  std::array<Index, 3> stride_;
  std::vector<std::uint8_t> tame_;      // of the cube above each node: 1
  std::vector<std::uint8_t> straight_;  // of its lower faces: a bit for each axis
};

}  // namespace

PartitionSurface extract_net_on_grid(const GridMemberships& memberships,
                                     const NetOptions& options) {
  return extract_net_part(memberships, {0, memberships.size[2]}, options).surface;
}

PartitionPart extract_net_part(const GridMemberships& memberships, const NodeSlices& slices,
                               const NetOptions& options) {
  require_memberships(memberships);
  require_slices(memberships, slices, 1, 2);
  return named_wholly(memberships, Net(memberships, options).extract(slices));
}

}  // namespace mesamis::detail::surface
