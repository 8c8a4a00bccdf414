// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/decimate/decimate.h"
#include "mesamis/decimate/interfaces.h"
#include "mesamis/decimate/patchwork.h"

namespace mesamis::detail::decimate {

/// Triangles of a patch, about, so that what is looked at stays in a processor's cache. Surfaces of
/// less than two are one patch.
inline constexpr double kTrianglesPerPatch = 4000;

/// Checks the options of decimate() and decimate_partition().
/// @throws InputError  if one is out of range.
void require_valid(const DecimateOptions& options);

/// Decimates a surface patch by patch, in the boxes of a lattice; then its seams, in the boxes of
/// one of twice the side, and so on; in the end what is left of them in one piece. Where the number
/// of triangles is given, and for less than two patches, there is one patch: the order of all
/// collapses decides then.
/// @param surface              closed, 2-manifold.
/// @param options              valid; the tolerance is not 0. Progress grows, and is never called
///                             by two threads at once.
/// @param triangles_per_patch  about, > 0.
/// @return over the points of the surface; some are not used. The same bits for any number of
///         threads.
/// @throws Cancelled  if progress returns false.
///
/// As decimate().
Cover decimate_surface(const TriMesh& surface, const DecimateOptions& options,
                       double triangles_per_patch, PatchworkReport& report);

/// What decimate_part() does.
/// @param triangles_per_patch  about, > 0; of a part that has not been decimated before.
Cover decimate_patches(const TriMesh& original, Cover part, const std::vector<char>& held,
                       const DecimateOptions& options, double triangles_per_patch);

/// The same for interfaces: where curves meet, points stay.
/// @return over the points of the interfaces.
TriMesh decimate_interfaces(const Interfaces& interfaces, const DecimateOptions& options,
                            double triangles_per_patch, PatchworkReport& report);

}  // namespace mesamis::detail::decimate
