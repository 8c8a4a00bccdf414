// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "mesamis/remesh/body_shape.h"
#include "mesamis/surface/tri_mesh.h"
#include "mesamis/surface/triangle_tree.h"

namespace mesamis::detail::body {

/// The lines where three materials meet: edges of surfaces that share triangles.
class JunctionLines {
 public:
  /// @param surfaces  surface k bounds material k + 1, in mm. What two share has the same corners,
  ///                  bit for bit, in both; other surfaces have no junctions.
  ///
  /// O(n log n) for n triangles at points of more than one surface.
  explicit JunctionLines(std::span<const TriMesh> surfaces);

  /// As BodyShape::nearest_junction(). O(log m) for the m edges of the line, near it.
  std::optional<JunctionPoint> nearest(const Vec3& p, const MaterialTriple& materials) const;

  /// How many edges the lines have.
  std::int64_t edges() const { return edges_; }

 private:
  std::map<MaterialTriple, TriangleTree> lines_;
  std::int64_t edges_ = 0;
};

}  // namespace mesamis::detail::body
