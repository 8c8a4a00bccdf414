// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/snap_nodes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "mesamis/base/each_once.h"
#include "mesamis/base/parallel.h"
#include "mesamis/surface/cell_cuts.h"
#include "mesamis/surface/triangle_tree.h"

namespace mesamis::detail::surface {
namespace {

/// Of a cell's volume, what it keeps.
constexpr double kLeastVolume = 0.2;

/// A point of the surface opposite a node: on the edge from a node above the level to one below, or at
/// a node that was moved, which then comes twice.
using LinkPoint = std::pair<Index, Index>;

/// Where the surface enters and leaves the face of a cell opposite a node.
using LinkPiece = std::pair<LinkPoint, LinkPoint>;

class NodeSnapper {
 public:
  NodeSnapper(const TetMesh& mesh, std::span<const double> u, double level, double distance)
      : mesh_(mesh),
        u_(u),
        level_(level),
        distance_(distance),
        cells_(point_cells(mesh)),
        snapped_{mesh.points, std::vector<char>(mesh.points.size(), 0)} {}

  SnappedNodes snap() && {
    for (const auto& [share, node] : nodes_by_share()) snap(node);
    return std::move(snapped_);
  }

 private:
  bool is_above(Index node) const { return u_[node] > level_; }
  bool is_moved(Index node) const { return snapped_.on_level[node] != 0; }
  bool is_inside(Index node) const { return is_above(node) && !is_moved(node); }

  /// Of the edge to a node across the level, what lies before the crossing.
  double share_to(Index node, Index across) const {
    return crossing_share(level_, u_[node], u_[across]);
  }
  Vec3 crossing(Index node, Index across) const {
    const Vec3& p = mesh_.points[node];
    return p + share_to(node, across) * (mesh_.points[across] - p);
  }

  /// The nodes inside the mesh whose edges cross the level, those with the nearest crossings first.
  std::vector<std::pair<double, Index>> nodes_by_share() const {
    auto found = parallel_collect<std::pair<double, Index>>(
        mesh_.points.size(), kBlock, [&](std::size_t begin, std::size_t end, auto& out) {
          for (auto node = static_cast<Index>(begin); node < static_cast<Index>(end); ++node) {
            double nearest = 1;
            for (const Index across : nodes_across(node)) {
              nearest = std::min(nearest, share_to(node, across));
            }
            if (nearest < 1 && lies_inside_the_mesh(node)) out.emplace_back(nearest, node);
          }
        });
    std::ranges::sort(found);
    return found;
  }

  /// The nodes at the other ends of edges that cross the level.
  std::vector<Index> nodes_across(Index node) const {
    std::vector<Index> across;
    for (const Index c : cells_.of(node)) {
      for (const Index other : mesh_.cells[c]) {
        if (is_above(other) != is_above(node)) across.push_back(other);
      }
    }
    sort_once(across);
    return across;
  }

  /// Whether the cells around a node close around it.
  bool lies_inside_the_mesh(Index node) const {
    std::vector<std::pair<Index, Index>> edges;
    for (const Index c : cells_.of(node)) {
      const Triangle t = face_opposite(c, node);
      for (std::size_t i = 0; i < 3; ++i) edges.emplace_back(t[i], t[(i + 1) % 3]);
    }
    std::ranges::sort(edges);
    return std::ranges::all_of(edges, [&](const auto& edge) {
      return std::ranges::binary_search(edges, std::pair{edge.second, edge.first});
    });
  }

  Triangle face_opposite(Index c, Index node) const {
    const Cell& cell = mesh_.cells[c];
    const auto corner = static_cast<std::size_t>(std::ranges::find(cell, node) - cell.begin());
    const auto& [i, j, k] = kCellFaces[corner];
    return {cell[i], cell[j], cell[k]};
  }

