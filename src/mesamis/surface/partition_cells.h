// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "mesamis/base/parallel.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/cell_cuts.h"
#include "mesamis/surface/partition_part.h"

/// The pieces of a partition's boundaries in one cell. A field says, of each node, its position,
/// the material that wins there, any material's membership and the planes of the box:
///
///   Vec3 point(Index node);            Index material(Index node);
///   unsigned planes(Index node);       double membership(Index node, Index material);
namespace mesamis::detail::surface {

/// Where a point of a partition sits: a WholeSite, by the nodes of a field.
using Simplex = std::array<Index, 4>;

inline Simplex simplex_of(std::initializer_list<Index> nodes) {
  Simplex simplex{kNoIndex, kNoIndex, kNoIndex, kNoIndex};
  std::copy(nodes.begin(), nodes.end(), simplex.begin());
  std::sort(simplex.begin(), simplex.begin() + static_cast<std::ptrdiff_t>(nodes.size()));
  return simplex;
}

inline std::size_t node_count(const Simplex& s) {
  return static_cast<std::size_t>(std::find(s.begin(), s.end(), kNoIndex) - s.begin());
}

struct PartitionPiece {
  std::array<Simplex, 3> corners;
  std::array<Index, 2> sides;  ///< see PartitionSurface
};

/// The barycentric coordinates, up to a factor, where n = 3 or 4 linear functions on a simplex are
/// equal: the vector that is orthogonal to the differences.
/// @param d  n - 1 differences, at n nodes each.
inline std::array<double, 4> orthogonal_to(const std::array<std::array<double, 4>, 3>& d,
                                           std::size_t n) {
  const auto minor = [&](std::size_t i, std::size_t j, std::size_t k) {
    return d[0][i] * (d[1][j] * d[2][k] - d[1][k] * d[2][j]) -
           d[0][j] * (d[1][i] * d[2][k] - d[1][k] * d[2][i]) +
           d[0][k] * (d[1][i] * d[2][j] - d[1][j] * d[2][i]);
  };
  if (n == 4) return {minor(1, 2, 3), -minor(0, 2, 3), minor(0, 1, 3), -minor(0, 1, 2)};
  const auto pair = [&](std::size_t i, std::size_t j) {
    return d[0][i] * d[1][j] - d[0][j] * d[1][i];
  };
  return {pair(1, 2), pair(2, 0), pair(0, 1), 0};
}

/// Marches through cells.
template <class Field>
class PartitionMarcher {
 public:
  explicit PartitionMarcher(const Field& field) : field_(field) {}

  /// Inside of the simplex, where the memberships of its nodes' materials are equal.
  Vec3 position(const Simplex& simplex) const {
    const std::size_t n = node_count(simplex);
    if (n == 1) return field_.point(simplex[0]);
    if (n == 2) return crossing(simplex[0], simplex[1]);
    if (n == 4 && has_equal_materials(simplex)) return amid_faces(simplex);
    const std::array<double, 4> weights = equal_point(simplex, n);
    // From the first node: what is the same for all nodes, as on the box, stays exact.
    const Vec3 first = field_.point(simplex[0]);
    Vec3 sum = first;
    for (std::size_t i = 1; i < n; ++i) sum += weights[i] * (field_.point(simplex[i]) - first);
    return sum;
  }

  /// Appends the boundaries in a cell, and the caps on its faces on the box.
  void march(const Cell& cell, std::vector<PartitionPiece>& out) const {
    march_inside(cell, out);
    add_caps(cell, out);
  }

  /// Appends the boundaries in a cell.
  void march_inside(const Cell& cell, std::vector<PartitionPiece>& out) const {
    std::array<Index, 4> m;
    for (std::size_t i = 0; i < 4; ++i) m[i] = field_.material(cell[i]);
    std::array<Index, 4> sorted = m;
    std::sort(sorted.begin(), sorted.end());
    const auto kinds = std::unique(sorted.begin(), sorted.end()) - sorted.begin();
    if (kinds == 2) cut_in_two(cell, m, out);
    if (kinds > 2) fill_cone(cell, out);
  }

  /// Appends the caps on a cell's faces on the box.
  void add_caps(const Cell& cell, std::vector<PartitionPiece>& out) const {
    for (const auto& [i, j, k] : kCellFaces) {
      const Triangle face{cell[i], cell[j], cell[k]};
      if ((field_.planes(face[0]) & field_.planes(face[1]) & field_.planes(face[2])) != 0) {
        cap(face, out);
      }
    }
  }

