// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/decimate/cover.h"
#include "mesamis/decimate/decimate.h"
#include "mesamis/surface/partition.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::decimate {

/// Moves the points of a decimated surface so that it lies on both sides of the original.
///
/// Collapses leave the points where they were: on a bend all triangles lie on its inner side, by
/// half of their greatest distance in the mean. Here each point moves along its normal, all of them
/// to the least squares of the distances of the original's points, weighted by area. This halves
/// the distance of the surfaces and more, at the same number of triangles.
///
/// What decimate() promises stays: moves that would make triangles meet, turn one over, make a
/// crease of more than 25 degrees, or take either surface out of the tolerance of the other are
/// halved, and in the end taken back. Points of sharp edges and of flat parts, as where the box of
/// a scan cuts the object, stay. All points are values of single precision, as those of the original
/// must be.
/// @param decimated  as decimate() returns it; taken over.
/// @param original   what was decimated, mm; n triangles.
/// @param tolerance  mm, > 0, finite.
/// @param report     optional: the distances that decimate() proved; then those after the moves, where
///                   these are greater to within kDistanceSlack.
/// @return the same triangles. The same bits for any number of threads.
///
/// O(n log n): about two searches for each original point, and one for each triangle of both.
TriMesh refit(TriMesh decimated, const TriMesh& original, double tolerance,
              DecimateReport* report = nullptr);

/// The same where it is known what the triangles stand for, and how near: hardly any needs a search
/// then.
/// @param decimated  as decimate_to_cover() returns it for a finite tolerance; taken over.
TriMesh refit(Cover decimated, const TriMesh& original, double tolerance,
              DecimateReport* report = nullptr);

/// The same for the boundaries of a partition: each interface is refitted to its own original, and
/// points where other than one pair of sides meet stay.
/// @param decimated  as decimate_partition() returns it; taken over.
/// @throws InputError  if there is not a pair of sides for each triangle, or no triangle of a pair of
///                     sides that the original has.
PartitionSurface refit_partition(PartitionSurface decimated, const PartitionSurface& original,
                                 double tolerance);

}  // namespace mesamis::detail::decimate
