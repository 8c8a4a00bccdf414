// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "mesamis/fit/surface_moves.h"
#include "mesamis/image/spline_image.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::method {

/// What follow_image() has to know.
struct FollowOptions {
  double level = 0;        ///< of the surface, grey values
  double noise = 0;        ///< standard deviation in the image, grey values, >= 0
  double point_scale = 1;  ///< mm per unit of the surface's coordinates, > 0
  bool to_image = true;    ///< points move towards the level set
  bool smooth = false;     ///< then towards their neighbours
  /// For a preview, in a third of the time: edges are split once, where the level set leaves them by
  /// more than 0.1 voxel; smoothing ends at a hundredth of its residual; triangles may still meet
  /// before they are rounded to single precision.
  bool draft = false;
};

/// Moves a surface that was extracted from a mesh towards the level set of the image, as far as the
/// image's noise can be told from what the mesh's cells could not follow, and smooths it.
///
/// Where a scan has little noise, cells of several voxels are the larger error: they cut bends and
/// fine structures. Edges of more than 1.4 voxels are split where the level set leaves them by more
/// than the noise (and 0.03 voxel), unless a triangle of theirs is less high than 0.002 voxel. Each
/// point's distance d to the level set along the normal is (I - level) / slope, the noise's share
/// of it N = noise / slope. With the local mean m and variance V of d along the surface (Lee 1980),
/// the point moves by
///   a m + k (d - m),   k = max(0, 1 - N^2 / V),   a = max(0, 1 - 0.2 N^2 / m^2),
/// three times, by no more than 0.7 voxels in all, and never out of the image's box. Points where the
/// image is too flat to tell stay, as do those on the box; edges between two of these are not split.
///
/// Smoothing lowers the terraces of thick slices, see without_terraces(), then takes off the ripples of
/// noise and of single voxels: the points x move, by no more than a quarter of a voxel, from where
/// they are, x_0, to the least of
///   sum of w |x - x_0|^2 + 6 |L x|^2,   w = (3 / t)^2 min(max((0.15 / N)^2, 1), 4),
/// with the umbrella operator L and the thickness t, at most 3 voxels, that the object has behind
/// the point or a neighbour: thin walls and struts, which bending would shrink, are held more
/// firmly.
///
/// Moves that would make the surface meet itself are taken back. Where noise outweighs everything
/// that the image could tell, points do not move towards it.
/// @param surface  in the grid's own axes; without self-intersections.
/// @param image    in grey values; its bounds do not count here.
/// @return where edges were split, points along a Morton curve: neighbours are near in memory; the
///         surface as it was, where it neither moves to the image nor is smoothed.
/// @throws InputError  as require_sound().
///
/// O(n log n) for n points after splitting, at most about two per square voxel of the surface.
TriMesh follow_image(const TriMesh& surface, const SplineImage& image,
                     const FollowOptions& options);

/// A part of a surface, which may be open, and what has become of its points.
struct FollowedPart {
  TriMesh extracted;        ///< in the grid's own axes; points that were split off lie on it
  std::vector<Vec3> moved;  ///< of each point where it is now
  /// A HeldPoint of each: free ones are moved. Those on the box become held. Held ones that were
  /// moved before are fixed, since their edges do not lie where they were extracted.
  std::vector<char> held;
};

/// How far a point moves at most, in the unit of a surface in such a grid.
/// @param point_scale  mm per unit, > 0.
double most_followed(const VoxelGrid& grid, double point_scale);

/// Moves the free points of a part, as follow_image() does with all of a surface that is worth it.
/// Points that are split off are free. Cost as follow_image().
/// @param part  its free points lie where they were extracted.
void follow_part(FollowedPart& part, const SplineImage& image, const FollowOptions& options);

/// What the image tells at the points of a surface, or of a part of one.
FollowCounts look_along(const TriMesh& surface, const SplineImage& image,
                        const FollowOptions& options);

}  // namespace mesamis::detail::method
