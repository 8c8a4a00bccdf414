// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/decimate/decimate.h"
#include "mesamis/surface/partition.h"

namespace mesamis::detail::decimate {

/// Reduces the number of triangles of several objects at once, within a tolerance.
///
/// The boundaries are cut into interfaces along the curves where three or more objects meet (or two
/// and the outside of the box). Each interface is decimated as decimate() does; an edge of a curve
/// is collapsed in all interfaces that meet there at once. So objects go on sharing their
/// triangles.
///
/// The result always keeps these properties: each object is closed and 2-manifold if it was, and
/// has as many components and handles; no pair of triangles intersects unless it did before, within
/// one object or between two; every point of each interface is within the tolerance of the same
/// interface before, and the reverse; curves meet where they met, and are as many.
///
/// @param partition  n triangles, mm; of extract_partition() or extract_partition_on_grid(). It may
///                   be open: rims stay as they are.
/// @param options    as for decimate(); the number of triangles is that of all boundaries.
/// @param report     optional; its distances are the greatest over all interfaces.
/// @return the points in their order, those that are still used. The same bits for any number of
///         threads.
/// @throws InputError  if the triangles have no sides, the edges between two triangles do not make
///                     2-manifold interfaces of one orientation, or an option is out of range.
/// @throws Cancelled   if progress returns false.
///
/// Costs as much as decimate(). Limits: points where curves meet or end stay, as do those where an
/// interface touches itself.
PartitionSurface decimate_partition(const PartitionSurface& partition,
                                    const DecimateOptions& options,
                                    DecimateReport* report = nullptr);

}  // namespace mesamis::detail::decimate
