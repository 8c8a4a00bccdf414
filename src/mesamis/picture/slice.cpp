// SPDX-License-Identifier: Apache-2.0
#include "mesamis/picture/slice.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "mesamis/image/grey_values.h"
#include "mesamis/image/orientation.h"
#include "mesamis/picture/annotation.h"
#include "mesamis/picture/ticks.h"

namespace mesamis::detail::picture {
namespace {

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

}  // namespace mesamis::detail::picture