  /// Appends the cone from a tip over the curves on a triangle of nodes, which turns
  /// counter-clockwise seen from the side where the tip is not.
  void add_cone(const Simplex& tip, const Triangle& face, std::vector<PartitionPiece>& out) const {
    for (std::size_t turn = 0; turn < 3; ++turn) {
      const Index i = face[turn], j = face[(turn + 1) % 3], k = face[(turn + 2) % 3];
      const Index at_i = field_.material(i), at_j = field_.material(j), at_k = field_.material(k);
      if (at_i == at_j || at_i == at_k) continue;
      const Simplex end = at_j != at_k ? simplex_of({i, j, k}) : simplex_of({i, k});
      add({tip, simplex_of({i, j}), end}, at_j, at_i, out);
    }
  }

  /// Appends a piece.
  /// @param behind, before  the materials on either side of it.
  static void add(std::array<Simplex, 3> corners, Index behind, Index before,
                  std::vector<PartitionPiece>& out) {
    if (before != kNoIndex && before < behind) {
      std::swap(behind, before);
      std::swap(corners[1], corners[2]);
    }
    out.push_back({corners, {behind, before}});
  }

 private:
  using Pieces = std::vector<PartitionPiece>;

  /// Quarters, since differences of large values may overflow.
  double lead(Index node, Index over, Index under) const {
    return 0.25 * field_.membership(node, over) - 0.25 * field_.membership(node, under);
  }

  Vec3 crossing(Index a, Index b) const {
    const Index at_a = field_.material(a), at_b = field_.material(b);
    const double lead_a = lead(a, at_a, at_b), lead_b = lead(b, at_a, at_b);
    const Vec3 p = field_.point(a);
    return p + kept_off_ends(lead_a / (lead_a - lead_b)) * (field_.point(b) - p);
  }

  bool has_equal_materials(const Simplex& s) const {
    for (std::size_t i = 1; i < 4; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (field_.material(s[i]) == field_.material(s[j])) return true;
      }
    }
    return false;
  }

  /// The barycentric coordinates of the point of three or four materials.
  std::array<double, 4> equal_point(const Simplex& s, std::size_t n) const {
    std::array<std::array<double, 4>, 3> d{};
    double scale = 0;
    for (std::size_t i = 1; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        d[i - 1][j] = lead(s[j], field_.material(s[i]), field_.material(s[0]));
        scale = std::max(scale, std::abs(d[i - 1][j]));
      }
    }
    for (auto& row : d) {
      for (double& x : row) x = scale > 0 ? x / scale : 0;
    }
    return kept_inside(orthogonal_to(d, n), n);
  }

  /// Where the point lies outside, the nearest in a sense; the middle where there is none.
  static std::array<double, 4> kept_inside(std::array<double, 4> weights, std::size_t n) {
    const auto sum = [&weights] { return weights[0] + weights[1] + weights[2] + weights[3]; };
    const double whole = sum();
    for (std::size_t i = 0; i < n; ++i) {
      const double share = weights[i] / whole;
      weights[i] = std::isfinite(share) ? std::clamp(share, kCrossingMargin, 1.0) : 1.0;
    }
    const double kept = sum();
    for (double& w : weights) w /= kept;
    return weights;
  }

  /// In a cell of three materials: amid the points on its two faces of three materials.
  Vec3 amid_faces(const Simplex& s) const {
    std::vector<Vec3> amid;
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      Simplex face{kNoIndex, kNoIndex, kNoIndex, kNoIndex};
      std::copy_if(s.begin(), s.end(), face.begin(), [&](Index n) { return n != s[left_out]; });
      const Index a = field_.material(face[0]), b = field_.material(face[1]),
                  c = field_.material(face[2]);
      if (a != b && b != c && c != a) amid.push_back(position(face));
    }
    return amid[0] + 0.5 * (amid[1] - amid[0]);
  }

  /// Cut along the shorter diagonal: it lies inside the cell or face, no neighbour sees it.
  void add_quad(const std::array<Simplex, 4>& s, Index behind, Index before, Pieces& out) const {
    const Vec3 d02 = position(s[2]) - position(s[0]), d13 = position(s[3]) - position(s[1]);
    const bool is_first = dot(d02, d02) <= dot(d13, d13);
    add({s[0], s[1], is_first ? s[2] : s[3]}, behind, before, out);
    add({is_first ? s[0] : s[1], s[2], s[3]}, behind, before, out);
  }

  /// A cell of two materials.
  void cut_in_two(const Cell& cell, const std::array<Index, 4>& m, Pieces& out) const {
    for (std::size_t i = 0; i < 4; ++i) {
      if (std::count(m.begin(), m.end(), m[i]) != 1) continue;
      const auto& [j, k, l] = kCellFaces[i];
      add({simplex_of({cell[i], cell[j]}), simplex_of({cell[i], cell[k]}),
           simplex_of({cell[i], cell[l]})},
          m[i], m[static_cast<std::size_t>(j)], out);
      return;
    }
    for (const auto& [i, j, k, l] : kEvenPairs) {
      if (m[i] != m[j] || m[i] > m[k]) continue;  // one of the two pairs
      add_quad({simplex_of({cell[i], cell[k]}), simplex_of({cell[i], cell[l]}),
                simplex_of({cell[j], cell[l]}), simplex_of({cell[j], cell[k]})},
               m[i], m[k], out);
      return;
    }
  }

  /// A cell of three or four materials: the cone over the curves on its faces never meets itself,
  /// wherever the points lie.
  void fill_cone(const Cell& cell, Pieces& out) const {
    const Simplex tip = simplex_of({cell[0], cell[1], cell[2], cell[3]});
    for (const auto& [i, j, k] : kCellFaces) add_cone(tip, {cell[i], cell[j], cell[k]}, out);
  }

  /// Caps a face on the box; its nodes turn counter-clockwise seen from outside.
  void cap(Triangle n, Pieces& out) const {
    const auto at = [this](Index node) { return field_.material(node); };
    const auto corner = [](Index node) { return simplex_of({node}); };
    for (std::size_t turn = 0; turn < 3; ++turn) {
      const Index m = at(n[0]);
      const Simplex a = corner(n[0]), ab = simplex_of({n[0], n[1]}), ac = simplex_of({n[0], n[2]});
      if (m != at(n[1]) && m != at(n[2]) && at(n[1]) == at(n[2])) {
        add({a, ab, ac}, m, kNoIndex, out);
        add_quad({ab, corner(n[1]), corner(n[2]), ac}, at(n[1]), kNoIndex, out);
      } else if (m != at(n[1]) && m != at(n[2])) {
        const Simplex amid = simplex_of({n[0], n[1], n[2]});
        add({amid, a, ab}, m, kNoIndex, out);
        add({amid, ac, a}, m, kNoIndex, out);
      }
      std::rotate(n.begin(), n.begin() + 1, n.end());
    }
    if (at(n[0]) == at(n[1]) && at(n[1]) == at(n[2])) {
      add({corner(n[0]), corner(n[1]), corner(n[2])}, at(n[0]), kNoIndex, out);
    }
  }

  const Field& field_;
};

