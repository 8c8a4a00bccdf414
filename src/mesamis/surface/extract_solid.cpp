// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "mesamis/base/each_once.h"
#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/surface/box_planes.h"
#include "mesamis/surface/cell_cuts.h"
#include "mesamis/surface/extract.h"
#include "mesamis/surface/snap_nodes.h"

namespace mesamis::detail::surface {
namespace {

/// Where a point of the surface sits: on the mesh edge {a, b}, a < b, or at node a = b of the box.
/// Packed so that sites sort by a, then b.
using Site = std::uint64_t;
using SiteTriangle = std::array<Site, 3>;

Site site_on(Index a, Index b) {
  return (static_cast<Site>(std::min(a, b)) << 32) | static_cast<Site>(std::max(a, b));
}
Index site_begin(Site s) { return static_cast<Index>(s >> 32); }
Index site_end(Site s) { return static_cast<Index>(s & 0xffffffffu); }

/// {u > level} on one mesh, cell by cell.
class Marcher {
 public:
  Marcher(const TetMesh& mesh, std::span<const double> u, double level, const SolidOptions& options)
      : mesh_(mesh), u_(u), level_(level) {
    if (options.snap > 0) snapped_ = snap_nodes(mesh, u, level, options.snap);
    if (!options.close_at_box) return;
    planes_ = box_planes(mesh, options.box ? *options.box : bounding_box(mesh.points));
  }

  /// The surface's position at a site.
  Vec3 position(Site site) const {
    const Index a = site_begin(site), b = site_end(site);
    const Vec3& p = mesh_.points[a];
    if (a == b) return is_snapped(a) ? snapped_->points[a] : p;
    return p + crossing_share(level_, u_[a], u_[b]) * (mesh_.points[b] - p);
  }

  /// Appends the level set's triangles in the cell, and the caps on its box faces.
  void march(const Cell& cell, std::vector<SiteTriangle>& out) const {
    std::array<bool, 4> in{};
    for (std::size_t i = 0; i < 4; ++i) in[i] = inside(cell[i]);
    const int count = in[0] + in[1] + in[2] + in[3];
    if (count == 0) return;
    if (count == 1) cut_corner(cell, corner_that_is(true, in), false, out);
    if (count == 2) cut_pair(cell, in, out);
    if (count == 3) cut_corner(cell, corner_that_is(false, in), true, out);
    if (planes_.empty()) return;
    for (const auto& face : kCellFaces) {
      const Triangle nodes{cell[face[0]], cell[face[1]], cell[face[2]]};
      if ((planes_[nodes[0]] & planes_[nodes[1]] & planes_[nodes[2]]) != 0) cap(nodes, out);
    }
  }

 private:
  bool inside(Index node) const { return u_[node] > level_ && !is_snapped(node); }

  static std::size_t corner_that_is(bool value, const std::array<bool, 4>& in) {
    return static_cast<std::size_t>(std::find(in.begin(), in.end(), value) - in.begin());
  }

  /// The triangle that cuts corner i off, facing away from it, or towards it when flipped.
  void cut_corner(const Cell& cell, std::size_t i, bool flipped,
                  std::vector<SiteTriangle>& out) const {
    const auto& [j, k, l] = kCellFaces[i];
    SiteTriangle cut{crossing(cell[i], cell[j]), crossing(cell[i], cell[k]),
                     crossing(cell[i], cell[l])};
    if (flipped) std::swap(cut[1], cut[2]);
    add(cut, out);
  }

  /// Of the edge between two nodes, or the node of them that lies on the level set.
  Site crossing(Index a, Index b) const {
    if (is_snapped(a)) return site_on(a, a);
    return is_snapped(b) ? site_on(b, b) : site_on(a, b);
  }

  bool is_snapped(Index node) const { return snapped_ && snapped_->on_level[node] != 0; }

  /// Unless corners became one point.
  static void add(const SiteTriangle& t, std::vector<SiteTriangle>& out) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) out.push_back(t);
  }

  /// The quadrilateral between two corners inside and two outside.
  void cut_pair(const Cell& cell, const std::array<bool, 4>& in,
                std::vector<SiteTriangle>& out) const {
    for (const auto& [i, j, k, l] : kEvenPairs) {
      if (!in[i] || !in[j]) continue;
      add_quad({crossing(cell[i], cell[k]), crossing(cell[i], cell[l]), crossing(cell[j], cell[l]),
                crossing(cell[j], cell[k])},
               out);
    }
  }

