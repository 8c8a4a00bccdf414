// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/surface/box_planes.h"
#include "mesamis/surface/partition.h"
#include "mesamis/surface/partition_cells.h"

namespace mesamis {
namespace {

using Fields = std::span<const std::vector<double>>;

/// A field of partition_cells.h: one membership per node and material.
class MeshField {
 public:
  MeshField(const TetMesh& mesh, Fields memberships, bool close_at_box)
      : mesh_(mesh), memberships_(memberships), material_(mesh.points.size(), 0) {
    parallel_for(material_.size(), [this](std::size_t n) {
      for (std::size_t k = 1; k < memberships_.size(); ++k) {
        const auto best = static_cast<std::size_t>(material_[n]);
        if (memberships_[k][n] > memberships_[best][n]) material_[n] = static_cast<Index>(k);
      }
    });
    if (close_at_box) planes_ = box_planes(mesh);
  }

  Vec3 point(Index node) const { return mesh_.points[static_cast<std::size_t>(node)]; }
  Index material(Index node) const { return material_[static_cast<std::size_t>(node)]; }
  double membership(Index node, Index material) const {
    return memberships_[static_cast<std::size_t>(material)][static_cast<std::size_t>(node)];
  }
  unsigned planes(Index node) const {
    return planes_.empty() ? 0 : planes_[static_cast<std::size_t>(node)];
  }

 private:
  const TetMesh& mesh_;
  Fields memberships_;
  std::vector<Index> material_;
  std::vector<std::uint8_t> planes_;  // empty: no caps
};

void require_memberships(const TetMesh& mesh, Fields memberships) {
  if (memberships.empty()) throw InputError("partition: expected a material, found none");
  for (std::size_t k = 0; k < memberships.size(); ++k) {
    const std::vector<double>& p = memberships[k];
    const std::string of_material = " of material " + std::to_string(k);
    if (p.size() != mesh.points.size()) {
      throw InputError("partition: expected one membership" + of_material + " per node (" +
                       std::to_string(mesh.points.size()) + "), found " + std::to_string(p.size()));
    }
    const auto bad =
        std::find_if_not(p.begin(), p.end(), [](double x) { return std::isfinite(x); });
    if (bad == p.end()) continue;
    throw InputError("partition: the membership" + of_material + " at node " +
                     std::to_string(bad - p.begin()) + " is not finite");
  }
}

}  // namespace

PartitionSurface extract_partition(const TetMesh& mesh, Fields memberships,
                                   const PartitionOptions& options) {
  require_memberships(mesh, memberships);
  const MeshField field(mesh, memberships, options.close_at_box);
  const std::size_t blocks = (mesh.cells.size() + kBlock - 1) / kBlock;
  return extract_blocks(field, blocks, [&](std::size_t b, const auto& marcher, auto& pieces) {
    const std::size_t end = std::min((b + 1) * kBlock, mesh.cells.size());
    for (std::size_t c = b * kBlock; c < end; ++c) marcher.march(mesh.cells[c], pieces);
  });
}

TriMesh object_surface(const PartitionSurface& partition, Index material) {
  TriMesh surface;
  std::vector<Index> used;
  for (std::size_t t = 0; t < partition.triangles.size(); ++t) {
    const auto& [behind, before] = partition.sides[t];
    if (behind != material && before != material) continue;
    Triangle triangle = partition.triangles[t];
    if (behind != material) std::swap(triangle[1], triangle[2]);
    surface.triangles.push_back(triangle);
    used.insert(used.end(), triangle.begin(), triangle.end());
  }
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (const Index p : used)
    surface.points.push_back(partition.points[static_cast<std::size_t>(p)]);
  for (Triangle& t : surface.triangles) {
    for (Index& p : t) {
      p = static_cast<Index>(std::lower_bound(used.begin(), used.end(), p) - used.begin());
    }
  }
  return surface;
}

std::vector<Index> materials_of(const PartitionSurface& partition) {
  std::vector<Index> materials;
  for (const auto& sides : partition.sides) {
    for (const Index m : sides) {
      if (m == kNoIndex) continue;
      const auto place = std::lower_bound(materials.begin(), materials.end(), m);
      if (place == materials.end() || *place != m) materials.insert(place, m);
    }
  }
  return materials;
}

}  // namespace mesamis
