// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/object/voxel_distance.h"

/// Masks and scans that the tests of the room share.
namespace mesamis {

inline VoxelGrid grid_of(const std::array<Index, 3>& size, const Vec3& spacing = {1, 1, 1}) {
  VoxelGrid grid;
  grid.size = size;
  grid.spacing = spacing;
  return grid;
}

/// Each voxel is marked with this probability.
inline VoxelMask random_mask(const VoxelGrid& grid, double probability, unsigned seed = 1) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  VoxelMask mask(grid.voxel_count());
  for (auto& mark : mask) mark = uniform(generator) < probability;
  return mask;
}

/// Calls visit(voxel, its place among the samples) for each voxel.
template <class Visit>
void for_each_voxel(const VoxelGrid& grid, Visit visit) {
  std::size_t n = 0;
  for (Index k = 0; k < grid.size[2]; ++k) {
    for (Index j = 0; j < grid.size[1]; ++j) {
      for (Index i = 0; i < grid.size[0]; ++i) visit(std::array<Index, 3>{i, j, k}, n++);
    }
  }
}

/// Marks the voxels whose centres (in the grid's own axes, mm) lie where a function is true.
template <class Function>
VoxelMask mask_where(const VoxelGrid& grid, Function&& is_inside) {
  VoxelMask mask(grid.voxel_count());
  for_each_voxel(grid, [&](const std::array<Index, 3>& v, std::size_t n) {
    mask[n] = is_inside(Vec3{v[0] * grid.spacing.x, v[1] * grid.spacing.y, v[2] * grid.spacing.z});
  });
  return mask;
}

/// A volume of one value per mark.
inline Volume volume_of(const VoxelGrid& grid, const VoxelMask& mask, float inside, float outside) {
  Volume volume{grid, {}};
  for (const auto mark : mask) volume.samples.push_back(mark != 0 ? inside : outside);
  return volume;
}

inline void add_noise(Volume& volume, double deviation, unsigned seed = 1) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> noise(0, deviation);
  for (float& x : volume.samples) x = static_cast<float>(x + noise(generator));
}

/// Voxels that are marked in the one and not in the other.
inline std::size_t count_missing(const VoxelMask& wanted, const VoxelMask& found) {
  std::size_t count = 0;
  for (std::size_t n = 0; n < wanted.size(); ++n) count += wanted[n] != 0 && found[n] == 0;
  return count;
}

}  // namespace mesamis
