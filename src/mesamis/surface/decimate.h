// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

#include "mesamis/base/progress.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

struct DecimateOptions {
  double tolerance = std::numeric_limits<double>::infinity();  ///< mm, >= 0; in both directions
  std::int64_t triangles = 0;  ///< stop at this many; 0: as few as the tolerance allows
  Progress progress{};         ///< stage "decimation"
};

struct DecimateReport {
  std::int64_t triangles_before = 0, triangles_after = 0;
  /// Upper bounds for every point of the surfaces, within 0.4 % (or 1 % of the tolerance), mm.
  double original_to_result = 0, result_to_original = 0;
  int passes = 0;  ///< from the start, each with more points held than the one before
  std::int64_t points_held = 0;
};

/// Fewer triangles, near the same surface: points are removed nearly in the order of their quadric
/// error (where the surface is flat, of the length of the edge), each drawn onto a neighbour, so
/// that what remains is a part of the points, where they were.
///
/// Kept without exception: closed and 2-manifold; the number of components and handles; no pair of
/// triangles that meets unless it did before (see find_self_intersections()); every point of either
/// surface within the tolerance of the other (see max_distance()). What cannot be had so stays as
/// it was. The same bytes every time.
///
/// @param surface  closed, 2-manifold, not empty.
/// @throws InputError  if it is not, or an option is out of range.
/// @throws Cancelled   if progress says stop.
///
/// 30 to 130 us per triangle: most of it goes to the proof that the new triangles lie near.
TriMesh decimate(const TriMesh& surface, const DecimateOptions& options,
                 DecimateReport* report = nullptr);

}  // namespace mesamis
