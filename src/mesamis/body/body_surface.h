// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "mesamis/body/junction_lines.h"
#include "mesamis/remesh/body_shape.h"
#include "mesamis/surface/signed_distance.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::body {

/// Objects that are bounded by surfaces, in a box that may cut them off: object k, counted from 1,
/// is what surface k - 1 holds. Where two overlap, a point is of the one it lies deeper in.
class BodySurface : public BodyShape {
 public:
  /// @param surfaces   closed, 2-manifold, oriented outward, mm; 1 to 255 of them. Where a surface
  ///                   lies on a plane of the box it counts as cut off there.
  /// @param box        around all of them, mm.
  /// @param tolerance  mm, > 0, see BorderPoint; less towards a thin wall or
  ///                   a narrow gap.
  /// @throws InputError  if there is no surface or more than 255, or one that is not sound or has
  ///                     no triangle off the box.
  ///
  /// O(n log n) for n triangles that are not all equally far from a point inside.
  BodySurface(std::span<const TriMesh> surfaces, const Box& box, double tolerance);

  Material material_at(const Vec3& p) const override;
  double crossing(const Vec3& a, const Vec3& b) const override;
  std::optional<double> hidden_crossing(const Vec3& a, const Vec3& b) const override;
  BorderPoint nearest_border(const Vec3& p) const override;
  std::optional<JunctionPoint> nearest_junction(const Vec3& p,
                                                const MaterialTriple& materials) const override {
    return junctions_.nearest(p, materials);
  }

  /// The distance to the surface of one object, negative inside, mm.
  /// @param object  from 1 on.
  /// @param p       mm.
  ///
  /// O(log n) for points near the surface.
  double signed_distance(Material object, const Vec3& p) const;

  /// How thick the wall is below each point of a surface, mm; infinite where there is none.
  /// @param object  from 1 on.
  const std::vector<double>& thickness(Material object) const {
    return parts_[object - 1U]->thickness;
  }

  /// How wide the gap outside each point is, mm; infinite where there is none.
  /// @param object  from 1 on.
  const std::vector<double>& gap(Material object) const { return parts_[object - 1U]->gap; }

 private:
  /// A surface, and what of it does not lie on the box.
  struct Part {
    Box box;
    SignedDistance whole;
    std::optional<SignedDistance> off_box;  ///< none: all of it
    std::vector<double> thickness, gap;     ///< at the points, mm
    std::vector<double> inner, outer;       ///< tolerances of the triangles of skin(), mm
    const SignedDistance& skin() const { return off_box ? *off_box : whole; }
  };
  void measure_walls(Part& part, const TriMesh& surface, const TriMesh& skin) const;
  double distance_beyond(Material material, const Vec3& p) const;
  Vec3 off_planes(const Vec3& p) const;

  Box box_, inner_box_;
  double tolerance_;
  std::vector<std::unique_ptr<Part>> parts_;
  JunctionLines junctions_;
};

}  // namespace mesamis::detail::body
