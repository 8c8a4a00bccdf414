// SPDX-License-Identifier: Apache-2.0
#include "mesamis/labels/probable_memberships.h"

#include <numeric>

#include "mesamis/base/parallel.h"
#include "mesamis/surface/list_materials.h"

namespace mesamis::detail::labels {
namespace {

/// What of 1 the objects leave, and who is the most probable.
std::vector<float> find_winners(const Probabilities& from, const VoxelGrid& grid,
                                std::vector<Index>& material) {
  std::vector<float> rest(grid.voxel_count(), 1), most(grid.voxel_count(), 0);
  for (std::size_t o = 0; o < from.layers.size(); ++o) {
    const std::vector<float> p = probability_on(from, static_cast<Index>(o), grid);
    parallel_for(p.size(), [&](std::size_t n) {
      rest[n] -= p[n];
      if (p[n] <= most[n]) return;
      most[n] = p[n];
      material[n] = static_cast<Index>(o) + 1;
    });
  }
  parallel_for(rest.size(), [&](std::size_t n) {
    if (rest[n] >= most[n]) material[n] = 0;
  });
  return rest;
}

/// Sets the values of one material where it is listed.
void fill_in(const std::vector<float>& values, Index material, GridMemberships& grid) {
  parallel_for(values.size(), [&](std::size_t n) {
    const auto end = static_cast<std::size_t>(grid.first[n + 1]);
    for (auto i = static_cast<std::size_t>(grid.first[n]); i < end; ++i) {
      if (grid.listed[i] == material) grid.value[i] = values[n];
    }
  });
}

}  // namespace

GridMemberships probable_memberships(const Probabilities& from, const VoxelGrid& grid) {
  GridMemberships found{.size = grid.size,
                        .spacing = grid.spacing,
                        .material = std::vector<Index>(grid.voxel_count(), 0),
                        .label = std::vector<Index>(from.layers.size() + 1),
                        .first = {},
                        .listed = {},
                        .value = {}};
  std::iota(found.label.begin(), found.label.end(), 0);
  const std::vector<float> rest = find_winners(from, grid, found.material);
  list_materials(found);
  fill_in(rest, 0, found);
  for (std::size_t o = 0; o < from.layers.size(); ++o) {
    const auto object = static_cast<Index>(o);
    fill_in(probability_on(from, object, grid), object + 1, found);
  }
  return found;
}

std::vector<std::uint16_t> winning_labels(const GridMemberships& memberships) {
  std::vector<std::uint16_t> labels;
  labels.reserve(memberships.material.size());
  for (const Index material : memberships.material) {
    labels.push_back(
        static_cast<std::uint16_t>(memberships.label[static_cast<std::size_t>(material)]));
  }
  return labels;
}

}  // namespace mesamis::detail::labels
