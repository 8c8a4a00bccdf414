// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/self_intersections.h"

#include <algorithm>

#include "mesamis/base/each_once.h"
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
  sort_once(pairs);
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

/// Calls visit(other) for each triangle from `first` on that t meets; t itself if it has no area.
template <class Visit>
void SelfIntersections::for_each_met(Index t, Index first, Visit&& visit) const {
  const Triangle& own = surface_.triangles[t];
  if (!has_area(surface_.points, own)) visit(t);
  tree_->for_each_overlap(box_of(t), [&](std::size_t found) {
    const auto other = static_cast<Index>(found);
    const bool is_other = other >= first && other != t;
    if (is_other && intersect(surface_.points, own, surface_.triangles[other])) visit(other);
    return true;
  });
}

std::vector<TrianglePair> SelfIntersections::all() const {
  const std::size_t count = surface_.triangles.size();
  return sorted_once(parallel_collect<TrianglePair>(
      count, kBlock, [&](std::size_t begin, std::size_t end, auto& found) {
        for (auto t = static_cast<Index>(begin); t < static_cast<Index>(end); ++t) {
          for_each_met(t, t, [&](Index other) { found.push_back({t, other}); });
        }
      }));
}

std::vector<TrianglePair> SelfIntersections::after_move_of(std::span<const Index> triangles) {
  for (const Index t : triangles) tree_->update(static_cast<std::size_t>(t), box_of(t));
  return sorted_once(parallel_collect<TrianglePair>(
      triangles.size(), kBlock, [&](std::size_t begin, std::size_t end, auto& found) {
        for (std::size_t i = begin; i < end; ++i) {
          const Index t = triangles[i];
          for_each_met(t, 0, [&](Index other) {
            found.push_back({std::min(t, other), std::max(t, other)});
          });
        }
      }));
}

}  // namespace mesamis::detail::surface
