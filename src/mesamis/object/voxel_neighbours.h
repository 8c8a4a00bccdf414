// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::object {

/// Calls visit(neighbour, axis) for each voxel that shares a face with a voxel, in the order of
/// their places among the samples.
/// @param at  a voxel's place among the samples.
template <class Visit>
void for_each_neighbour(const VoxelGrid& grid, std::size_t at, Visit&& visit) {
  const auto nx = static_cast<std::size_t>(grid.size[0]);
  const auto ny = static_cast<std::size_t>(grid.size[1]);
  const auto nz = static_cast<std::size_t>(grid.size[2]);
  const std::size_t i = at % nx, j = at / nx % ny, k = at / (nx * ny);
  if (k > 0) visit(at - nx * ny, 2);
  if (j > 0) visit(at - nx, 1);
  if (i > 0) visit(at - 1, 0);
  if (i + 1 < nx) visit(at + 1, 0);
  if (j + 1 < ny) visit(at + nx, 1);
  if (k + 1 < nz) visit(at + nx * ny, 2);
}

/// Whether a voxel lies in an outermost layer of the grid. An axis with a single voxel does not
/// count: the border of one slice is within its plane.
inline bool is_at_border(const VoxelGrid& grid, std::size_t at) {
  for (const Index length : grid.size) {
    const auto count = static_cast<std::size_t>(length);
    const std::size_t place = at % count;
    if (count > 1 && (place == 0 || place + 1 == count)) return true;
    at /= count;
  }
  return false;
}

/// The first and the last voxel of an axis within a distance of one of them.
/// @param mm  >= 0.
inline std::array<Index, 2> voxels_around(const VoxelGrid& grid, int axis, Index from, double mm) {
  const auto a = static_cast<std::size_t>(axis);
  const auto steps = static_cast<Index>(
      std::min<double>(std::floor(mm / grid.spacing[axis] * (1 + 1e-9)), grid.size[a]));
  return {std::max(from - steps, 0), std::min(from + steps, grid.size[a] - 1)};
}

}  // namespace mesamis::detail::object