  /// The part of a box face that lies inside; the nodes turn counter-clockwise seen from outside.
  void cap(Triangle n, std::vector<SiteTriangle>& out) const {
    const int count = inside(n[0]) + inside(n[1]) + inside(n[2]);
    if (count == 0) return;
    // The corner unlike the other two comes first.
    if (count < 3) {
      while (inside(n[0]) != (count == 1)) std::rotate(n.begin(), n.begin() + 1, n.end());
    }
    const Site ab = site_on(n[0], n[1]), ac = site_on(n[0], n[2]);
    const Site a = site_on(n[0], n[0]), b = site_on(n[1], n[1]), c = site_on(n[2], n[2]);
    if (count == 3) out.push_back({a, b, c});
    if (count == 1) out.push_back({a, ab, ac});
    if (count == 2) add_quad({ab, b, c, ac}, out);
  }

  /// Cut along the shorter diagonal: it lies inside the cell or face, no neighbour sees it.
  void add_quad(const std::array<Site, 4>& s, std::vector<SiteTriangle>& out) const {
    const Vec3 d02 = position(s[2]) - position(s[0]), d13 = position(s[3]) - position(s[1]);
    if (dot(d02, d02) <= dot(d13, d13)) {
      add({s[0], s[1], s[2]}, out);
      add({s[0], s[2], s[3]}, out);
    } else {
      add({s[0], s[1], s[3]}, out);
      add({s[1], s[2], s[3]}, out);
    }
  }

  const TetMesh& mesh_;
  std::span<const double> u_;
  double level_;
  std::vector<std::uint8_t> planes_;  // empty: no caps
  std::optional<SnappedNodes> snapped_;
};

Vec3 exact_position(const TetMesh& mesh, Site site,
                    const std::function<double(const Vec3&, const Vec3&)>& crossing) {
  const Vec3 &a = mesh.points[site_begin(site)], &b = mesh.points[site_end(site)];
  const double t = std::clamp(crossing(a, b), kExactCrossingMargin, 1 - kExactCrossingMargin);
  return a + t * (b - a);
}

/// All triangles in the order of the cells.
std::vector<SiteTriangle> march_all(const TetMesh& mesh, const Marcher& marcher) {
  return parallel_collect<SiteTriangle>(mesh.cells.size(), kBlock,
                                        [&](std::size_t begin, std::size_t end, auto& found) {
                                          for (std::size_t c = begin; c < end; ++c)
                                            marcher.march(mesh.cells[c], found);
                                        });
}

std::vector<Site> unique_sites(const std::vector<SiteTriangle>& triangles) {
  std::vector<Site> sites;
  sites.reserve(3 * triangles.size());
  for (const SiteTriangle& t : triangles) sites.insert(sites.end(), t.begin(), t.end());
  sort_once(sites);
  sites.shrink_to_fit();
  return sites;
}

void require_values(const TetMesh& mesh, std::span<const double> u, double level) {
  if (u.size() != mesh.points.size()) {
    throw InputError("solid: expected one value per node (" + std::to_string(mesh.points.size()) +
                     "), found " + std::to_string(u.size()));
  }
  if (!std::isfinite(level)) throw InputError("solid: the level is not finite");
  const auto bad = std::find_if_not(u.begin(), u.end(), [](double x) { return std::isfinite(x); });
  if (bad != u.end()) {
    throw InputError("solid: the value at node " + std::to_string(bad - u.begin()) +
                     " is not finite");
  }
}

}  // namespace

TriMesh extract_solid(const TetMesh& mesh, std::span<const double> u, double level,
                      const SolidOptions& options) {
  require_values(mesh, u, level);
  const Marcher marcher(mesh, u, level, options);
  const std::vector<SiteTriangle> triangles = march_all(mesh, marcher);
  const std::vector<Site> sites = unique_sites(triangles);
  TriMesh surface;
  surface.points.resize(sites.size());
  parallel_for(sites.size(), [&](std::size_t i) {
    const bool on_edge = site_begin(sites[i]) != site_end(sites[i]);
    surface.points[i] = on_edge && options.crossing
                            ? exact_position(mesh, sites[i], options.crossing)
                            : marcher.position(sites[i]);
  });
  surface.triangles.resize(triangles.size());
  parallel_for(triangles.size(), [&](std::size_t t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto found = std::lower_bound(sites.begin(), sites.end(), triangles[t][i]);
      surface.triangles[t][i] = static_cast<Index>(found - sites.begin());
    }
  });
  return surface;
}

}  // namespace mesamis::detail::surface
