// SPDX-License-Identifier: Apache-2.0
#include "mesamis/remesh/manifold_skin.h"

#include <algorithm>
#include <array>
#include <vector>

#include "mesamis/base/each_once.h"
#include "mesamis/remesh/body_shape.h"
#include "mesamis/remesh/geometry.h"

namespace mesamis::detail::remesh {
namespace {

class ManifoldSkin {
 public:
  explicit ManifoldSkin(Workbench& bench) : bench_(bench), mesh_(bench.mesh) {}

  std::int64_t run() {
    collect_border_vertices();
    // Each pass looks at the vertices of the cells that the last one changed. Where two places undo
    // each other what does not hang together goes: that ends, since nothing comes back.
    constexpr int kGentlePasses = 10;
    for (int pass = 0; !vertices_.empty(); ++pass) {
      changed_vertices_.clear();
      for (const Index v : vertices_) mend(v, pass < kGentlePasses);
      sort_once(changed_vertices_);
      vertices_ = changed_vertices_;
    }
    return changed_cells_;
  }

 private:
  /// Cells of one material around a vertex that hang together.
  struct Cluster {
    std::uint8_t material;
    double volume = 0;
    std::vector<Index> cells;
    bool reaches_box = false;
  };

  void collect_border_vertices() {
    std::vector<bool> on_border(mesh_.vertices.size(), false);
    for (const WorkCell& cell : mesh_.cells) {
      if (!cell.alive()) continue;
      for (int f = 0; f < 4; ++f) {
        const FaceRef n = cell.neighbors[f];
        if (n == kNoIndex || mesh_.cells[cell_of(n)].material == cell.material) continue;
        for (const int i : kCellFaces[f]) on_border[cell.points[i]] = true;
      }
    }
    for (std::size_t v = 0; v < on_border.size(); ++v) {
      if (on_border[v]) vertices_.push_back(static_cast<Index>(v));
    }
  }

  void mend(Index v, bool gentle) {
    bench_.cavity.collect_ball(v, ball_);
    find_clusters(v);
    for (const Cluster& cluster : clusters_) {
      if (stays(v, cluster)) continue;
      if (!gentle) return empty_ball();
      dissolve(v, cluster);
    }
  }

  /// On a plane of the box what lies beyond it is outside, too, and the largest of all.
  bool stays(Index v, const Cluster& cluster) const {
    if (cluster.material == kOutside && (mesh_.vertices[v].mask & kPlanes)) {
      return cluster.reaches_box;
    }
    return std::ranges::none_of(clusters_, [&](const Cluster& other) {
      const bool is_first = &other < &cluster;
      return other.material == cluster.material &&
             (other.volume > cluster.volume || (other.volume == cluster.volume && is_first));
    });
  }

  void empty_ball() {
    for (const Index c : ball_) change(c, kOutside);
  }

  void change(Index c, std::uint8_t material) {
    if (mesh_.cells[c].material == material) return;
    mesh_.cells[c].material = material;
    ++changed_cells_;
    for (const Index p : mesh_.cells[c].points) changed_vertices_.push_back(p);
  }

  void find_clusters(Index v) {
    clusters_.clear();
    std::vector<Index> rest(ball_.begin(), ball_.end());
    while (!rest.empty()) {
      Cluster cluster{mesh_.cells[rest.back()].material, 0, {rest.back()}, false};
      rest.pop_back();
      for (std::size_t i = 0; i < cluster.cells.size(); ++i) {
        cluster.volume += volume_of(cluster.cells[i]);
        cluster.reaches_box |= has_box_face(cluster.cells[i], v);
        for_each_neighbor(cluster.cells[i], v, [&](Index next) {
          const auto at = std::find(rest.begin(), rest.end(), next);
          if (at == rest.end() || mesh_.cells[next].material != cluster.material) return;
          cluster.cells.push_back(next);
          rest.erase(at);
        });
      }
      clusters_.push_back(std::move(cluster));
    }
  }

  /// Its cells become what most of their faces around the vertex look at.
  void dissolve(Index v, const Cluster& cluster) {
    std::array<int, 256> faces{};
    for (const Index c : cluster.cells) {
      for_each_neighbor(c, v, [&](Index next) {
        if (mesh_.cells[next].material != cluster.material) ++faces[mesh_.cells[next].material];
      });
    }
    const auto most = std::ranges::max_element(faces);
    if (*most == 0) return;
    const auto material = static_cast<std::uint8_t>(most - faces.begin());
    for (const Index c : cluster.cells) change(c, material);
  }

  /// Over the faces at the vertex.
  template <class Visit>
  void for_each_neighbor(Index c, Index v, Visit&& visit) const {
    const WorkCell& cell = mesh_.cells[c];
    for (int f = 0; f < 4; ++f) {
      if (cell.points[f] != v && cell.neighbors[f] != kNoIndex) visit(cell_of(cell.neighbors[f]));
    }
  }

  bool has_box_face(Index c, Index v) const {
    const WorkCell& cell = mesh_.cells[c];
    for (int f = 0; f < 4; ++f) {
      if (cell.points[f] != v && cell.neighbors[f] == kNoIndex) return true;
    }
    return false;
  }

  double volume_of(Index c) const {
    const auto at = [&](int i) { return mesh_.vertices[mesh_.cells[c].points[i]].position; };
    return six_volume(at(0), at(1), at(2), at(3));
  }

  Workbench& bench_;
  WorkingMesh& mesh_;
  std::vector<Index> vertices_, changed_vertices_, ball_;
  std::vector<Cluster> clusters_;
  std::int64_t changed_cells_ = 0;
};

}  // namespace

std::int64_t make_skin_manifold(Workbench& bench) { return ManifoldSkin(bench).run(); }

}  // namespace mesamis::detail::remesh
