// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/decimate/collapse.h"
#include "mesamis/decimate/flip.h"
#include "mesamis/surface/box_tree.h"

namespace mesamis::detail::decimate {

/// Finds the triangles that a collapse would make intersect. Exact.
class CollapseIntersections {
 public:
  /// @param first_copies  of each point, the first one at the same place that is to be taken for the
  ///                      same; empty: all differ.
  CollapseIntersections(const EditableSurface& surface, const std::vector<Vec3>& points,
                        std::vector<Index> first_copies);

  /// Whether a triangle that changes would intersect another one, or have no area.
  /// @param points     as they are; the kept points are moved meanwhile.
  /// @param collapses  made at once: one, or those of all interfaces at an edge of a curve.
  bool occur(const EditableSurface& surface, std::vector<Vec3>& points,
             std::span<const Collapse> collapses);
  /// The same for a flip that has been made.
  bool occur(const EditableSurface& surface, const std::vector<Vec3>& points, const Flip& flip);
  /// Takes over a collapse that has been done.
  void apply(const Collapse& collapse);
  void apply(const Flip& flip);

 private:
  struct Changed {
    Triangle triangle;
    const Corners& corners;
  };

  bool meets(const std::vector<Vec3>& points, const Triangle& a, const Triangle& b) const;
  template <class Changes>
  void look_near(const EditableSurface& surface, const std::vector<Vec3>& points, const Box& whole,
                 Changes&& changes);
  bool meets_others(const std::vector<Vec3>& points, const Changed& own) const;

  std::vector<Index> first_copies_;
  BoxTree tree_;
  struct Near {
    Triangle triangle;
    Corners corners;
    Box box;
  };
  std::vector<Near> near_;
  std::vector<Vec3> before_;  // of the kept points
  std::vector<Changed> changed_;
};

}  // namespace mesamis::detail::decimate
