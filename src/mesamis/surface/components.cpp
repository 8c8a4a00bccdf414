// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/components.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesamis/surface/half_edges.h"
#include "mesamis/surface/measure.h"

namespace mesamis::detail::surface {
namespace {

/// Numbers the parts in the order of their first triangles and measures them.
SurfaceComponents number_parts(const TriMesh& surface, DisjointSets& parts) {
  SurfaceComponents result;
  result.of_triangle.assign(surface.triangles.size(), kNoIndex);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (is_degenerate(surface.triangles[t])) continue;
    const std::size_t first = parts.find(t);  // never after t
    if (first == t) {
      result.of_triangle[t] = static_cast<Index>(result.sizes.size());
      result.sizes.emplace_back();
    }
    result.of_triangle[t] = result.of_triangle[first];
    auto& size = result.sizes[result.of_triangle[t]];
    ++size.triangles;
    size.volume += cone_volume(surface, t);
    size.area += triangle_area(surface, t);
  }
  return result;
}

void sort_by_volume(SurfaceComponents& components) {
  const auto& sizes = components.sizes;
  const std::vector<Index> order = largest_first(sizes);
  SurfaceComponents sorted;
  std::vector<Index> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    sorted.sizes.push_back(sizes[order[i]]);
    place[order[i]] = static_cast<Index>(i);
  }
  components.sizes = std::move(sorted.sizes);
  for (Index& part : components.of_triangle) {
    if (part != kNoIndex) part = place[part];
  }
}

}  // namespace

std::vector<Index> largest_first(std::span<const SurfaceComponents::Size> sizes) {
  std::vector<Index> order(sizes.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [sizes](Index a, Index b) {
    return std::abs(sizes[static_cast<std::size_t>(a)].volume) >
           std::abs(sizes[static_cast<std::size_t>(b)].volume);
  });
  return order;
}

SurfaceComponents find_components(const TriMesh& surface) {
  require_sound(surface);
  const auto half_edges = sorted_half_edges(surface.triangles, surface.points.size());
  DisjointSets parts = connected_triangles(half_edges, surface.triangles.size());
  SurfaceComponents components = number_parts(surface, parts);
  sort_by_volume(components);
  return components;
}

std::vector<TriMesh> split_components(const TriMesh& surface) {
  const SurfaceComponents components = find_components(surface);
  std::vector<TriMesh> parts(components.sizes.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Index part = components.of_triangle[t];
    if (part != kNoIndex) parts[part].triangles.push_back(surface.triangles[t]);
  }
  // One table serves all parts: an entry counts while its owner is the part at work.
  std::vector<Index> place(surface.points.size(), 0), owner(surface.points.size(), kNoIndex);
  for (std::size_t part = 0; part < parts.size(); ++part) {
    for (Triangle& triangle : parts[part].triangles) {
      for (Index& p : triangle) {
        if (owner[p] != static_cast<Index>(part)) {
          owner[p] = static_cast<Index>(part);
          place[p] = static_cast<Index>(parts[part].points.size());
          parts[part].points.push_back(surface.points[p]);
        }
        p = place[p];
      }
    }
  }
  return parts;
}

}  // namespace mesamis::detail::surface
