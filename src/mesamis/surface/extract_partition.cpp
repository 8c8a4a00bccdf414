// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "mesamis/base/each_once.h"
#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/surface/box_planes.h"
#include "mesamis/surface/partition.h"
#include "mesamis/surface/partition_cells.h"

namespace mesamis::detail::surface {
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

/// Gives a surface over all these points those that it uses, in their order.
void take_points(const std::vector<Vec3>& points, TriMesh& surface) {
  std::vector<Index> used;
  used.reserve(3 * surface.triangles.size());
  for (const Triangle& t : surface.triangles) used.insert(used.end(), t.begin(), t.end());
  sort_once(used);
  surface.points.reserve(used.size());
  for (const Index p : used) surface.points.push_back(points[static_cast<std::size_t>(p)]);
  for (Triangle& t : surface.triangles) {
    for (Index& p : t) {
      p = static_cast<Index>(std::lower_bound(used.begin(), used.end(), p) - used.begin());
    }
  }
}

}  // namespace

PartitionSurface extract_partition(const TetMesh& mesh, Fields memberships,
                                   const PartitionOptions& options) {
  require_memberships(mesh, memberships);
  const MeshField field(mesh, memberships, options.close_at_box);
  const std::size_t blocks = (mesh.cells.size() + kBlock - 1) / kBlock;
  const auto march = [&](std::size_t b, const auto& marcher, auto& pieces) {
    const std::size_t end = std::min((b + 1) * kBlock, mesh.cells.size());
    for (std::size_t c = b * kBlock; c < end; ++c) marcher.march(mesh.cells[c], pieces);
  };
  return extract_blocks(field, blocks, march).surface;
}

TriMesh object_surface(const PartitionSurface& partition, Index material) {
  return std::move(object_surfaces(partition, {&material, 1}).front());
}

std::vector<TriMesh> object_surfaces(const PartitionSurface& partition,
                                     std::span<const Index> materials) {
  std::vector<TriMesh> surfaces(materials.size());
  std::vector<TriMesh*> of_side;  // number + 1, for there is kNoIndex; nullptr: not asked for
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const auto side = static_cast<std::size_t>(materials[m]) + 1;
    of_side.resize(std::max(of_side.size(), side + 1), nullptr);
    of_side[side] = &surfaces[m];
  }
  const auto surface_of = [&of_side](Index material) {
    const auto side = static_cast<std::size_t>(material) + 1;
    return side < of_side.size() ? of_side[side] : nullptr;
  };
  for (std::size_t t = 0; t < partition.triangles.size(); ++t) {
    const auto& [i, j, k] = partition.triangles[t];
    const auto& [behind, before] = partition.sides[t];
    if (TriMesh* surface = surface_of(behind)) surface->triangles.push_back({i, j, k});
    if (TriMesh* surface = surface_of(before)) surface->triangles.push_back({i, k, j});
  }
  parallel_for_each(surfaces.size(),
                    [&](std::size_t m) { take_points(partition.points, surfaces[m]); });
  return surfaces;
}

std::vector<char> curve_points(const PartitionSurface& partition) {
  constexpr std::array<Index, 2> kNone{-2, -2};
  std::vector<std::array<Index, 2>> sides(partition.points.size(), kNone);
  std::vector<char> on_curve(partition.points.size(), 0);
  for (std::size_t t = 0; t < partition.triangles.size(); ++t) {
    for (const Index p : partition.triangles[t]) {
      if (sides[p] != kNone && sides[p] != partition.sides[t]) on_curve[p] = 1;
      sides[p] = partition.sides[t];
    }
  }
  return on_curve;
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

}  // namespace mesamis::detail::surface
