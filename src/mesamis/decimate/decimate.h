// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

#include "mesamis/base/progress.h"
#include "mesamis/decimate/cover.h"
#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::decimate {

/// How far and how long to decimate.
struct DecimateOptions {
  double tolerance = std::numeric_limits<double>::infinity();  ///< mm, >= 0; in both directions
  std::int64_t triangles = 0;  ///< stop at this many; 0: as few as the tolerance allows
  Progress progress{};         ///< stage "decimation"
};

/// What decimate() did.
struct DecimateReport {
  std::int64_t triangles_before = 0, triangles_after = 0;
  /// Upper bounds of the one-sided Hausdorff distances, mm, as they were proved: at most the
  /// tolerance. Without one they are measured, see max_distance().
  double original_to_result = 0, result_to_original = 0;
};

/// Reduces the number of triangles while the surface stays within a tolerance.
///
/// Edges are collapsed nearly in the order of their quadric error, on flat parts in the order of
/// their length, to the place where that error is least (Garland and Heckbert 1997) or one near the
/// edge; within a tolerance edges flip, too, where that makes the surface smoother. Points on
/// planes across an axis, as where the box of a scan cuts the object, stay on them. All new points
/// are values of single precision.
///
/// The result always keeps these properties: it is closed and 2-manifold; it has as many components
/// and handles; no pair of triangles intersects unless it did before (see
/// find_self_intersections()); every point of either surface is within the tolerance of the other
/// (see max_distance()).
///
/// @param surface  n triangles, mm; closed, 2-manifold, not empty.
/// @param report   optional.
/// @return the same bits for any number of threads.
/// @throws InputError  if the surface is not as above, or an option is out of range.
/// @throws Cancelled   if progress returns false.
///
/// O(n log n).
TriMesh decimate(const TriMesh& surface, const DecimateOptions& options,
                 DecimateReport* report = nullptr);

/// The same, with what was proved of each triangle: nothing unless the tolerance is positive and
/// finite.
Cover decimate_to_cover(const TriMesh& surface, const DecimateOptions& options,
                        DecimateReport* report = nullptr);

}  // namespace mesamis::detail::decimate
