// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <span>
#include <vector>

#include "mesamis/surface/components.h"

namespace mesamis::detail::surface {

/// Which component of a closed surface lies in which.
struct Nesting {
  std::vector<Index> parent;  ///< the smallest component around each; kNoIndex: none
  std::vector<int> depth;     ///< how many are around it: even for the skin of an island, odd for
                              ///< the wall of a cavity
};

/// A point of each component: of its first triangle.
/// @param surface     m triangles, mm.
/// @param components  of the surface.
std::vector<Vec3> component_feet(const TriMesh& surface, const SurfaceComponents& components);

/// Of the ray of each component, how often it crosses each of the others.
using RayCrossings = std::vector<std::map<Index, int>>;

/// Counts where rays cross a closed surface or a piece of it: what the pieces have adds up. Rays
/// that meet edges and points are counted correctly, also where pieces share these.
/// @param feet          n points, one of each component, mm; its ray goes from there towards -x.
/// @param piece         m triangles, mm.
/// @param component_of  m components; kNoIndex: none.
///
/// O(m root n) in the mean.
RayCrossings ray_crossings(std::span<const Vec3> feet, const TriMesh& piece,
                           std::span<const Index> component_of);

/// Finds the nesting by the parity of the crossings with the whole surface.
/// @param crossings  of n components.
///
/// O(n log n) for few components around each.
Nesting nesting_of(RayCrossings crossings);

/// Finds the nesting of the components of a surface.
/// @param surface     m triangles, mm; closed, without self-intersections.
/// @param components  of the surface.
///
/// O(m root n) in the mean for n components.
Nesting find_nesting(const TriMesh& surface, const SurfaceComponents& components);

}  // namespace mesamis::detail::surface
