// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/restore/level_crossings.h"

/// Noise and blur of a scan, measured in the image itself at the surface of its object.
namespace mesamis::detail::restore {

/// Measures the standard deviation of the image's noise.
///
/// It is that of the differences between voxels and the quadratic polynomial through their 3x3x3
/// neighbourhood, two and a half voxels outside and inside of the object's surface: fine structure,
/// blurred over a voxel or more, is no noise. It is robust (from medians), so that impulses do not
/// count, and that of the quieter side: spongy bone is no noise either. Noise that is correlated
/// over many voxels is not seen.
/// @param volume  native values.
/// @param guide   the same image, smoothed, on the same grid: tells the sides of the level apart.
/// @param points  of the surface {guide = level}.
/// @param level   native units.
/// @return native units, >= 0; 0 if there are fewer than ten places on each side.
double measure_noise(const VolumeView& volume, const VolumeView& guide,
                     const std::vector<SurfacePoint>& points, double level);

/// The same of an image that shows no object: at voxels everywhere.
/// @return native units, >= 0; 0 where no voxel has 26 neighbours.
///
/// O(1): it looks at 100 000 voxels or less.
double measure_noise(const VolumeView& volume);

/// Measures how much the noise of neighbours has in common: the correlation coefficient of voxels
/// next to each other along each axis.
///
/// With the median squares d1 of the differences between neighbours and d2 of those between voxels
/// two apart, it is 1 - d1 / d2, at the places at which measure_noise() looks, where the axis runs
/// beside the surface, and on the side where d2 is smaller. Noise two voxels apart counts as
/// independent: where it is not, as through a soft kernel, the figure is too low. A scanner's soft
/// kernel gives more than 0, a sharp one less.
/// @param volume, guide, points, level  as measure_noise() takes them.
/// @return no unit, -1 to 1; 0 for an axis with fewer than ten places on each side, or where
///         neighbours do not differ.
std::array<double, 3> measure_noise_correlation(const VolumeView& volume, const VolumeView& guide,
                                                const std::vector<SurfacePoint>& points,
                                                double level);

/// Measures the standard deviation of the image's blur along each axis.
///
/// A step c seen through a Gaussian of deviation s has the slope c / (sqrt(2 pi) s). The step is
/// that of the median profile along the normals of the points; the slope is the median of the
/// slopes, along their normals, of the spline through the samples, over the points whose normal is
/// within 32 degrees of the axis, or within 45 if those are fewer than a hundred. Two axes of equal
/// spacing beside one that differs are the plane of a scanner's slices and share one blur. An axis
/// that fewer than a hundred normals follow is taken to be blurred over as many mm as the others,
/// but over 0.45 voxels at least. No axis gets less than partial volume alone makes, 0.29 voxels,
/// more than 1.5 times the median of the three, nor more than two voxels, and coarser axes get no
/// more voxels than the finest.
/// @param volume  native values.
/// @param points  thick_places() of the surface: thin walls never show their whole step.
/// @return voxels, 0.29 to 2; zeros if fewer than a hundred points have a normal, or no axis can be
///         told.
///
/// O(points), and a spline of the volume.
std::array<double, 3> measure_blur(const VolumeView& volume,
                                   const std::vector<SurfacePoint>& points);

}  // namespace mesamis::detail::restore
