// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/voxel_islands.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/object/voxel_neighbours.h"

namespace mesamis::detail::object {
namespace {

/// Gives an island's number to all voxels that the first reaches; counts them.
std::size_t flood(VoxelIslands& islands, std::span<const std::uint8_t> mask, const VoxelGrid& grid,
                  std::size_t first) {
  const auto number = static_cast<Index>(islands.voxels.size() + 1);
  std::vector<std::size_t> open{first};
  islands.of_voxel[first] = number;
  std::size_t count = 0;
  while (!open.empty()) {
    const std::size_t at = open.back();
    open.pop_back();
    ++count;
    for_each_neighbour(grid, at, [&](std::size_t next, int) {
      if (mask[next] == 0 || islands.of_voxel[next] != 0) return;
      islands.of_voxel[next] = number;
      open.push_back(next);
    });
  }
  return count;
}

/// The number of voxels of the island of a marked voxel, which is added unless it is there.
std::size_t add_island(VoxelIslands& islands, std::span<const std::uint8_t> mask,
                       const VoxelGrid& grid, std::size_t voxel) {
  if (islands.of_voxel[voxel] == 0) {
    const std::size_t count = flood(islands, mask, grid, voxel);
    islands.voxels.push_back(count);
  }
  return islands.voxels[static_cast<std::size_t>(islands.of_voxel[voxel] - 1)];
}

/// A straight way over voxels.
struct Way {
  std::array<Index, 3> from, step;
  Index most_steps;
};

struct WayEnd {
  Index steps = 0;        ///< to the first marked voxel; 0: none is met
  std::size_t voxel = 0;  ///< that one
  bool leaves_grid = false;
};

/// @param is_met  tells whether a voxel ends the way.
template <class IsMet>
WayEnd end_of(const Way& way, const VoxelGrid& grid, IsMet&& is_met) {
  std::array<Index, 3> v = way.from;
  for (Index n = 1; n <= way.most_steps; ++n) {
    for (std::size_t a = 0; a < 3; ++a) {
      v[a] += way.step[a];
      if (v[a] < 0 || v[a] >= grid.size[a]) return {.leaves_grid = true};
    }
    const std::size_t voxel = grid.offset(v[0], v[1], v[2]);
    if (is_met(voxel)) return {n, voxel};
  }
  return {};
}

/// The voxels around a place that end the ways from it, see find_marked_at().
template <class IsMet>
std::vector<std::size_t> enclosing(const VoxelGrid& grid, const std::array<Index, 3>& from,
                                   IsMet&& is_met) {
  constexpr double kMostMm = 30, kLeastShare = 0.75, kMostOfMedian = 1.5;
  constexpr std::size_t kLeast = 13;                // half of all ways
  std::vector<std::pair<double, std::size_t>> met;  // how far, mm, and the voxel
  std::size_t ways = 0;
  for (Index way = 0; way < 27; ++way) {
    const std::array<Index, 3> step{way % 3 - 1, way / 3 % 3 - 1, way / 9 - 1};
    const double mm =
        norm(Vec3{step[0] * grid.spacing.x, step[1] * grid.spacing.y, step[2] * grid.spacing.z});
    if (mm == 0) continue;
    const WayEnd end = end_of({from, step, static_cast<Index>(kMostMm / mm)}, grid, is_met);
    if (end.steps > 0) met.emplace_back(end.steps * mm, end.voxel);
    if (!end.leaves_grid) ++ways;
  }
  const bool is_enclosed = met.size() >= kLeast && static_cast<double>(met.size()) >=
                                                       kLeastShare * static_cast<double>(ways);
  if (!is_enclosed) return {};
  std::sort(met.begin(), met.end());
  std::vector<std::size_t> voxels;
  voxels.reserve(met.size());
  for (const auto& [mm, voxel] : met) {
    if (mm <= kMostOfMedian * met[met.size() / 2].first) voxels.push_back(voxel);
  }
  return voxels;
}

}  // namespace

Index VoxelIslands::largest() const noexcept {
  if (voxels.empty()) return 0;
  return static_cast<Index>(std::max_element(voxels.begin(), voxels.end()) - voxels.begin()) + 1;
}

VoxelIslands find_islands(std::span<const std::uint8_t> mask, const VoxelGrid& grid) {
  require_mask_of(mask, grid);
  VoxelIslands islands{std::vector<Index>(mask.size(), 0), {}};
  for (std::size_t n = 0; n < mask.size(); ++n) {
    if (mask[n] != 0) add_island(islands, mask, grid, n);
  }
  return islands;
}

std::vector<CropRange> ranges_of(const VoxelIslands& islands, const VoxelGrid& grid) {
  std::vector<CropRange> ranges(islands.voxels.size(), {grid.size, {0, 0, 0}});
  for (std::size_t n = 0; n < islands.of_voxel.size(); ++n) {
    if (islands.of_voxel[n] == 0) continue;
    CropRange& range = ranges[static_cast<std::size_t>(islands.of_voxel[n] - 1)];
    std::size_t rest = n;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto place = static_cast<Index>(rest % static_cast<std::size_t>(grid.size[a]));
      rest /= static_cast<std::size_t>(grid.size[a]);
      range.begin[a] = std::min(range.begin[a], place);
      range.end[a] = std::max(range.end[a], place + 1);
    }
  }
  return ranges;
}

VoxelMask mask_of_island(const VoxelIslands& islands, Index island) {
  VoxelMask mask(islands.of_voxel.size());
  parallel_for(mask.size(), [&](std::size_t n) { mask[n] = islands.of_voxel[n] == island; });
  return mask;
}

