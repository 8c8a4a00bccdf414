// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/surface/tri_mesh.h"

/// Distances between surfaces, equations (14)-(16) of the paper.
namespace mesamis {

/// Distance (16) of each point to the nearest point of the surface: inside a triangle, on an edge
/// or at a corner.
///
/// Exact up to round-off; a triangle whose height is below 1e-8 of its length counts as its edges.
/// @param points   n points, mm.
/// @param surface  m triangles, mm.
/// @return n distances, mm.
/// @throws InputError  if the surface has no triangle or is not sound, or a point is not finite.
///
/// O((m + n) log m) for points near the surface. The same bits for any number of threads.
std::vector<double> distances_to_surface(std::span<const Vec3> points, const TriMesh& surface);

/// One-sided Hausdorff distance: the greatest distance of any point of `from`, insides of triangles
/// included, to the surface `to`.
///
/// The triangles are cut along those of `to` until on each piece the distance to one triangle, a
/// convex function that is greatest at a corner, bounds the distance closely enough.
///
/// @param from, to  mm.
/// @param fine      mm, > 0: parts nearer than this are not cut further.
/// @return mm; an upper bound up to round-off, at most 0.4 % or `fine` above the true value.
/// @throws InputError  if a surface has no triangle or is not sound.
///
/// O((m + n) log m) for n triangles of `from` near m triangles of `to`; more where `from` lies
/// equally far from several parts of `to`. The same bits for any number of threads.
double max_distance(const TriMesh& from, const TriMesh& to, double fine);

/// The parameter `fine` of max_distance() that suits a tolerance: a hundredth of it, or a millionth
/// of the diagonal of the surface's box if the tolerance is infinite.
/// @param surface    n points, mm.
/// @param tolerance  mm, > 0.
/// @return mm.
double fine_enough(const TriMesh& surface, double tolerance);

/// Statistics of distances, mm.
struct DistanceSummary {
  std::size_t count = 0;
  double mean = 0;          ///< (15)
  double rms = 0;           ///< root mean square
  double p95 = 0, p99 = 0;  ///< the smallest value that 95 % (99 %) of the values do not exceed
  double max = 0;           ///< (14)
};

/// Summarizes distances.
/// @param distances  n values in mm, finite.
/// @return all zero for no distances.
DistanceSummary summarize(std::vector<double> distances);

}  // namespace mesamis
