// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "mesamis/image/edge_sides.h"
#include "mesamis/image/volume.h"

/// What a scanner adds to what it sees, as far as the image itself tells.
namespace mesamis {

/// Standard deviation of the image's noise, native units: of the differences between voxels and
/// the mean of their 3x3x3 neighbourhood, two and a half voxels outside and inside of the object's
/// surface, where no edge is near; robust (from medians), so that impulses do not count, and of the
/// quieter side, for spongy bone is no noise. Noise that varies over many voxels is not seen.
/// @param guide  the same, smoothed: says on which side of the level a point is.
/// @return 0 if there are fewer than ten such places.
double measure_noise(const Volume& volume, const Volume& guide,
                     const std::vector<SurfacePoint>& points, double level);

/// Standard deviation of the image's blur along each axis, voxels.
///
/// Along the normals of the points whose normal is nearly an axis' the image is averaged (median)
/// at equal distances from the surface; a Gaussian edge is fitted to either half of this profile
/// (the sharper counts: the next tissue or the far side of a wall widens the other), and what the
/// interpolation and the scatter of the points (they were found in noise) add is taken off. Axes
/// that too few normals follow get the profile of all points. No axis gets more than half as much
/// again as the middle one of the three, nor more than two voxels. Includes the voxels' own extent:
/// partial volume alone is 0.29.
/// @param points  crossing_points() of smoothed(smoothed(volume)) at the level: less smoothing and
///                the noise that moves the points is seen as part of their profile.
/// @param noise   of the volume, native units.
/// @return zeros if there are fewer than a hundred points.
std::array<double, 3> measure_blur(const Volume& volume, const std::vector<SurfacePoint>& points,
                                   double noise);

/// The value of a blurred image where an object begins: an edge with a shell behind it, one to two
/// and a half voxels thick, is fitted to the median profile along the normals of the points, as
/// above. Without shells this is midway between the two sides; where the blur mixes a thin dense
/// shell with what is behind, midway between the sides that are seen is too low.
/// @param points  within a voxel of the edge: a surface at a level that is not far off.
/// @return nothing if there are fewer than a hundred points, or no such edge explains their profile
///         to a hundredth of its height.
std::optional<double> measure_level(const Volume& volume, const std::vector<SurfacePoint>& points);

/// Replaces impulses (salt and pepper, dead detector elements) by the median of their neighbours. A
/// voxel is one if fewer than two of its 26 neighbours are within `difference` of it: even a line
/// one voxel thin has two, but for its ends.
/// @param difference   native units, > 0; well above the noise.
/// @param least_share  of the voxels: where fewer are found, they stay as they are.
/// @return how many were replaced.
std::size_t remove_impulses(Volume& volume, double difference, double least_share = 0);

}  // namespace mesamis
