// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/cut.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "mesamis/base/each_once.h"
#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/mesh/edges.h"
#include "mesamis/remesh/body_shape.h"
#include "mesamis/remesh/manifold_skin.h"
#include "mesamis/remesh/skin.h"
#include "mesamis/remesh/split.h"
#include "mesamis/remesh/workbench.h"

namespace mesamis::detail::remesh {
namespace {

/// An edge, and how far along it something is.
struct Place {
  Edge edge;
  double share;
};

class Cut {
 public:
  Cut(const TetMesh& start, const BodyShape& shape, const MetricSampler& sampler)
      : shape_(shape), mesh_(load(start, bounding_box(start.points))), edges_(unique_edges(start)) {
    mesh_.shape = &shape;
    measure_all(mesh_, sampler);
    bench_.emplace(mesh_, sampler);
    materials_.resize(start.points.size());
    parallel_for(materials_.size(),
                 [&](std::size_t p) { materials_[p] = shape.material_at(start.points[p]); });
  }

  /// A vertex put on an edge may lie on the other side of a wall or gap than others around it:
  /// their edges are looked at again.
  void keep_thin_places() {
    constexpr int kPasses = 4;
    std::vector<Edge> edges = edges_;
    for (int pass = 0; pass < kPasses && !edges.empty(); ++pass) {
      const auto first_new = static_cast<Index>(mesh_.vertices.size());
      split_at(hidden_places(edges), false);
      edges = edges_from(first_new);
      edges_.insert(edges_.end(), edges.begin(), edges.end());
    }
  }

  /// Of edges that are there no more nothing is found: both their halves are known.
  void split_at_border() { split_at(crossings(), true); }

  WorkingMesh result() {
    for (WorkCell& cell : mesh_.cells) {
      cell.material = kOutside;
      for (const Index p : cell.points) {
        if (mesh_.vertices[p].mask & kOnSkin) continue;
        cell.material = std::max(cell.material, materials_[p]);
      }
    }
    make_skin_manifold(*bench_);
    for (Index c = 0; c < std::ssize(mesh_.cells); ++c) mark_skin(c);
    return std::move(mesh_);
  }

 private:
  const Vec3& at(Index vertex) const { return mesh_.vertices[vertex].position; }

  std::vector<Place> hidden_places(const std::vector<Edge>& edges) const {
    return parallel_collect<Place>(edges.size(), kBlock,
                                   [&](std::size_t begin, std::size_t end, auto& found) {
                                     for (std::size_t i = begin; i < end; ++i) {
                                       const auto [a, b] = edges[i];
                                       if (materials_[a] != materials_[b]) continue;
                                       const auto share = shape_.hidden_crossing(at(a), at(b));
                                       if (share) found.push_back({edges[i], *share});
                                     }
                                   });
  }

  std::vector<Place> crossings() const {
    return parallel_collect<Place>(edges_.size(), kBlock,
                                   [&](std::size_t begin, std::size_t end, auto& found) {
                                     for (std::size_t i = begin; i < end; ++i) {
                                       const auto [a, b] = edges_[i];
                                       if (materials_[a] == materials_[b]) continue;
                                       found.push_back({edges_[i], shape_.crossing(at(a), at(b))});
                                     }
                                   });
  }

  /// Splits edges in the order in which they come.
  void split_at(const std::vector<Place>& places, bool on_skin) {
    for (const auto& [edge, share] : places) {
      const Index cell = find_cell(edge);
      if (cell == kNoIndex) continue;
      const Index v = split_edge_at(*bench_, {cell, edge[0], edge[1]}, share, on_skin);
      materials_.resize(mesh_.vertices.size(), kOutside);
      if (v != kNoIndex && !on_skin) materials_[v] = shape_.material_at(at(v));
    }
  }

  /// Where an edge could not be split there are others on the skin than those of the border.
  void mark_skin(Index c) {
    for (int f = 0; f < 4; ++f) {
      if (!is_skin(mesh_, c, f)) continue;
      for (const int i : kCellFaces[f]) mesh_.vertices[mesh_.cells[c].points[i]].mask |= kOnSkin;
    }
  }

  /// One of the cells around the edge now.
  Index find_cell(const Edge& edge) {
    for (const Index c : bench_->cavity.ball(edge[0])) {
      if (local_index(mesh_.cells[c].points, edge[1]) >= 0) return c;
    }
    return kNoIndex;
  }

  /// The edges at vertices from one on, each once.
  std::vector<Edge> edges_from(Index first) {
    std::vector<Edge> edges;
    for (Index v = first; v < std::ssize(mesh_.vertices); ++v) {
      for (const Index c : bench_->cavity.ball(v)) {
        for (const Index p : mesh_.cells[c].points) {
          if (p != v) edges.push_back({std::min(p, v), std::max(p, v)});
        }
      }
    }
    sort_once(edges);
    return edges;
  }

  const BodyShape& shape_;
  WorkingMesh mesh_;
  std::optional<Workbench> bench_;
  std::vector<Edge> edges_;
  std::vector<Material> materials_;  ///< of the vertices; kOutside on the skin
};

}  // namespace

WorkingMesh cut_along_border(const TetMesh& start, const BodyShape& shape,
                             const MetricSampler& sampler) {
  Cut cut(start, shape, sampler);
  cut.keep_thin_places();
  cut.split_at_border();
  WorkingMesh mesh = cut.result();
  if (std::ranges::all_of(mesh.cells, [](const auto& c) { return c.material == kOutside; })) {
    throw InputError("body: expected an object that fills at least one element, found none");
  }
  return mesh;
}

}  // namespace mesamis::detail::remesh
