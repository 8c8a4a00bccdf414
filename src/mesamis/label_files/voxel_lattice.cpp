// SPDX-License-Identifier: Apache-2.0
#include "mesamis/label_files/voxel_lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesamis/files/refuse.h"
#include "mesamis/label_files/mask_folder.h"

namespace mesamis::detail::label_files {
namespace {

constexpr double kMostShift = 1e-3;  // voxels

/// A point of a grid in voxels of another one.
Vec3 in_voxels_of(const VoxelGrid& other, const VoxelGrid& grid, const Vec3& voxel) {
  Vec3 mm;
  for (int a = 0; a < 3; ++a) mm[a] = voxel[a] * grid.spacing[a];
  Vec3 found = other.to_grid(grid.to_world(mm));
  for (int a = 0; a < 3; ++a) found[a] /= other.spacing[a];
  return found;
}

/// The whole numbers nearest to a vector; none if one is beyond counting.
std::optional<std::array<std::int64_t, 3>> whole(const Vec3& v) {
  std::array<std::int64_t, 3> numbers{};
  for (int a = 0; a < 3; ++a) {
    if (!(std::abs(v[a]) < std::numeric_limits<Index>::max())) return std::nullopt;
    numbers[static_cast<std::size_t>(a)] = std::llround(v[a]);
  }
  return numbers;
}

bool is_unit(const std::array<std::int64_t, 3>& step) {
  return std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]) == 1;
}

std::array<Index, 3> corner_of(const VoxelGrid& grid, unsigned corner) {
  std::array<Index, 3> voxel{};
  for (std::size_t a = 0; a < 3; ++a) voxel[a] = (corner >> a & 1) != 0 ? grid.size[a] - 1 : 0;
  return voxel;
}

/// The greatest distance of the corners from the voxels that they are taken for.
double shift_of(const VoxelGrid& grid, const VoxelGrid& other, const LatticePlace& place) {
  double shift = 0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const auto voxel = corner_of(grid, corner);
    const auto to = place.at(voxel);
    const Vec3 found = in_voxels_of(other, grid, {1.0 * voxel[0], 1.0 * voxel[1], 1.0 * voxel[2]});
    for (int a = 0; a < 3; ++a) {
      const auto expected = static_cast<double>(to[static_cast<std::size_t>(a)]);
      shift = std::max(shift, std::abs(found[a] - expected));
    }
  }
  return shift;
}

/// A range of voxels of the first grid.
struct VoxelRange {
  std::array<std::int64_t, 3> low{}, high{};

  void include(const std::array<std::int64_t, 3>& voxel) {
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], voxel[a]);
      high[a] = std::max(high[a], voxel[a]);
    }
  }
};

VoxelGrid cut_out(const std::filesystem::path& file, VoxelGrid grid, const VoxelRange& range) {
  constexpr double kMostVoxels = 1099511627776;  // 2^40
  Vec3 low_mm;
  double voxels = 1;
  for (int a = 0; a < 3; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    const std::int64_t count = range.high[axis] - range.low[axis] + 1;
    voxels *= static_cast<double>(count);
    if (count > std::numeric_limits<Index>::max() || voxels > kMostVoxels) {
      refuse(
          file,
          "expected masks near each other, found masks that need a grid of more than 2^40 voxels");
    }
    grid.size[axis] = static_cast<Index>(count);
    low_mm[a] = static_cast<double>(range.low[axis]) * grid.spacing[a];
  }
  grid.origin = grid.to_world(low_mm);
  return grid;
}

}  // namespace

std::array<std::int64_t, 3> LatticePlace::at(const std::array<Index, 3>& voxel) const noexcept {
  std::array<std::int64_t, 3> place = first;
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) place[b] += steps[a][b] * voxel[a];
  }
  return place;
}

std::optional<LatticePlace> find_place(const VoxelGrid& grid, const VoxelGrid& other) {
  const Vec3 origin = in_voxels_of(other, grid, {});
  const auto first = whole(origin);
  if (!first) return std::nullopt;
  LatticePlace place{*first, {}};
  for (int a = 0; a < 3; ++a) {
    Vec3 next;
    next[a] = 1;
    const auto step = whole(in_voxels_of(other, grid, next) - origin);
    if (!step || !is_unit(*step)) return std::nullopt;
    place.steps[static_cast<std::size_t>(a)] = *step;
  }
  if (!(shift_of(grid, other, place) <= kMostShift)) return std::nullopt;
  return place;
}

VoxelGrid enclosing_grid(std::span<const std::filesystem::path> files,
                         std::span<const VoxelGrid> grids) {
  const VoxelGrid& first = grids.front();
  VoxelRange range;
  for (std::size_t n = 0; n < grids.size(); ++n) {
    const auto place = find_place(grids[n], first);
    if (!place) {
      require_same_grid(files[n], grids[n], files[0], first);
      refuse(files[n], "expected the voxels of " + shown(files[0].filename().string()) +
                           ", found some that lie between them");
    }
    for (unsigned corner = 0; corner < 8; ++corner) {
      range.include(place->at(corner_of(grids[n], corner)));
    }
  }
  return cut_out(files[0], first, range);
}

}  // namespace mesamis::detail::label_files
