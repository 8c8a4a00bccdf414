// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/self_intersections.h"

#include <algorithm>

#include "mesamis/base/parallel.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/box_tree.h"
#include "mesamis/surface/triangle_intersection.h"

namespace mesamis::detail::surface {
namespace {

Box box_of_triangle(const TriMesh& surface, const Triangle& t) {
  return bounding_box(
      std::array<Vec3, 3>{surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]});
}

std::vector<Box> boxes_of(const TriMesh& surface) {
  require_sound(surface);
  std::vector<Box> boxes(surface.triangles.size());
  parallel_for(boxes.size(),
               [&](std::size_t t) { boxes[t] = box_of_triangle(surface, surface.triangles[t]); });
  return boxes;
}

/// Each once, in ascending order.
std::vector<TrianglePair> sorted_once(std::vector<TrianglePair> pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

std::vector<TrianglePair> find_self_intersections(const TriMesh& surface) {
  return SelfIntersections(surface).all();
}

SelfIntersections::SelfIntersections(const TriMesh& surface)
    : surface_(surface), tree_(std::make_unique<BoxTree>(boxes_of(surface))) {}

SelfIntersections::~SelfIntersections() = default;

Box SelfIntersections::box_of(Index t) const {
  return box_of_triangle(surface_, surface_.triangles[t]);
}

std::vector<TrianglePair> SelfIntersections::all() const {
  const std::size_t count = surface_.triangles.size();
  const std::vector<Vec3>& points = surface_.points;
  const std::vector<Triangle>& triangles = surface_.triangles;
  std::vector<char> areas(count);
  parallel_for(count, [&](std::size_t t) { areas[t] = has_area(points, triangles[t]) ? 1 : 0; });
  return sorted_once(parallel_collect<TrianglePair>(
      count, kBlock, [&](std::size_t begin, std::size_t end, auto& found) {
        for (auto t = static_cast<Index>(begin); t < static_cast<Index>(end); ++t) {
          if (areas[t] == 0) {
            found.push_back({t, t});
            continue;
          }
          tree_->for_each_overlap(box_of(t), [&](std::size_t n) {
            const auto other = static_cast<Index>(n);
            const bool may_meet = other > t && areas[other] != 0;
            if (may_meet && intersect_with_area(points, triangles[t], triangles[other])) {
              found.push_back({t, other});
            }
            return true;
          });
        }
      }));
}

std::vector<TrianglePair> SelfIntersections::after_move_of(std::span<const Index> triangles) {
  for (const Index t : triangles) tree_->update(static_cast<std::size_t>(t), box_of(t));
  return sorted_once(parallel_collect<TrianglePair>(
      triangles.size(), kBlock, [&](std::size_t begin, std::size_t end, auto& found) {
        for (std::size_t i = begin; i < end; ++i) {
          const Index t = triangles[i];
          const Triangle& own = surface_.triangles[t];
          if (!has_area(surface_.points, own)) found.push_back({t, t});
          tree_->for_each_overlap(box_of(t), [&](std::size_t n) {
            const auto other = static_cast<Index>(n);
            if (other != t && intersect(surface_.points, own, surface_.triangles[other])) {
              found.push_back({std::min(t, other), std::max(t, other)});
            }
            return true;
          });
        }
      }));
}

}  // namespace mesamis::detail::surface
