// SPDX-License-Identifier: Apache-2.0
#include "mesamis/decimate/patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "mesamis/base/each_once.h"
#include "mesamis/base/parallel.h"
#include "mesamis/mesh/tet_mesh.h"

namespace mesamis::detail::decimate {
namespace {

/// The number of the patch of each triangle.
struct PatchNumbers {
  std::vector<Index> of_triangle;
  bool has_rest;  ///< the last one is what has no chosen corner
};

/// Patches are numbered in the order of their boxes.
PatchNumbers patch_numbers(const Cover& cover, double side, const std::vector<char>& chosen) {
  using Place = std::array<double, 3>;  // of a box: whole numbers
  constexpr double kBeyond = std::numeric_limits<double>::infinity();
  constexpr Place kRest{kBeyond, kBeyond, kBeyond};
  const std::vector<Vec3>& points = cover.points;
  const double back = 0.5 * side;
  const Vec3 origin = bounding_box(points).lo - Vec3{back, back, back};
  std::vector<Place> boxes(cover.triangles.size());
  parallel_for(boxes.size(), [&](std::size_t n) {
    const Triangle& t = cover.triangles[n];
    if (!chosen.empty() && chosen[t[0]] + chosen[t[1]] + chosen[t[2]] == 0) {
      boxes[n] = kRest;
    } else if (!std::isinf(side)) {
      const Vec3 center = (1.0 / 3) * (points[t[0]] + points[t[1]] + points[t[2]]) - origin;
      boxes[n] = {std::floor(center.x / side), std::floor(center.y / side),
                  std::floor(center.z / side)};
    }
  });
  std::map<Place, Index> number;
  for (std::size_t n = 0; n < boxes.size(); ++n) {
    if (n == 0 || boxes[n] != boxes[n - 1]) number[boxes[n]] = 0;
  }
  Index next = 0;
  for (auto& [box, n] : number) n = next++;
  std::vector<Index> numbers(boxes.size());
  parallel_for(boxes.size(), [&](std::size_t n) { numbers[n] = number.at(boxes[n]); });
  return {std::move(numbers), number.count(kRest) > 0};
}

/// The patches that each point is in, as pairs of point and patch, sorted.
using Places = std::vector<std::pair<Index, Index>>;

Places places_of(const Cover& cover, const std::vector<Index>& numbers) {
  std::vector<std::size_t> ends(cover.points.size() + 1, 0);  // of the triangles at each point
  for (const Triangle& t : cover.triangles) {
    for (const Index p : t) ++ends[static_cast<std::size_t>(p) + 1];
  }
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<Index> at_point(ends.back());
  for (std::size_t t = 0; t < numbers.size(); ++t) {
    for (const Index p : cover.triangles[t]) at_point[ends[p]++] = numbers[t];
  }
  Places places;
  places.reserve(cover.points.size());
  auto begin = at_point.begin();
  for (std::size_t p = 0; p < cover.points.size(); ++p) {
    const auto end = at_point.begin() + static_cast<std::ptrdiff_t>(ends[p]);
    std::sort(begin, end);
    const auto last = std::unique(begin, end);
    for (; begin != last; ++begin) places.emplace_back(static_cast<Index>(p), *begin);
    begin = end;
  }
  return places;
}

/// Of each point 1 if it is in several patches.
std::vector<char> shared_points(const Places& places, std::size_t points) {
  std::vector<char> shared(points, 0);
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (places[i].first == places[i - 1].first) shared[places[i].first] = 1;
  }
  return shared;
}

class Cutter {
 public:
  Cutter(const Cover& cover, const std::vector<Index>& numbers)
      : places_(places_of(cover, numbers)), shared_(shared_points(places_, cover.points.size())) {
    const Index count = numbers.empty() ? 0 : *std::max_element(numbers.begin(), numbers.end()) + 1;
    patches_.resize(static_cast<std::size_t>(count));
    // The places come in the order of the points.
    for (const auto& [point, patch] : places_) {
      patches_[patch].points.push_back(point);
      patches_[patch].cover.points.push_back(cover.points[point]);
    }
    for (Patch& patch : patches_) patch.held.assign(patch.points.size(), 0);
  }

