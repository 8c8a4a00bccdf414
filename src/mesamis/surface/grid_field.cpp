// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/grid_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"

namespace mesamis::detail::surface {
namespace {

void require(bool holds, const char* what) {
  if (!holds) throw InputError(std::string("grid of memberships: expected ") + what);
}

template <class Values, class IsGood>
bool all_are(const Values& values, IsGood is_good) {
  return std::all_of(values.begin(), values.end(), is_good);
}

}  // namespace

void require_memberships(const GridMemberships& grid) {
  const auto [x, y, z] = grid.size;
  require(std::min({x, y, z}) >= 2, "2 or more nodes a side");
  for (const double spacing : {grid.spacing.x, grid.spacing.y, grid.spacing.z}) {
    require(spacing > 0 && std::isfinite(spacing), "a finite spacing above 0");
  }
  const std::int64_t layer = std::int64_t{x} * y;
  require(layer <= std::numeric_limits<Index>::max() / z, "fewer than 2^31 nodes");
  const auto nodes = static_cast<std::size_t>(layer * z);
  require(grid.material.size() == nodes, "one material per node");
  require(grid.first.size() == nodes + 1 && grid.first.front() == 0 &&
              std::is_sorted(grid.first.begin(), grid.first.end()),
          "lists of memberships one after the other");
  const auto entries = static_cast<std::size_t>(grid.first.back());
  require(grid.listed.size() == entries && grid.value.size() == entries,
          "one value per material listed");
  const auto is_material = [&](Index m) { return m >= 0 && m < std::ssize(grid.label); };
  require(all_are(grid.material, is_material) && all_are(grid.listed, is_material),
          "materials that have a label");
  require(all_are(grid.label, [](Index l) { return l >= 0; }), "labels of 0 or more");
  require(all_are(grid.value, [](float v) { return std::isfinite(v); }), "finite memberships");
}

PartitionPart named_wholly(const GridMemberships& grid, JoinedBlocks blocks) {
  const auto label = [&](Index material) { return grid.label[static_cast<std::size_t>(material)]; };
  PartitionPart part{{}, std::move(blocks.surface)};
  PartitionSurface& partition = part.surface;
  parallel_for(partition.sides.size(), [&](std::size_t t) {
    auto& [behind, before] = partition.sides[t];
    behind = label(behind);
    if (before == kNoIndex) return;
    before = label(before);
    if (before > behind) return;
    std::swap(behind, before);
    std::swap(partition.triangles[t][1], partition.triangles[t][2]);
  });
  const std::int64_t first = std::int64_t{grid.below} * grid.size[0] * grid.size[1];
  part.sites.reserve(blocks.sites.size());
  for (const Simplex& site : blocks.sites) {
    WholeSite& whole = part.sites.emplace_back();
    std::transform(site.begin(), site.end(), whole.begin(), [&](Index node) {
      return node == kNoIndex ? std::int64_t{kNoIndex} : node + first;
    });
  }
  return part;
}

void require_slices(const GridMemberships& grid, const NodeSlices& slices, Index below,
                    Index above) {
  const auto [begin, end] = slices;
  require(begin >= 0 && begin <= end && end <= grid.size[2], "slices of the grid");
  require(begin >= std::min(below, begin + grid.below) &&
              grid.size[2] - end >= std::min(above, grid.size[2] - end + grid.above),
          "the slices beside those that are wanted");
}

}  // namespace mesamis::detail::surface
