// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/decimate/collapse.h"
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
  /// @param points  as they are; the kept point is moved meanwhile.
  bool occur(const EditableSurface& surface, std::vector<Vec3>& points, const Collapse& collapse);
  /// Takes over a collapse that has been done.
  void apply(const Collapse& collapse);

 private:
  bool meets(const std::vector<Vec3>& points, const Triangle& a, const Triangle& b) const;

  std::vector<Index> first_copies_;
  BoxTree tree_;
  struct Near {
    Triangle triangle;
    Corners corners;
    Box box;
  };
  std::vector<Near> near_;
};

}  // namespace mesamis::detail::decimate