  std::vector<Patch> cut(Cover cover, const std::vector<Index>& numbers) {
    for (std::size_t t = 0; t < numbers.size(); ++t) {
      const Triangle& corners = cover.triangles[t];
      Patch& patch = patches_[numbers[t]];
      Triangle local;
      for (std::size_t i = 0; i < 3; ++i) local[i] = place_in(patch, corners[i]);
      patch.cover.triangles.push_back(local);
      patch.cover.originals.push_back(std::move(cover.originals[t]));
      patch.cover.to_originals.push_back(cover.to_originals[t]);
      patch.cover.from_originals.push_back(cover.from_originals[t]);
      for (const Index p : corners) {
        if (shared_[p] == 0) continue;
        for (const Index corner : local) patch.held[corner] = 1;
        tell_others(p, numbers[t], corners);
      }
    }
    for (Patch& patch : patches_) {
      auto& around = patch.around;
      sort_once(around);
    }
    return std::move(patches_);
  }

 private:
  static Index place_in(const Patch& patch, Index point) {
    const auto found = std::lower_bound(patch.points.begin(), patch.points.end(), point);
    return static_cast<Index>(found - patch.points.begin());
  }

  /// A triangle at a shared point lies around the point's other patches.
  void tell_others(Index point, Index own, const Triangle& triangle) {
    auto place = std::lower_bound(places_.begin(), places_.end(), std::pair{point, Index{0}});
    for (; place != places_.end() && place->first == point; ++place) {
      if (place->second != own) patches_[place->second].around.push_back(triangle);
    }
  }

  Places places_;
  std::vector<char> shared_;
  std::vector<Patch> patches_;
};

}  // namespace

void choose_rings(const std::vector<Triangle>& triangles, int rings, std::vector<char>& chosen) {
  for (int ring = 0; ring < rings; ++ring) {
    const std::vector<char> before = chosen;
    for (const Triangle& t : triangles) {
      if (before[t[0]] + before[t[1]] + before[t[2]] == 0) continue;
      for (const Index p : t) chosen[p] = 1;
    }
  }
}

void choose_rings(std::vector<Triangle> triangles, std::span<const Index> first_copy, int rings,
                  std::vector<char>& chosen) {
  for (std::size_t p = 0; p < chosen.size(); ++p) chosen[first_copy[p]] |= chosen[p];
  for (Triangle& t : triangles) {
    for (Index& p : t) p = first_copy[p];
  }
  choose_rings(triangles, rings, chosen);
  for (std::size_t p = 0; p < chosen.size(); ++p) chosen[p] = chosen[first_copy[p]];
}

void hold(Patch& patch, const std::vector<Index>& points, const std::vector<Index>& originals,
          int rings) {
  std::vector<char> chosen(patch.held.size(), 0);
  for (const Index p : points) chosen[p] = 1;
  for (std::size_t t = 0; t < patch.cover.triangles.size(); ++t) {
    const auto& own = patch.cover.originals[t];
    const bool stands = std::any_of(own.begin(), own.end(), [&](Index original) {
      return std::binary_search(originals.begin(), originals.end(), original);
    });
    if (!stands) continue;
    for (const Index p : patch.cover.triangles[t]) chosen[p] = 1;
  }
  choose_rings(patch.cover.triangles, rings, chosen);
  for (std::size_t p = 0; p < chosen.size(); ++p) patch.held[p] |= chosen[p];
}

std::vector<Patch> cut_into_patches(Cover cover, double side, const std::vector<char>& chosen) {
  const PatchNumbers numbers = patch_numbers(cover, side, chosen);
  Cutter cutter(cover, numbers.of_triangle);
  std::vector<Patch> patches = cutter.cut(std::move(cover), numbers.of_triangle);
  if (numbers.has_rest) std::fill(patches.back().held.begin(), patches.back().held.end(), 1);
  return patches;
}

}  // namespace mesamis::detail::decimate
