// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/round_together.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "mesamis/decimate/single_places.h"

namespace mesamis::detail::decimate {
namespace {

/// The numbers of the points, sorted by place: equal points follow one another.
std::vector<std::size_t> sorted_by_place(std::span<const Vec3> points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [points](std::size_t a, std::size_t b) { return ByPlace()(points[a], points[b]); });
  return order;
}

}  // namespace

std::vector<Vec3> round_together(std::span<const Vec3> points) {
  require_single(points);
  const std::vector<std::size_t> order = sorted_by_place(points);
  std::vector<Vec3> result(points.size());
  SinglePlaces places;
  std::vector<std::size_t> displaced;  // where in the order the equal points begin
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Vec3& exact = points[order[i]];
    result[order[i]] = rounded(exact);
    const bool again = i > 0 && points[order[i - 1]] == exact;
    if (!again && !places.take(result[order[i]])) displaced.push_back(i);
  }
  for (const std::size_t first : displaced) {
    const Vec3& exact = points[order[first]];
    const Vec3 place = places.take_nearest(result[order[first]], exact);
    for (std::size_t i = first; i < order.size() && points[order[i]] == exact; ++i) {
      result[order[i]] = place;
    }
  }
  return result;
}

double round_in_place(std::vector<Vec3>& points) {
  std::vector<Vec3> result = round_together(points);
  double most = 0;
  for (std::size_t p = 0; p < result.size(); ++p) {
    most = std::max(most, norm(result[p] - points[p]));
  }
  points = std::move(result);
  return most;
}

}  // namespace mesamis::detail::decimate
