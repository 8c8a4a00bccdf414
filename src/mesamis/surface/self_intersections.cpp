// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/self_intersections.h"

#include <algorithm>
#include <utility>

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

TrianglePair ordered(std::size_t t, std::size_t other) {
  return {static_cast<Index>(std::min(t, other)), static_cast<Index>(std::max(t, other))};
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

std::vector<Index> triangles_at(std::span<const Triangle> triangles,
                                const std::vector<char>& chosen) {
  std::vector<Index> found;
  for (Index t = 0; t < std::ssize(triangles); ++t) {
    const auto& [a, b, c] = triangles[static_cast<std::size_t>(t)];
    if (chosen[a] + chosen[b] + chosen[c] > 0) found.push_back(t);
  }
  return found;
}

SelfIntersections::SelfIntersections(const TriMesh& surface)
    : surface_(surface), tree_(std::make_unique<BoxTree>(boxes_of(surface))) {}

SelfIntersections::~SelfIntersections() = default;

Box SelfIntersections::box_of(Index t) const {
  return box_of_triangle(surface_, surface_.triangles[t]);
}

bool SelfIntersections::meet(std::size_t t, std::size_t other) const {
  return intersect(surface_.points, surface_.triangles[t], surface_.triangles[other]);
}

std::vector<TrianglePair> SelfIntersections::all() const {
  constexpr std::size_t kTrianglesPerShare = 1024;
  const std::size_t count = surface_.triangles.size();
  auto pairs = parallel_collect<TrianglePair>(count, kBlock,
                                              [&](std::size_t begin, std::size_t end, auto& found) {
                                                for (std::size_t t = begin; t < end; ++t)
                                                  add_without_area(t, found);
                                              });
  const auto shares = tree_->shares_of_pairs(count / kTrianglesPerShare + 1);
  const auto met = parallel_collect<TrianglePair>(
      shares.size(), 1, [&](std::size_t begin, std::size_t, auto& found) {
        tree_->for_each_pair(shares[begin], [&](std::size_t t, std::size_t other) {
          if (meet(t, other)) found.push_back(ordered(t, other));
        });
      });
  pairs.insert(pairs.end(), met.begin(), met.end());
  return sorted_once(std::move(pairs));
}

std::vector<TrianglePair> SelfIntersections::after_move() {
  tree_->update(boxes_of(surface_));
  return all();
}

std::vector<TrianglePair> SelfIntersections::after_move_of(std::span<const Index> triangles) {
  for (const Index t : triangles) tree_->update(static_cast<std::size_t>(t), box_of(t));
  return sorted_once(parallel_collect<TrianglePair>(
      triangles.size(), kBlock, [&](std::size_t begin, std::size_t end, auto& found) {
        for (std::size_t i = begin; i < end; ++i) {
          const auto t = static_cast<std::size_t>(triangles[i]);
          add_without_area(t, found);
          tree_->for_each_overlap(box_of(triangles[i]), [&](std::size_t other) {
            if (other != t && meet(t, other)) found.push_back(ordered(t, other));
            return true;
          });
        }
      }));
}

void SelfIntersections::add_without_area(std::size_t t, std::vector<TrianglePair>& pairs) const {
  if (!has_area(surface_.points, surface_.triangles[t])) pairs.push_back(ordered(t, t));
}

}  // namespace mesamis::detail::surface