std::optional<std::size_t> find_marked(std::span<const std::uint8_t> mask, const VoxelGrid& grid,
                                       const std::array<Index, 3>& from, double most_mm) {
  require_mask_of(mask, grid);
  const auto in_x = voxels_around(grid, 0, from[0], most_mm);
  const auto in_y = voxels_around(grid, 1, from[1], most_mm);
  const auto in_z = voxels_around(grid, 2, from[2], most_mm);
  double least = most_mm * (1 + 1e-9);
  std::optional<std::size_t> nearest;
  for (Index k = in_z[0]; k <= in_z[1]; ++k) {
    for (Index j = in_y[0]; j <= in_y[1]; ++j) {
      for (Index i = in_x[0]; i <= in_x[1]; ++i) {
        const std::size_t n = grid.offset(i, j, k);
        if (mask[n] == 0) continue;
        const double mm = norm(Vec3{(i - from[0]) * grid.spacing.x, (j - from[1]) * grid.spacing.y,
                                    (k - from[2]) * grid.spacing.z});
        if (mm > least || (mm == least && nearest)) continue;
        least = mm;
        nearest = n;
      }
    }
  }
  return nearest;
}

namespace {

/// The marked voxel that a place lies beside.
std::optional<std::size_t> find_beside(std::span<const std::uint8_t> mask, const VoxelGrid& grid,
                                       const std::array<Index, 3>& at) {
  return find_marked(mask, grid, at, std::max(kBesideMm, grid.voxel_size()));
}

}  // namespace

std::vector<std::size_t> find_marked_at(std::span<const std::uint8_t> mask, const VoxelGrid& grid,
                                        const std::array<Index, 3>& at) {
  constexpr std::size_t kCrumb = 10;  // so many times as large is what it lies in
  VoxelIslands islands{std::vector<Index>(mask.size(), 0), {}};
  const auto nearest = find_beside(mask, grid, at);
  const std::size_t own = nearest ? add_island(islands, mask, grid, *nearest) : 0;
  std::vector<std::size_t> around =
      enclosing(grid, at, [&](std::size_t n) { return mask[n] != 0 && islands.of_voxel[n] == 0; });
  Index largest = 0;
  std::size_t most = 0;
  for (const std::size_t voxel : around) {
    const std::size_t size = add_island(islands, mask, grid, voxel);
    if (size <= std::max(kCrumb * own, most)) continue;
    most = size;
    largest = islands.of_voxel[voxel];
  }
  std::erase_if(around, [&](std::size_t n) { return islands.of_voxel[n] != largest; });
  return around.empty() && nearest ? std::vector{*nearest} : around;
}

bool has_marked_at(std::span<const std::uint8_t> mask, const VoxelGrid& grid,
                   const std::array<Index, 3>& at) {
  return find_beside(mask, grid, at) ||
         !enclosing(grid, at, [&](std::size_t n) { return mask[n] != 0; }).empty();
}

std::vector<std::size_t> marked_at(std::span<const std::uint8_t> mask, const VoxelGrid& grid,
                                   const std::array<Index, 3>& at) {
  std::vector<std::size_t> found = find_marked_at(mask, grid, at);
  if (!found.empty()) return found;
  std::array<char, 120> text;
  std::snprintf(text.data(), text.size(),
                "place: expected one of the object, found nothing of it within %g mm or around it",
                kBesideMm);
  throw InputError(text.data());
}

VoxelMask island_at(std::span<const std::uint8_t> mask, const VoxelGrid& grid,
                    const std::array<Index, 3>& at) {
  VoxelIslands island{std::vector<Index>(mask.size(), 0), {}};
  flood(island, mask, grid, marked_at(mask, grid, at).front());
  return mask_of_island(island, 1);
}

VoxelMask without_cavities(std::span<const std::uint8_t> mask, const VoxelGrid& grid) {
  require_mask_of(mask, grid);
  const VoxelIslands gaps = find_islands(complement(mask), grid);
  std::vector<std::uint8_t> is_open(gaps.voxels.size() + 1, 0);
  for (std::size_t n = 0; n < mask.size(); ++n) {
    if (is_at_border(grid, n)) is_open[static_cast<std::size_t>(gaps.of_voxel[n])] = 1;
  }
  VoxelMask filled(mask.size());
  for (std::size_t n = 0; n < mask.size(); ++n) {
    filled[n] = mask[n] != 0 || is_open[static_cast<std::size_t>(gaps.of_voxel[n])] == 0;
  }
  return filled;
}

VoxelMask without_cavities_in_slices(std::span<const std::uint8_t> mask, const VoxelGrid& grid,
                                     int axis) {
  require_mask_of(mask, grid);
  const std::size_t u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2,
                    w = static_cast<std::size_t>(axis);
  VoxelGrid slice;
  slice.size = {grid.size[u], grid.size[v], 1};
  const auto columns = static_cast<std::size_t>(slice.size[0]);
  const std::array<std::size_t, 3> step{1, grid.offset(0, 1, 0), grid.offset(0, 0, 1)};
  VoxelMask filled(mask.size());
  parallel_for_each(static_cast<std::size_t>(grid.size[w]), [&](std::size_t k) {
    const auto place = [&](std::size_t n) {
      return k * step[w] + n % columns * step[u] + n / columns * step[v];
    };
    VoxelMask in_slice(slice.voxel_count());
    for (std::size_t n = 0; n < in_slice.size(); ++n) in_slice[n] = mask[place(n)];
    in_slice = without_cavities(in_slice, slice);
    for (std::size_t n = 0; n < in_slice.size(); ++n) filled[place(n)] = in_slice[n];
  });
  return filled;
}

VoxelMask mask_above(const VolumeView& volume, double level) {
  VoxelMask mask(volume.samples.size());
  parallel_for(mask.size(), [&](std::size_t n) { mask[n] = volume.samples[n] > level; });
  return mask;
}

}  // namespace mesamis::detail::object
