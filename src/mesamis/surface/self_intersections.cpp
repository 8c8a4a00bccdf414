// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/self_intersections.h"

#include <algorithm>

#include "mesamis/base/parallel.h"
#include "mesamis/mesh/tet_mesh.h"
#include "mesamis/surface/box_tree.h"
#include "mesamis/surface/triangle_intersection.h"

namespace mesamis {

std::vector<std::array<Index, 2>> find_self_intersections(const TriMesh& surface) {
  require_sound(surface);
  const std::size_t count = surface.triangles.size();
  std::vector<Box> boxes(count);
  parallel_for(count, [&](std::size_t t) {
    const Triangle& k = surface.triangles[t];
    boxes[t] = bounding_box(
        std::array<Vec3, 3>{surface.points[k[0]], surface.points[k[1]], surface.points[k[2]]});
  });
  const BoxTree tree(boxes);
  std::vector<std::vector<std::array<Index, 2>>> blocks((count + kBlock - 1) / kBlock);
  parallel_blocks(count, kBlock, [&](std::size_t begin, std::size_t end) {
    auto& found = blocks[begin / kBlock];
    for (std::size_t t = begin; t < end; ++t) {
      const Triangle& own = surface.triangles[t];
      const auto first = found.size();
      if (!has_area(surface.points, own)) {
        found.push_back({static_cast<Index>(t), static_cast<Index>(t)});
      }
      tree.for_each_overlap(boxes[t], [&](std::size_t other) {
        if (other > t && intersect(surface.points, own, surface.triangles[other])) {
          found.push_back({static_cast<Index>(t), static_cast<Index>(other)});
        }
        return true;
      });
      std::sort(found.begin() + static_cast<std::ptrdiff_t>(first), found.end());
    }
  });
  std::vector<std::array<Index, 2>> pairs;
  for (const auto& block : blocks) pairs.insert(pairs.end(), block.begin(), block.end());
  return pairs;
}

}  // namespace mesamis