/// The boundaries of some cells, not yet joined with those of others.
struct PartitionBlock {
  std::vector<Simplex> sites;  ///< increasing
  std::vector<Triangle> triangles;
  std::vector<std::array<Index, 2>> sides;
};

/// Numbers the sites of the pieces of some cells. O(n log n).
PartitionBlock block_of(std::span<const PartitionPiece> pieces);

/// The sites of all blocks, increasing. O(n log n).
std::vector<Simplex> all_sites(std::span<const PartitionBlock> blocks);

/// Joins blocks, in their order, over all their sites. The points are left to the caller.
PartitionSurface over_sites(std::span<const PartitionBlock> blocks,
                            const std::vector<Simplex>& sites);

/// Blocks as one, and the sites of its points, increasing.
struct JoinedBlocks {
  std::vector<Simplex> sites;
  PartitionSurface surface;
};

/// Joins blocks, in their order. O(n log n).
/// @param position  position(site): of a point, mm; called from several threads.
template <class Position>
JoinedBlocks joined(std::span<const PartitionBlock> blocks, Position&& position) {
  JoinedBlocks part{all_sites(blocks), {}};
  part.surface = over_sites(blocks, part.sites);
  part.surface.points.resize(part.sites.size());
  parallel_for(part.sites.size(),
               [&](std::size_t i) { part.surface.points[i] = position(part.sites[i]); });
  return part;
}

/// Extracts the boundaries from blocks of cells.
/// @param march  march(block, marcher, pieces) appends the pieces of a block.
template <class Field, class March>
JoinedBlocks extract_blocks(const Field& field, std::size_t block_count, March&& march) {
  const PartitionMarcher<Field> marcher(field);
  std::vector<PartitionBlock> blocks(block_count);
  parallel_for_each(block_count, [&](std::size_t b) {
    std::vector<PartitionPiece> pieces;
    march(b, marcher, pieces);
    blocks[b] = block_of(pieces);
  });
  return joined(blocks, [&](const Simplex& site) { return marcher.position(site); });
}

}  // namespace mesamis::detail::surface
