// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "mesamis/decimate/collapse.h"
#include "mesamis/decimate/interfaces.h"
#include "mesamis/decimate/patch.h"

namespace mesamis::detail::decimate {

/// The curves along which the interfaces of a patch meet. Each interface has its own copy of the
/// points of a curve, and a half-edge at its rim for each edge of it: an edge is collapsed in all
/// interfaces at once.
class Curves {
 public:
  /// @param patch  of these interfaces.
  Curves(const Interfaces& interfaces, const Patch& patch);

  /// Of the copies of each point, the first one in the patch.
  const std::vector<Index>& first_copies() const { return first_copies_; }
  /// Whether a point is on a curve, or one of copies.
  bool holds(Index p) const { return at_rim_[p] != 0; }
  /// Whether two points may get an edge. Of points on curves the patch must have all edges, and none
  /// between them in any interface; so of a point at which an interface touches itself, and any other.
  bool may_join(const EditableSurface& surface, Index a, Index b) const {
    if (holds(a) && holds(b)) {
      return has_all_edges_[a] != 0 && has_all_edges_[b] != 0 && !has_edge(surface, a, b);
    }
    const Index touching = touches_itself_[a] != 0 ? a : b;
    if (touches_itself_[touching] == 0) return true;
    return has_all_edges_[touching] != 0 && !has_edge(surface, a, b);
  }
  /// Whether a point may go along its curve: it is one within a curve, the patch has all its copies
  /// and edges, and holds none.
  bool may_go(Index p) const { return may_go_[p] != 0; }

  /// Calls visit(q) for the copies of a point in the patch, in order.
  template <class Visit>
  void for_each_copy(Index p, Visit&& visit) const {
    const auto end = static_cast<Index>(first_copies_.size());
    for (Index q = first_copies_[p]; q < end && first_copies_[q] == first_copies_[p]; ++q) visit(q);
  }

  /// The half-edges of the interfaces at an edge of a curve, increasing: those in the patch.
  /// @param h  one of them.
  std::vector<Index> half_edges_at(const EditableSurface& surface, Index h) const;

  /// Whether one end of an edge of a curve may be collapsed onto the other: each interface stays a
  /// 2-manifold with as many rims, and no two interfaces get the same edge but along curves.
  /// @param half_edges  of half_edges_at().
  /// @param removed     a copy of a point that may go.
  bool may_collapse(const EditableSurface& surface, const std::vector<Index>& half_edges,
                    Index removed) const;

  /// The end of a half-edge that is a copy of a point; else the start.
  Index copy_at(const EditableSurface& surface, Index h, Index point) const {
    const Index to = surface.to(h);
    return first_copies_[to] == first_copies_[point] ? to : surface.from(h);
  }

 private:
  bool has_edge(const EditableSurface& surface, Index a, Index b) const;

  std::vector<Index> first_copies_;
  std::vector<char> at_rim_, may_go_, has_all_edges_, touches_itself_;
};

/// Whether an edge of a curve between two interfaces would become a crease, see kCrease, by a
/// collapse that changes a triangle there but not the edge.
/// @param normals  of each triangle, unit length or 0.
bool bends_curve(const EditableSurface& surface, const std::vector<Vec3>& normals,
                 const Curves& curves, const Collapse& collapse);

/// Whether creases between two interfaces would grow by more than a tenth where an edge of a curve
/// is collapsed.
/// @param normals    as above.
/// @param collapses  of this edge, one for each interface.
bool spoils_curve(const EditableSurface& surface, const std::vector<Vec3>& points,
                  const std::vector<Vec3>& normals, const std::vector<Collapse>& collapses);

}  // namespace mesamis::detail::decimate
