// SPDX-License-Identifier: Apache-2.0
#include "mesamis/labels/label_block.h"

#include <algorithm>
#include <cmath>

#include "mesamis/base/parallel.h"

namespace mesamis::detail::labels {
namespace {

constexpr Index kRoom = 4;  // voxels beside the room asked for

/// The voxels of all these segments; nothing if there are none.
std::optional<CropRange> range_of_all(const LabelMap& map, std::span<const Segment> chosen) {
  std::optional<CropRange> all;
  const auto ranges = ranges_of(map);
  for (std::size_t n = 0; n < ranges.size(); ++n) {
    const Segment& s = map.segments[n];
    const bool wanted = std::any_of(chosen.begin(), chosen.end(), [&](const Segment& c) {
      return c.label == s.label && c.layer == s.layer;
    });
    if (!wanted || !ranges[n]) continue;
    if (!all) all = ranges[n];
    for (std::size_t a = 0; a < 3; ++a) {
      all->begin[a] = std::min(all->begin[a], ranges[n]->begin[a]);
      all->end[a] = std::max(all->end[a], ranges[n]->end[a]);
    }
  }
  return all;
}

}  // namespace

LabelBlock block_around(const VoxelGrid& grid, const CropRange& range, double room) {
  LabelBlock block;
  for (std::size_t a = 0; a < 3; ++a) {
    const double spacing = grid.spacing[static_cast<int>(a)];
    const Index around = static_cast<Index>(std::ceil(room / spacing)) + kRoom;
    block.begin[a] = range.begin[a] - around;
    block.size[a] = range.end[a] + around - block.begin[a];
  }
  return block;
}

std::optional<LabelBlock> block_around(const LabelMap& map, std::span<const Segment> chosen,
                                       double room) {
  const auto range = range_of_all(map, chosen);
  if (!range) return std::nullopt;
  return block_around(map, *range, room);
}

LabelBlock clipped(const LabelBlock& block, const VoxelGrid& grid) {
  LabelBlock part;
  for (std::size_t a = 0; a < 3; ++a) {
    const Index end =
        std::clamp(block.begin[a] + block.size[a], std::min(2, grid.size[a]), grid.size[a]);
    part.begin[a] = std::clamp(block.begin[a], 0, std::max(0, end - 2));
    part.size[a] = end - part.begin[a];
  }
  return part;
}

VoxelGrid grid_of(const VoxelGrid& grid, const LabelBlock& block) {
  VoxelGrid part = grid;
  part.size = block.size;
  part.origin = grid.to_world({block.begin[0] * grid.spacing.x, block.begin[1] * grid.spacing.y,
                               block.begin[2] * grid.spacing.z});
  return part;
}

std::vector<std::uint16_t> labels_in(const LabelMap& map, Index layer, const LabelBlock& block) {
  VoxelGrid grid;
  grid.size = block.size;
  std::vector<std::uint16_t> part(grid.voxel_count(), 0);
  std::array<Index, 3> lo, hi;  // of what lies within both, hi beyond the last
  for (std::size_t a = 0; a < 3; ++a) {
    lo[a] = std::max(0, block.begin[a]);
    hi[a] = std::min(map.size[a], block.begin[a] + block.size[a]);
    if (hi[a] <= lo[a]) return part;
  }
  const std::vector<std::uint16_t>& from = map.layers[static_cast<std::size_t>(layer)];
  for (Index k = lo[2]; k < hi[2]; ++k) {
    for (Index j = lo[1]; j < hi[1]; ++j) {
      const auto row = from.begin() + static_cast<std::ptrdiff_t>(map.offset(lo[0], j, k));
      const auto to = grid.offset(lo[0] - block.begin[0], j - block.begin[1], k - block.begin[2]);
      std::copy_n(row, hi[0] - lo[0], part.begin() + static_cast<std::ptrdiff_t>(to));
    }
  }
  return part;
}

void keep_chosen(std::span<const char> chosen, std::vector<std::uint16_t>& labels) {
  parallel_for(labels.size(), [&](std::size_t n) {
    if (chosen[labels[n]] == 0) labels[n] = 0;
  });
}

}  // namespace mesamis::detail::labels
