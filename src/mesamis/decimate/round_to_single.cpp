// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/round_to_single.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "mesamis/base/each_once.h"
#include "mesamis/decimate/openmesh.h"
#include "mesamis/decimate/single_places.h"
#include "mesamis/surface/measure.h"
#include "mesamis/surface/self_intersections.h"
#include "mesamis/surface/triangle_intersection.h"
#include "mesamis/surface/unused_points.h"

namespace mesamis::detail::decimate {
namespace {

/// Where triangles meet, shorter edges than this are collapsed, and the longest edges of less high
/// triangles are flipped; in distances between floats. It grows while that does not help.
constexpr double kThinnest = 2, kThickest = 128, kThicker = 4;
/// So often triangles are sought that meet; few do.
constexpr int kMostRounds = 16;

/// The greatest distance between neighbouring floats among the coordinates of the triangles.
double coarseness(const TriMesh& surface) {
  double largest = std::numeric_limits<float>::min();
  for (const Triangle& t : surface.triangles) {
    for (const Index corner : t) {
      const Vec3& p = surface.points[corner];
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
  }
  return std::ldexp(std::numeric_limits<float>::epsilon(), std::ilogb(largest));
}

class Rounding {
 public:
  Rounding(const TriMesh& surface, RoundReport& report) : exact_(surface.points), report_(report) {
    rounded_.triangles = surface.triangles;
    for (const Vec3& p : surface.points) rounded_.points.push_back(rounded(p));
    stands_in_.resize(exact_.size());
    std::iota(stands_in_.begin(), stands_in_.end(), 0);
  }

  void run() {
    if (!keeps_points_distinct_and_areas()) repair();
    report_.shift = farthest_point();
    part_what_meets();
    if (mesh_.n_vertices() > 0) count_flat_triangles();
  }

  TriMesh result() const { return without_unused_points(rounded_); }

 private:
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

  /// The farthest that any point of the surface was moved.
  double farthest_point() const {
    double farthest = 0;
    for (std::size_t p = 0; p < exact_.size(); ++p) {
      Index at = stands_in_[p];
      while (stands_in_[at] != at) at = stands_in_[at];
      farthest = std::max(farthest, norm(rounded_.points[at] - exact_[p]));
    }
    return farthest;
  }

  /// Thin triangles may meet once their points have moved. Where they have a short edge, it is
  /// collapsed; where they have none, their longest edge is flipped.
  void part_what_meets() {
    std::vector<Index> meeting = triangles_that_meet();
    if (meeting.empty()) return;
    moved_.assign(rounded_.triangles.size(), 0);
    double thin = kThinnest;
    for (int round = 0; round < kMostRounds && thin <= kThickest && !meeting.empty(); ++round) {
      bool helps = mend_thin(meeting, thin * coarseness(rounded_));
      if (helps) {
        std::vector<Index> left = triangles_that_meet();
        helps = left.size() < meeting.size();
        meeting = std::move(left);
      }
      if (!helps) thin *= kThicker;
    }
    if (!moved_.empty()) report_.shift += *std::max_element(moved_.begin(), moved_.end());
  }

  std::vector<Index> triangles_that_meet() const {
    std::vector<Index> meeting;
    for (const TrianglePair& pair : find_self_intersections(rounded_)) {
      meeting.insert(meeting.end(), pair.begin(), pair.end());
    }
    sort_once(meeting);
    return meeting;
  }

  void count_flat_triangles() {
    report_.flat =
        std::count_if(rounded_.triangles.begin(), rounded_.triangles.end(),
                      [this](const Triangle& t) { return !has_area(rounded_.points, t); });
  }

  /// @param triangles  of the rounded surface.
  /// @return whether anything was done.
  bool mend_thin(const std::vector<Index>& triangles, double thin) {
    mesh_.clear();
    build_halfedges(rounded_, {0, 0, 0}, mesh_);
    const std::int64_t before = report_.collapsed + report_.flipped;
    for (const Index t : triangles) {
      const auto f = mesh_.face_handle(static_cast<unsigned>(t));
      if (mesh_.status(f).deleted()) continue;
      if (!collapse_short_edge(f, thin)) flip_cap(f, thin);
    }
    std::vector<double> moved;
    for (const auto f : mesh_.faces()) {
      if (!mesh_.status(f).deleted()) moved.push_back(moved_[index(f)]);
    }
    moved_ = std::move(moved);
    rounded_.triangles = remaining_triangles(mesh_);
    return report_.collapsed + report_.flipped > before;
  }

  bool collapse_short_edge(OpenMesh::FaceHandle f, double shortest) {
    std::vector<OpenMesh::HalfedgeHandle> sides(mesh_.cfh_begin(f), mesh_.cfh_end(f));
    std::sort(sides.begin(), sides.end(), [this](auto a, auto b) { return length(a) < length(b); });
    for (const auto h : sides) {
      const double way = length(h);
      if (way > shortest) return false;
      const auto from = mesh_.from_vertex_handle(h);
      const std::vector<OpenMesh::FaceHandle> around(mesh_.cvf_begin(from), mesh_.cvf_end(from));
      if (!collapse(h)) continue;
      move_by(way, around);
      return true;
    }
    return false;
  }

  /// Moves the surface by the triangle's height at most.
  void flip_cap(OpenMesh::FaceHandle f, double highest) {
    const auto side = longest_side(f);
    const auto beside = mesh_.opposite_face_handle(side);
    const auto [a, b, c] = corner_indices(mesh_, f);
    const double way = triangle_height(rounded_.points[a], rounded_.points[b], rounded_.points[c]);
    if (way > highest || !flip(side)) return;
    ++report_.flipped;
    move_by(way, {f, beside});
  }

  /// What was done to some triangles at once moved none of their points farther than so.
  void move_by(double way, const std::vector<OpenMesh::FaceHandle>& triangles) {
    double before = 0;
    for (const auto f : triangles) before = std::max(before, moved_[index(f)]);
    for (const auto f : triangles) moved_[index(f)] = before + way;
  }

  /// @return whether the surface stays a manifold; else nothing is done.
  bool collapse(OpenMesh::HalfedgeHandle h) {
    if (!keeps_manifold(mesh_, h)) return false;
    stands_in_[index(mesh_.from_vertex_handle(h))] = mesh_.to_vertex_handle(h).idx();
    mesh_.collapse(h);
    ++report_.collapsed;
    return true;
  }

  const Vec3& at(OpenMesh::VertexHandle v) const { return rounded_.points[index(v)]; }

  /// Collapses edges whose ends have become equal.
  bool collapse_zero_edges() {
    const std::int64_t before = report_.collapsed;
    for (const auto e : mesh_.edges()) {
      if (mesh_.status(e).deleted()) continue;
      const auto h = mesh_.halfedge_handle(e, 0);
      if (at(mesh_.from_vertex_handle(h)) == at(mesh_.to_vertex_handle(h))) collapse(h);
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
      if (flip(longest_side(f))) ++report_.flipped;
    }
  }

  OpenMesh::HalfedgeHandle longest_side(OpenMesh::FaceHandle f) const {
    auto longest = mesh_.halfedge_handle(f);
    for (auto h = mesh_.cfh_iter(f); h.is_valid(); ++h) {
      if (length(*h) > length(longest)) longest = *h;
    }
    return longest;
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
  std::vector<Index> stands_in_;  // of each point, the one that it was collapsed into, or itself
  std::vector<double> moved_;     // of each triangle at most, by parting it from others that it met
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
  rounding.run();
  return rounding.result();
}

}  // namespace mesamis::detail::decimate
