// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/slice.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "mesamis/base/error.h"
#include "mesamis/image/grey_values.h"
#include "mesamis/image/orientation.h"
#include "mesamis/picture/annotation.h"
#include "mesamis/plot/ticks.h"

namespace mesamis::detail {
namespace {

/// The page's right and up for a cut across x, y or z, LPS.
constexpr std::array<std::array<Vec3, 2>, 3> kPage{{{Vec3{0, 1, 0}, Vec3{0, 0, 1}},
                                                    {Vec3{1, 0, 0}, Vec3{0, 0, 1}},
                                                    {Vec3{1, 0, 0}, Vec3{0, -1, 0}}}};

Vec3 grid_direction(const Volume& volume, int grid_axis) {
  const auto& rows = volume.direction.rows;
  return {rows[0][grid_axis], rows[1][grid_axis], rows[2][grid_axis]};
}

/// The grid axis of `among` that runs most along a direction, either way.
int nearest_axis(const Volume& volume, const Vec3& direction, std::vector<int> among) {
  return *std::max_element(among.begin(), among.end(), [&](int a, int b) {
    return std::abs(dot(grid_direction(volume, a), direction)) <
           std::abs(dot(grid_direction(volume, b), direction));
  });
}

/// LPS coordinate along `axis` of the centre of slice `index`.
double slice_position(const Volume& volume, int axis, int grid_axis, Index index) {
  Vec3 p = 0.5 * volume.box().hi;
  p[grid_axis] = index * volume.spacing[grid_axis];
  return volume.to_world(p)[axis];
}

Index slice_index(const Volume& volume, int axis, int grid_axis, double position) {
  const Index last = volume.size[static_cast<std::size_t>(grid_axis)] - 1;
  const double first_at = slice_position(volume, axis, grid_axis, 0);
  const double last_at = slice_position(volume, axis, grid_axis, last);
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

/// @param side  0: along the bottom; 1: along the left side.
std::vector<SideTick> ticks_along(const Volume& volume, const SlicePlane& plane, std::size_t side) {
  constexpr int kCount = 6;
  const int axis = plane.axis[side];
  const Vec3 along = plane.sign[side] * grid_direction(volume, axis);
  const int body = body_axis(along);
  Vec3 start = 0.5 * volume.box().hi;
  start[plane.axis[2]] = plane.index * volume.spacing[plane.axis[2]];
  start[axis] = 0;
  const double zero = volume.to_world(start)[body], slope = along[body];
  const double length = volume.box().hi[axis];
  const double first = plane.sign[side] < 0 ? -length : 0;
  const auto [lo, hi] = std::minmax({zero + slope * first, zero + slope * (first + length)});
  const Ticks ticks = round_ticks(lo, hi, kCount);
  std::vector<SideTick> found;
  for (int i = 0; i < ticks.count; ++i) {
    const double value = std::abs(ticks.at(i)) < 1e-6 * ticks.step ? 0 : ticks.at(i);
    found.push_back({(value - zero) / slope, short_number(value)});
  }
  return found;
}

}  // namespace

SlicePlane slice_plane(const Volume& volume, int axis, const double* position) {
  const auto& [right, up] = kPage[static_cast<std::size_t>(axis)];
  Vec3 across;
  across[axis] = 1;
  SlicePlane plane;
  const int deep = nearest_axis(volume, across, {0, 1, 2});
  std::vector<int> others{0, 1, 2};
  others.erase(others.begin() + deep);
  const int rightward = nearest_axis(volume, right, others);
  const int upward = others[0] + others[1] - rightward;
  plane.axis = {rightward, upward, deep};
  const Vec3 along_right = grid_direction(volume, rightward);
  const Vec3 along_up = grid_direction(volume, upward);
  plane.sign = {dot(along_right, right) < 0 ? -1 : 1, dot(along_up, up) < 0 ? -1 : 1};
  const Vec3 to_right = plane.sign[0] * along_right, to_up = plane.sign[1] * along_up;
  plane.letters = {side_letter(-to_right), side_letter(to_right), side_letter(-to_up),
                   side_letter(to_up)};
  plane.index = position != nullptr ? slice_index(volume, axis, deep, *position)
                                    : volume.size[static_cast<std::size_t>(deep)] / 2;
  plane.position = slice_position(volume, axis, deep, plane.index);
  return plane;
}

Vec3 to_page(const Volume& volume, const SlicePlane& plane, const Vec3& world) {
  const Vec3 grid = volume.to_grid(world);
  return {plane.sign[0] * grid[plane.axis[0]], plane.sign[1] * grid[plane.axis[1]],
          grid[plane.axis[2]] - plane.index * volume.spacing[plane.axis[2]]};
}

std::array<std::vector<SideTick>, 2> side_ticks(const Volume& volume, const SlicePlane& plane) {
  return {ticks_along(volume, plane, 0), ticks_along(volume, plane, 1)};
}

ValueRange slice_window(const Volume& volume) {
  constexpr double kLow = 0.005, kHigh = 0.995;
  const auto is_padding = [](float value) { return value <= kPaddingHu; };
  const auto& samples = volume.samples;
  if (std::none_of(samples.begin(), samples.end(), is_padding) || !is_hounsfield(volume)) {
    return percentile_range(std::span<const float>(samples), kLow, kHigh);
  }
  std::vector<float> seen;
  std::remove_copy_if(samples.begin(), samples.end(), std::back_inserter(seen), is_padding);
  return percentile_range(std::span<const float>(seen.empty() ? samples : seen), kLow, kHigh);
}

std::vector<std::array<Vec3, 2>> outline(const Volume& volume, const SlicePlane& plane,
                                         const TriMesh& surface) {
  std::vector<Vec3> points;
  points.reserve(surface.points.size());
  for (const Vec3& p : surface.points) points.push_back(to_page(volume, plane, p));
  std::vector<std::array<Vec3, 2>> segments;
  for (const Triangle& t : surface.triangles) {
    std::array<Vec3, 2> ends;
    std::size_t found = 0;
    for (std::size_t e = 0; e < 3 && found < 2; ++e) {
      const Vec3& a = points[static_cast<std::size_t>(t[e])];
      const Vec3& b = points[static_cast<std::size_t>(t[(e + 1) % 3])];
      if ((a.z < 0) == (b.z < 0)) continue;
      ends[found++] = a + (a.z / (a.z - b.z)) * (b - a);
    }
    if (found == 2) segments.push_back(ends);
  }
  return segments;
}

}  // namespace mesamis::detail
