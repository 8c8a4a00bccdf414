// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/decimate/decimate.h"

namespace mesamis::detail::decimate {

/// Reduces the number of triangles of several objects at once, see simplify_partition(). Where
/// objects share triangles they go on sharing them; where they share points alone, they still meet
/// there. All points are values of single precision, see round_together().
///
/// @param objects  n triangles, mm; each closed, 2-manifold, not empty. Points of two objects are
///                 the same where their coordinates are equal.
/// @param options  as for decimate(); the number of triangles is that of all objects, where those
///                 that two share count once.
/// @param reports  optional: one for each object; its distances are upper bounds as those of
///                 simplify(), measured against the object as it was given.
/// @return one surface for each object, in their order. The same bits for any number of threads.
/// @throws InputError  as decimate_partition(), and for coordinates beyond single precision.
/// @throws Cancelled   if progress returns false.
///
/// O(n log n).
std::vector<TriMesh> simplify_objects(const std::vector<TriMesh>& objects,
                                      const DecimateOptions& options,
                                      std::vector<DecimateReport>* reports = nullptr);

}  // namespace mesamis::detail::decimate
