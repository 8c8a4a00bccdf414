// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>

#include "mesamis/base/progress.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis {

/// How far and how long to decimate.
struct DecimateOptions {
  double tolerance = std::numeric_limits<double>::infinity();  ///< mm, >= 0; in both directions
  std::int64_t triangles = 0;  ///< stop at this many; 0: as few as the tolerance allows
  Progress progress{};         ///< stage "decimation"
  /// Collapse only where a bound proves the tolerance that needs no search: about three times as
  /// fast. The bounds of a point's collapses add up: 1.6 times the triangles where few collapses
  /// reach the tolerance, twice to four times where it is loose. Needs a finite tolerance.
  bool quick = false;
};

/// What decimate() did.
struct DecimateReport {
  std::int64_t triangles_before = 0, triangles_after = 0;
  /// Upper bounds of the one-sided Hausdorff distances, mm, see max_distance(): 0.4 %, or 1 % of
  /// the tolerance, above the true ones at most. With DecimateOptions::quick both are the bound
  /// that proved the tolerance, which may be several times above.
  double original_to_result = 0, result_to_original = 0;
  int passes = 0;  ///< over one patch, each with more points held than the one before, at most
  std::int64_t points_held = 0;
};

/// Reduces the number of triangles while the surface stays within a tolerance.
///
/// Half-edges are collapsed nearly in the order of their quadric error, on flat parts in the order
/// of their length. Each collapse moves a point onto a neighbour: the points of the result are
/// points of the surface.
///
/// The result always keeps these properties: it is closed and 2-manifold; it has as many components
/// and handles; no pair of triangles intersects unless it did before (see
/// find_self_intersections()); every point of either surface is within the tolerance of the other
/// (see max_distance()). A part that cannot be decimated so stays as it was.
///
/// @param surface  n triangles, mm; closed, 2-manifold, not empty.
/// @param report   optional; its distances cost as much as a pass.
/// @return the same bits for any number of threads.
/// @throws InputError  if the surface is not as above, or an option is out of range.
/// @throws Cancelled   if progress returns false.
///
/// Takes about 30 to 130 us per triangle, most of it to prove that the new triangles lie near;
/// O(n log n) with up to 24 passes over each patch of 40 000 triangles.
TriMesh decimate(const TriMesh& surface, const DecimateOptions& options,
                 DecimateReport* report = nullptr);

}  // namespace mesamis
