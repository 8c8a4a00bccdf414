// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/round_to_single.h"

#include <algorithm>

#include "mesamis/decimate/openmesh.h"
#include "mesamis/decimate/single_places.h"
#include "mesamis/surface/triangle_intersection.h"
#include "mesamis/surface/unused_points.h"

namespace mesamis {
namespace {

class Rounding {
 public:
  Rounding(const TriMesh& surface, RoundReport& report) : exact_(surface.points), report_(report) {
    rounded_.triangles = surface.triangles;
    for (const Vec3& p : surface.points) rounded_.points.push_back(rounded(p));
  }

  bool keeps_points_distinct_and_areas() const {
    std::vector<Vec3> sorted = rounded_.points;
    std::sort(sorted.begin(), sorted.end(), ByPlace());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return false;
    return std::all_of(rounded_.triangles.begin(), rounded_.triangles.end(),
                       [this](const Triangle& t) { return has_area(rounded_.points, t); });
  }

  void repair() {
    build_halfedges(rounded_, {0, 0, 0}, mesh_);
    while (collapse_zero_edges()) {
    }
    separate_equal_points();
    flip_flat_triangles();
    rounded_.triangles = remaining_triangles(mesh_);
  }

  TriMesh result() const { return without_unused_points(rounded_); }

  /// The farthest any point that is left was moved.
  double shift() const {
    double farthest = 0;
    for (std::size_t p = 0; p < exact_.size(); ++p) {
      const bool gone = p < mesh_.n_vertices() && mesh_.status(handle(p)).deleted();
      if (!gone) farthest = std::max(farthest, norm(rounded_.points[p] - exact_[p]));
    }
    return farthest;
  }

 private:
  static OpenMesh::VertexHandle handle(std::size_t p) {
    return OpenMesh::VertexHandle(static_cast<int>(p));
  }

  const Vec3& at(OpenMesh::VertexHandle v) const { return rounded_.points[index(v)]; }

  /// Collapses edges whose ends have become equal.
  bool collapse_zero_edges() {
    const std::int64_t before = report_.collapsed;
    for (const auto e : mesh_.edges()) {
      if (mesh_.status(e).deleted()) continue;
      const auto h = mesh_.halfedge_handle(e, 0);
      if (at(mesh_.from_vertex_handle(h)) != at(mesh_.to_vertex_handle(h))) continue;
      if (!keeps_manifold(mesh_, h)) continue;
      mesh_.collapse(h);
      ++report_.collapsed;
    }
    return report_.collapsed > before;
  }

  /// Of equal points the first stays; the others move to the nearest free place.
  void separate_equal_points() {
    SinglePlaces places;
    std::vector<OpenMesh::VertexHandle> displaced;
    for (const auto v : mesh_.vertices()) {
      if (mesh_.status(v).deleted()) continue;
      if (!places.take(at(v))) displaced.push_back(v);
    }
    for (const auto v : displaced) {
      Vec3& place = rounded_.points[index(v)];
      place = places.take_nearest(place, exact_[index(v)]);
      ++report_.moved;
    }
  }

  /// Flips the longest edge of each flat triangle; no point moves.
  void flip_flat_triangles() {
    for (const auto f : mesh_.faces()) {
      if (mesh_.status(f).deleted() || has_area(rounded_.points, corner_indices(mesh_, f)))
        continue;
      auto longest = mesh_.halfedge_handle(f);
      for (auto h = mesh_.cfh_iter(f); h.is_valid(); ++h) {
        if (length(*h) > length(longest)) longest = *h;
      }
      if (flip(longest)) {
        ++report_.flipped;
      } else {
        ++report_.flat;
      }
    }
  }

  double length(OpenMesh::HalfedgeHandle h) const {
    return norm(at(mesh_.to_vertex_handle(h)) - at(mesh_.from_vertex_handle(h)));
  }

  bool flip(OpenMesh::HalfedgeHandle h) {
    const auto e = mesh_.edge_handle(h);
    if (!mesh_.is_flip_ok(e)) return false;
    const Index a = mesh_.from_vertex_handle(h).idx(), b = mesh_.to_vertex_handle(h).idx();
    const Index c = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h)).idx();
    const auto twin = mesh_.opposite_halfedge_handle(h);
    const Index d = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(twin)).idx();
    if (!has_area(rounded_.points, {a, d, c}) || !has_area(rounded_.points, {d, b, c})) {
      return false;
    }
    mesh_.flip(e);
    return true;
  }

  const std::vector<Vec3>& exact_;
  RoundReport& report_;
  TriMesh rounded_;
  HalfedgeMesh mesh_;
};

/// Without triangles that have two corners at one place.
TriMesh simply_rounded(const TriMesh& surface) {
  TriMesh result;
  for (const Vec3& p : surface.points) result.points.push_back(rounded(p));
  for (const Triangle& t : surface.triangles) {
    const Vec3 &a = result.points[t[0]], &b = result.points[t[1]], &c = result.points[t[2]];
    if (a != b && b != c && c != a) result.triangles.push_back(t);
  }
  return result;
}

}  // namespace

TriMesh round_to_single(const TriMesh& surface, RoundReport* report) {
  require_sound(surface);
  require_single(surface.points);
  RoundReport unused;
  RoundReport& counts = report ? *report : unused;
  counts = {};
  const SurfaceCheck check = check_surface(surface);
  if (!check.closed() || !check.manifold()) return simply_rounded(surface);
  Rounding rounding(surface, counts);
  if (!rounding.keeps_points_distinct_and_areas()) rounding.repair();
  counts.shift = rounding.shift();
  return rounding.result();
}

}  // namespace mesamis
