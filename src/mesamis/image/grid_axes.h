// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

/// How steps along the axes of a grid, as affine matrices state them, become spacing and direction.
namespace mesamis::detail::image {

/// Axes whose cosines are larger are no axes of a grid; no unit.
inline constexpr double kSkewTolerance = 1e-3;

/// The axes of a grid.
struct GridAxes {
  Vec3 spacing{1, 1, 1};  ///< mm
  Mat3 direction{};       ///< orthonormal; column k is the direction of axis k
  double skew = 0;        ///< largest cosine between two of the steps; no unit
};

/// Makes the axes of a grid from one step along each of them. Steps that are not orthogonal are
/// made so: the nearest orthonormal matrix.
/// @param steps  from a voxel to the next along i, j, k; mm.
/// @throws InputError  for cosines above kSkewTolerance, and a step of length 0 or that is not
///                     finite.
GridAxes grid_axes(const std::array<Vec3, 3>& steps);

}  // namespace mesamis::detail::image
