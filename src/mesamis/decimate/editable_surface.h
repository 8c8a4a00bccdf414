// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::decimate {

/// The half-edges of a surface, for what changes its connectivity, in flat arrays: half-edge 3 t + i
/// runs from corner i of triangle t to the next corner.
class EditableSurface {
 public:
  /// @param points     how many.
  /// @param triangles  a 2-manifold with one orientation, which may be open.
  EditableSurface(std::size_t points, const std::vector<Triangle>& triangles);

  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
  Index from(Index h) const { return corners_[h]; }
  Index to(Index h) const { return corners_[next(h)]; }
  /// Of a half-edge's ends the one that is not given.
  Index other_end(Index h, Index end) const { return from(h) == end ? to(h) : from(h); }
  /// kNoIndex at a rim.
  Index opposite(Index h) const { return opposite_[h]; }
  /// kNoIndex of a point without triangles.
  Index leaving(Index point) const { return leaving_[point]; }
  /// The next half-edge that leaves the same point, counter-clockwise; kNoIndex beyond a rim.
  Index rotated(Index h) const { return opposite_[previous(h)]; }
  Triangle triangle(Index t) const {
    return {corners_[3 * t], corners_[3 * t + 1], corners_[3 * t + 2]};
  }
  /// How many points.
  std::size_t points() const { return leaving_.size(); }
  /// Of triangles that were there in the beginning.
  Index count() const { return static_cast<Index>(corners_.size() / 3); }
  bool is_removed(Index t) const { return corners_[3 * t] == kNoIndex; }
  /// Whether triangles lie all around a point, in one fan.
  bool is_inner(Index point) const { return is_inner_[point] != 0; }

  /// Calls visit(h) for the half-edges that leave a point, counter-clockwise.
  template <class Visit>
  void for_each_leaving(Index point, Visit&& visit) const {
    const Index first = leaving_[point];
    Index h = first;
    while (h != kNoIndex) {
      visit(h);
      h = rotated(h);
      if (h == first) return;
    }
  }

  /// Calls visit(h, q) for the edges of a point, each once, and their other ends, in
  /// counter-clockwise order: by half-edges that leave it, the last at a rim by one that arrives.
  template <class Visit>
  void for_each_edge_at(Index point, Visit&& visit) const {
    for_each_leaving(point, [&](Index h) {
      visit(h, to(h));
      if (rotated(h) == kNoIndex) visit(previous(h), from(previous(h)));
    });
  }

  /// Calls visit(q) for the points that share an edge with a point, each once.
  template <class Visit>
  void for_each_neighbor(Index point, Visit&& visit) const {
    for_each_edge_at(point, [&](Index, Index q) { visit(q); });
  }

  /// Whether the surface stays a 2-manifold, without triangles that coincide, when the first point of
  /// a half-edge is collapsed onto its second. The first must be an inner point.
  bool may_collapse(Index h) const;

  /// Removes the first point of a half-edge and the triangles on both sides of it.
  void collapse(Index h);

  /// Whether the edge of a half-edge that is not at a rim may give way to one between the two points
  /// opposite to it: these have none yet, and its ends keep three triangles or more.
  bool may_flip(Index h) const;

  /// Flips it. Its half-edges are those of the new edge: this one now runs from the point to its right
  /// to the one to its left.
  void flip(Index h);
  /// Takes the last flip back.
  void flip_back(Index h);

  /// The same for a half-edge at a rim of which one end is to go: whether the surface stays a
  /// 2-manifold with as many rims.
  bool may_collapse_at_rim(Index h, Index removed) const;

  /// Removes one end of a half-edge at a rim and the triangle beside it.
  void collapse_at_rim(Index h, Index removed);

  /// The half-edge at a rim that ends in a point of the rim.
  Index arriving_at_rim(Index point) const;

 private:
  void link(Index a, Index b);
  void remove_triangle_at(Index h);
  int triangles_at(Index point) const;

  std::vector<Index> corners_, opposite_;  // of each half-edge
  std::vector<Index> leaving_;             // of each point; at a rim the first counter-clockwise
  std::vector<char> is_inner_;             // of each point
};

}  // namespace mesamis::detail::decimate
