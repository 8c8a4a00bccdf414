// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesamis/surface/tri_mesh.h"
#include "mesamis/surface/triangle_shapes.h"

/// Surfaces whose triangles suit other meshers: skins of bodies in place of the surfaces that the
/// bodies were made of.
namespace mesamis::detail::report {

/// How well a surface for meshers keeps what it promises.
struct MeshingQuality {
  TriangleShapes triangles;             ///< promised: 20 degrees at least, 0.99 above 30
  double tolerance = 0;                 ///< promised for both distances, mm
  double to_given = 0;                  ///< greatest distance to the surface it stands for, mm
  double from_given = 0;                ///< and of that surface to it, mm
  std::int64_t self_intersections = 0;  ///< pairs of triangles; promised: none
};

/// What of the promise was missed, as "least angle of 12.3 degrees, expected 20; ..."; empty: it
/// was kept.
std::string unmet(const MeshingQuality& quality);

/// Compares a surface for meshers with the one that it stands for.
/// @param surface    n triangles, mm.
/// @param given      m triangles, mm.
/// @param tolerance  mm, > 0.
/// @throws InputError  if one has no triangle or is not sound.
///
/// O((n + m) log m), see max_distance() and find_self_intersections().
MeshingQuality meshing_quality(const TriMesh& surface, const TriMesh& given, double tolerance);

/// Carries errors that are expected at the points of a surface over to one that stands for it: at
/// each point that of the nearest point, and the distance to there, as root of the sum of squares.
/// Where nothing is expected, at the border of the scan, nothing is added.
/// @param surface  closed, 2-manifold, outward, n triangles, mm.
/// @param errors   one per point of the surface, mm, >= 0.
/// @param points   m, mm.
/// @return m values, mm.
/// @throws InputError  if the surface has no triangle or is not sound.
///
/// O((n + m) log n) for points near the surface. The same bits for any number of threads.
std::vector<double> carried_errors(const TriMesh& surface, const std::vector<double>& errors,
                                   const std::vector<Vec3>& points);

}  // namespace mesamis::detail::report
