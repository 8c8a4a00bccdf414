// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesamis/rooms.h"
#include "mesamis/surface/tri_mesh.h"

namespace mesamis::detail::decimate {

/// A place of a surface, and how far above it lies what it stands for.
struct HeightSample {
  Index triangle = kNoIndex;      ///< kNoIndex: it says nothing
  std::array<double, 3> place{};  ///< in the triangle, barycentric coordinates
  double height = 0;              ///< along the triangle's normal, mm
  double weight = 0;              ///< >= 0
};

/// A surface whose points move along their normals.
struct MovableSurface {
  const TriMesh& surface;
  const std::vector<Vec3>& normals;  ///< of each point, unit length
  const std::vector<char>& stays;    ///< of each point 1 if it does not move
};

/// How far each point must move along its normal for the surface to lie at the samples, in least
/// squares by their weights. A pull to where the points are, of a fiftieth of their mean weight,
/// decides where samples are few.
/// @return a move for each point, mm; 0 of those that stay.
///
/// A sparse system of three unknowns per sample, by conjugate gradients to a thousandth.
std::vector<double> normal_moves(const MovableSurface& movable,
                                 std::span<const HeightSample> samples);

}  // namespace mesamis::detail::decimate
