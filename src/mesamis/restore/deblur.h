// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::restore {

/// Undoes a Gaussian blur as far as the noise permits: a regularised inverse (Wiener) filter.
///
/// Blur leaves the half maximum of an edge in place only where the surface is flat: elsewhere it
/// moves by about sigma^2 / R towards the centre of curvature, and gaps narrower than 1.35 sigma
/// close. With Lambda = sum sigma_a^2 k_a^2 for the frequency k, the blur is g = exp(-Lambda / 2),
/// and the filter
///   W = g / (g^2 + r Lambda^2)
/// minimises |g x - f|^2 + r |Lambda x|^2: a surface's spectrum falls like that of a step, the
/// noise's does not. Means are kept (W = 1 at Lambda = 0).
///
/// W is applied as a polynomial (Chebyshev) of the fourth-order difference Laplacian, which couples
/// neighbours only. Beyond the border the image is mirrored.
///
/// @param volume  at least one voxel; taken over, pass it with std::move() to save the copy.
/// @param blur    standard deviations per axis, voxels, 0 to kLargestBlur.
/// @param regularization  r, 1e-6 to 1e6: small where the noise is small against the contrast.
/// @return in the volume's units. The same bits for any number of threads.
/// @throws InputError  if an argument is out of range.
/// O(n degree), the degree being about 10 to 30; two copies of the samples.
Volume deblurred(Volume volume, const std::array<double, 3>& blur, double regularization);

/// Checks a blur.
/// @param blur  standard deviations per axis, voxels, 0 to kLargestBlur.
/// @throws InputError  naming the first value out of range.
void require_valid_blur(const std::array<double, 3>& blur);

/// Finds by how much deblurred() changes white noise: the root mean square of W over all
/// frequencies of the grid.
/// @param blur, regularization  as deblurred() takes them.
/// @return deviation of the noise after it, per deviation before (no unit); > 0.
double noise_gain(const std::array<double, 3>& blur, double regularization);

/// Finds by how much deblurred() changes noise that is then averaged along a surface, as a fitted
/// surface averages it: over a Gaussian of 0.8 voxels in the plane.
///
/// It is the root mean square over all frequencies k of the grid of W sqrt(S) exp(-0.8^2 q^2 / 2),
/// with the noise's spectrum S, the product of 1 + 2 r_a cos k_a over the axes, and the part q of k
/// along the plane.
/// @param blur, regularization  as deblurred() takes them; no blur: the noise as it is.
/// @param correlation  r, of neighbours along each axis, -1 to 1.
/// @return of surfaces across each axis: deviation of the mean, per deviation of a voxel before (no
///         unit); >= 0.
std::array<double, 3> noise_gain_along_surface(const std::array<double, 3>& blur,
                                               double regularization,
                                               const std::array<double, 3>& correlation);

inline constexpr double kLargestBlur = 3;  ///< voxels

}  // namespace mesamis::detail::restore
