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

inline constexpr double kLargestBlur = 3;  ///< voxels

}  // namespace mesamis::detail::restore