  void snap(Index node) {
    Vec3 sum{};
    double weights = 0;
    for (const Index across : nodes_across(node)) {
      if (is_moved(across)) continue;
      const double share = share_to(node, across), weight = 1 / (share * share);
      sum += weight * crossing(node, across);
      weights += weight;
    }
    if (weights == 0) return;
    snapped_.points[node] = (1 / weights) * sum;
    snapped_.on_level[node] = 1;
    if (keeps_cells(node) && keeps_surface(node)) return;
    snapped_.points[node] = mesh_.points[node];
    snapped_.on_level[node] = 0;
  }

  bool keeps_cells(Index node) const {
    const auto volume = [](const std::vector<Vec3>& points, const Cell& cell) {
      return six_volume(points[cell[0]], points[cell[1]], points[cell[2]], points[cell[3]]);
    };
    return std::ranges::all_of(cells_.of(node), [&](Index c) {
      const Cell& cell = mesh_.cells[c];
      return volume(snapped_.points, cell) >= kLeastVolume * volume(mesh_.points, cell);
    });
  }

  /// Whether the surface around a moved node and around those beside it is still what it was.
  bool keeps_surface(Index node) const {
    if (!is_kept_at(node)) return false;
    std::vector<Index> beside;
    for (const Index c : cells_.of(node)) {
      for (const Index other : mesh_.cells[c]) {
        if (other != node && is_moved(other)) beside.push_back(other);
      }
    }
    sort_once(beside);
    return std::ranges::all_of(beside, [this](Index other) { return is_kept_at(other); });
  }

  bool is_kept_at(Index node) const {
    const std::vector<LinkPiece> pieces = pieces_opposite(node);
    return is_one_line(pieces) && stays_near(node, pieces);
  }

  /// Whether pieces are one closed line that passes each of its points once: the surface then goes
  /// around the node once.
  static bool is_one_line(const std::vector<LinkPiece>& pieces) {
    if (pieces.size() < 3) return false;
    LinkPoint at = pieces[0].first;
    for (std::size_t steps = 0; steps < pieces.size(); ++steps) {
      if (steps > 0 && at == pieces[0].first) return false;
      const auto is_next = [&](const LinkPiece& piece) { return piece.first == at; };
      if (std::ranges::count_if(pieces, is_next) != 1) return false;
      at = std::ranges::find_if(pieces, is_next)->second;
    }
    return at == pieces[0].first;
  }

  std::vector<LinkPiece> pieces_opposite(Index node) const {
    std::vector<LinkPiece> pieces;
    const auto point = [&](Index inside, Index outside) {
      return LinkPoint{is_moved(outside) ? outside : inside, outside};
    };
    for (const Index c : cells_.of(node)) {
      const Triangle t = face_opposite(c, node);
      LinkPiece piece{{kNoIndex, kNoIndex}, {kNoIndex, kNoIndex}};
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = t[i], b = t[(i + 1) % 3];
        if (is_inside(a) && !is_inside(b)) piece.first = point(a, b);
        if (!is_inside(a) && is_inside(b)) piece.second = point(b, a);
      }
      if (piece.first != piece.second) pieces.push_back(piece);
    }
    return pieces;
  }

  /// Whether what crossed the node's edges lies near the triangles between the node and the pieces.
  bool stays_near(Index node, const std::vector<LinkPiece>& pieces) const {
    const auto place = [&](const LinkPoint& p) {
      return p.first == p.second ? snapped_.points[p.first] : crossing(p.first, p.second);
    };
    const auto is_near = [&](const Vec3& p) {
      return std::ranges::any_of(pieces, [&](const LinkPiece& piece) {
        return squared_distance(p, {snapped_.points[node], place(piece.first),
                                    place(piece.second)}) <= distance_ * distance_;
      });
    };
    return std::ranges::all_of(nodes_across(node),
                               [&](Index across) { return is_near(crossing(node, across)); });
  }

  const TetMesh& mesh_;
  std::span<const double> u_;
  double level_, distance_;
  PointCells cells_;
  SnappedNodes snapped_;
};

}  // namespace

SnappedNodes snap_nodes(const TetMesh& mesh, std::span<const double> u, double level,
                        double distance) {
  return NodeSnapper(mesh, u, level, distance).snap();
}

}  // namespace mesamis::detail::surface
