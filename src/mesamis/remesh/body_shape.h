// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::remesh {

/// A point of the border between materials.
struct BorderPoint {
  Vec3 point;            ///< mm
  double tolerance = 0;  ///< how far the middle of a triangle of the skin may lie from there, mm
};

/// Three materials in rising order, of which the outside may be one.
using MaterialTriple = std::array<Material, 3>;

/// A point of a line where three materials meet.
struct JunctionPoint {
  Vec3 point;      ///< mm
  Vec3 direction;  ///< of the line there, of length 1
};

/// Where the materials of a body lie, as remesh_body() asks for it. Implementations are immutable:
/// any number of threads may call them at once.
class BodyShape {
 public:
  virtual ~BodyShape() = default;

  /// The material at a point.
  /// @param p  mm, in the box of the mesh.
  virtual Material material_at(const Vec3& p) const = 0;

  /// Where the way from a to b, whose materials differ, leaves that of a.
  /// @param a, b  mm.
  /// @return the share of the way, 0 to 1.
  virtual double crossing(const Vec3& a, const Vec3& b) const = 0;

  /// Where the way from a to b, of one material, lies deepest in another.
  /// @param a, b  mm.
  /// @return the share of the way, 0 to 1; none if it nowhere lies deeper than the tolerance.
  virtual std::optional<double> hidden_crossing(const Vec3& a, const Vec3& b) const = 0;

  /// The nearest point of the border between materials; faces of the mesh's box do not count.
  /// @param p  mm.
  virtual BorderPoint nearest_border(const Vec3& p) const = 0;

  /// The nearest point of the line where three materials meet.
  /// @param p  mm.
  /// @return none if they nowhere do.
  virtual std::optional<JunctionPoint> nearest_junction(const Vec3& p,
                                                        const MaterialTriple& materials) const = 0;
};

}  // namespace mesamis::detail::remesh
