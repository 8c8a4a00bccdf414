// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/decimate/decimate.h"
#include "mesamis/surface/partition.h"

namespace mesamis::detail::decimate {

/// Reduces the number of triangles, see decimate(), and then moves the points to lie as near to the
/// surface before as they can, see refit().
///
/// Decimation takes 0.6 of the tolerance and leaves the rest to the points: at equal numbers of
/// triangles the mean distance is less than with all of it. Without a finite tolerance > 0 only
/// decimation is done.
/// @param surface  as for decimate(); its coordinates are values of single precision.
/// @param report   optional; its distances are measured, see max_distance().
/// @return the same bits for any number of threads.
/// @throws InputError, Cancelled  as decimate().
TriMesh simplify(const TriMesh& surface, const DecimateOptions& options,
                 DecimateReport* report = nullptr);

/// The same for boundaries of several objects, see decimate_partition() and refit_partition().
/// @param report  optional; its distances are those that were proved: the tolerance at most.
PartitionSurface simplify_partition(const PartitionSurface& partition,
                                    const DecimateOptions& options,
                                    DecimateReport* report = nullptr);

}  // namespace mesamis::detail::decimate
