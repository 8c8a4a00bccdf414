// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

/// How a grid lies in the body.
namespace mesamis::detail::image {

/// Finds the body axis nearest to a direction, either way; of equals the first.
/// @param direction  LPS, not zero, of any unit.
/// @return 0 x, 1 y, 2 z; no unit.
int body_axis(const Vec3& direction) noexcept;

/// Names the side of the body that a direction points to most: L or R, P or A, S or I.
/// @param direction  LPS, not zero, of any unit.
char side_letter(const Vec3& direction) noexcept;

/// The sides of the body that the axes of a grid run towards.
struct GridOrientation {
  std::array<char, 3>
      letters;         ///< of i, j, k: "LPS" for the identity, "RAS" as NIfTI mostly has it
  double oblique_deg;  ///< largest angle between an axis and the body axis it is named by
};

/// Names the axes of a grid. Each body axis names one of them: of the six ways the one with the
/// largest sum of cosines.
/// @param direction  orthonormal, see VoxelGrid::direction.
GridOrientation orientation_of(const Mat3& direction);

}  // namespace mesamis::detail::image
