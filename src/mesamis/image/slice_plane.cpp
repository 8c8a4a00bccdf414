// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/slice_plane.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/image/orientation.h"

namespace mesamis::detail::image {

Vec3 grid_direction(const VoxelGrid& grid, int grid_axis) {
  const auto& rows = grid.direction.rows;
  return {rows[0][grid_axis], rows[1][grid_axis], rows[2][grid_axis]};
}

namespace {

/// The page's right and up for a cut across x, y or z, LPS.
constexpr std::array<std::array<Vec3, 2>, 3> kPage{{{Vec3{0, 1, 0}, Vec3{0, 0, 1}},
                                                    {Vec3{1, 0, 0}, Vec3{0, 0, 1}},
                                                    {Vec3{1, 0, 0}, Vec3{0, -1, 0}}}};

/// The grid axis of `among` that runs most along a direction, either way.
int nearest_axis(const VoxelGrid& grid, const Vec3& direction, std::vector<int> among) {
  return *std::max_element(among.begin(), among.end(), [&](int a, int b) {
    return std::abs(dot(grid_direction(grid, a), direction)) <
           std::abs(dot(grid_direction(grid, b), direction));
  });
}

/// LPS coordinate along `axis` of the centre of slice `index`.
double slice_position(const VoxelGrid& grid, int axis, int grid_axis, Index index) {
  Vec3 p = 0.5 * grid.box().hi;
  p[grid_axis] = index * grid.spacing[grid_axis];
  return grid.to_world(p)[axis];
}

Index slice_index(const VoxelGrid& grid, int axis, int grid_axis, double position) {
  const Index last = grid.size[static_cast<std::size_t>(grid_axis)] - 1;
  const double first_at = slice_position(grid, axis, grid_axis, 0);
  const double last_at = slice_position(grid, axis, grid_axis, last);
  const double step = (last_at - first_at) / last;
  const double index = (position - first_at) / step;
  if (!(index >= -0.5 && index <= last + 0.5)) {
    const auto [lo, hi] = std::minmax(first_at, last_at);
    throw InputError("picture: no slice at " + std::string(1, "xyz"[axis]) + " = " +
                     std::to_string(position) + " mm, the volume reaches from " +
                     std::to_string(lo) + " to " + std::to_string(hi) + " mm");
  }
  return std::clamp(static_cast<Index>(std::lround(index)), Index{0}, last);
}

}  // namespace

SlicePlane slice_plane(const VoxelGrid& grid, int axis, const double* position) {
  const auto& [right, up] = kPage[static_cast<std::size_t>(axis)];
  Vec3 across;
  across[axis] = 1;
  SlicePlane plane;
  const int deep = nearest_axis(grid, across, {0, 1, 2});
  std::vector<int> others{0, 1, 2};
  others.erase(others.begin() + deep);
  const int rightward = nearest_axis(grid, right, others);
  const int upward = others[0] + others[1] - rightward;
  plane.axis = {rightward, upward, deep};
  const Vec3 along_right = grid_direction(grid, rightward);
  const Vec3 along_up = grid_direction(grid, upward);
  plane.sign = {dot(along_right, right) < 0 ? -1 : 1, dot(along_up, up) < 0 ? -1 : 1};
  const Vec3 to_right = plane.sign[0] * along_right, to_up = plane.sign[1] * along_up;
  plane.letters = {side_letter(-to_right), side_letter(to_right), side_letter(-to_up),
                   side_letter(to_up)};
  plane.index = position != nullptr ? slice_index(grid, axis, deep, *position)
                                    : grid.size[static_cast<std::size_t>(deep)] / 2;
  plane.position = slice_position(grid, axis, deep, plane.index);
  return plane;
}

Vec3 to_page(const VoxelGrid& grid, const SlicePlane& plane, const Vec3& world) {
  const Vec3 place = grid.to_grid(world);
  return {plane.sign[0] * place[plane.axis[0]], plane.sign[1] * place[plane.axis[1]],
          place[plane.axis[2]] - plane.index * grid.spacing[plane.axis[2]]};
}

}  // namespace mesamis::detail::image
