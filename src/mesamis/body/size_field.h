// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "mesamis/body/body_surface.h"
#include "mesamis/mesh/metric_field.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::body {

/// How large the elements of a body shall be.
struct SizeRules {
  double target = 1;       ///< edge length where nothing asks for less, mm, > 0
  double least = 0.25;     ///< no edge is wanted shorter than this, mm, > 0, at most the target
  double tolerance = 0.1;  ///< mm, > 0: the middle of a triangle of the skin may lie this far off
  double gradation = 0.5;  ///< by how much sizes may grow over a length, no unit, > 0
  int through_wall = 1;    ///< elements between two sides of a wall, as far as `least` allows; 0:
                           ///< walls are not looked at
};

/// The sizes wanted at the points of a surface: the target, but smaller where it is curved, so that
/// a triangle's middle is within the tolerance, and where the object is thin.
/// @param surface    n points, closed, 2-manifold, mm.
/// @param thickness  n, of the wall below each point, mm, see BodySurface::thickness().
/// @return n sizes, mm.
///
/// Triangles of size h cut off an edge, which turns by an angle a, by about h / 2 tan(a / 4). A
/// triangle of size h on a ball of radius r has its middle h^2 / (6 r) below. The radius is that
/// of the mean curvature, from the angles between neighbouring triangles (Meyer et al., Discrete
/// differential-geometry operators, 2003). O(n log n).
std::vector<double> surface_sizes(const TriMesh& surface, std::span<const double> thickness,
                                  const SizeRules& rules);

/// An isotropic metric on a box: surface_sizes() at the surfaces, growing with the distance from
/// them up to the target inside the objects; outside, where elements are not kept, faster.
/// @param surfaces  of the shape, mm.
/// @param box       of the mesh, mm.
///
/// O(points of the surfaces + nodes of the grid), whose spacing is about the target, but at most
/// 160 to a side. The same bits for any number of threads.
GridMetricField size_field(std::span<const TriMesh> surfaces, const BodySurface& shape,
                           const Box& box, const SizeRules& rules);

/// The size that an isotropic field asks for at a point, mm.
/// @param hint  see MetricField::at().
double size_at(const GridMetricField& sizes, const Vec3& p, Index& hint);

/// A size that elements shall have at a point, mm.
struct WantedSize {
  Vec3 point;
  double size = 0;
};

/// The sizes of a field, made smaller around some points, from which they grow with the gradation.
/// @param sizes   isotropic, on the box.
/// @param wanted  at least one.
/// @param rules   of the field.
///
/// O(nodes of the grid), whose spacing is the smallest size wanted, but at most 160 to a side. The
/// same bits for any number of threads.
GridMetricField refined(const GridMetricField& sizes, const Box& box,
                        std::span<const WantedSize> wanted, const SizeRules& rules);

}  // namespace mesamis::detail::body
