// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "mesamis/surface/tri_mesh.h"

/// Distances between surfaces, equations (14)-(16) of the paper.
namespace mesamis {

/// Distance (16) of each point to the nearest point of the surface, mm: to a triangle's inside,
/// edge or corner, not to its points alone.
///
/// Exact up to round-off; the inside of a triangle lower than 1e-8 of its length counts as its
/// edges.
/// @throws InputError  if the surface has no triangle or is not sound, or a point is not finite.
///
/// O((m + n) log m) for n points near a surface of m triangles.
std::vector<double> distances_to_surface(std::span<const Vec3> points, const TriMesh& surface);

/// The greatest distance of any point of `from`, insides of triangles included, to the surface
/// `to`: an upper bound up to round-off, and at most 0.4 % or `fine` above the true value.
///
/// The triangles are cut along those of `to` until on each piece the distance to one triangle, a
/// convex function that is greatest at a corner, says enough.
/// @param fine  mm, > 0: what is nearer than this is not looked at any closer.
/// @throws InputError  if a surface has no triangle or is not sound.
double max_distance(const TriMesh& from, const TriMesh& to, double fine);

/// What is fine enough for max_distance() where a tolerance is judged: a hundredth of it, or a
/// millionth of the surface's box where it is infinite. mm.
double fine_enough(const TriMesh& surface, double tolerance);

/// Points spread evenly by area over the surface, the same for the same surface and count: one in
/// each of `count` equal shares of the area, in the order of the triangles; the places within
/// the triangles follow a sequence of low discrepancy.
/// @throws InputError  if the surface is not sound, or has no area and count is not 0.
std::vector<Vec3> sample_by_area(const TriMesh& surface, std::size_t count);

struct DistanceSummary {
  std::size_t count = 0;
  double mean = 0;  ///< (15), mm
  double rms = 0;
  double p95 = 0, p99 = 0;  ///< the smallest value that 95 % (99 %) of the values do not exceed
  double max = 0;           ///< (14), mm
};
/// All zero for no distances.
DistanceSummary summarize(std::vector<double> distances);

}  // namespace mesamis
