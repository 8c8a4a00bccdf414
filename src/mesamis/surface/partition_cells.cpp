// SPDX-License-Identifier: Apache-2.0
#include "mesamis/surface/partition_cells.h"

#include <utility>

#include "mesamis/base/each_once.h"

namespace mesamis::detail::surface {
namespace {

template <class Site>
void sort_and_shrink(std::vector<Site>& sites) {
  sort_once(sites);
  sites.shrink_to_fit();
}

template <class Site>
Index place_of(const Site& site, const std::vector<Site>& sites) {
  return static_cast<Index>(std::lower_bound(sites.begin(), sites.end(), site) - sites.begin());
}

}  // namespace

PartitionBlock block_of(std::span<const PartitionPiece> pieces) {
  PartitionBlock block;
  block.sites.reserve(3 * pieces.size());
  for (const PartitionPiece& piece : pieces) {
    block.sites.insert(block.sites.end(), piece.corners.begin(), piece.corners.end());
  }
  sort_and_shrink(block.sites);
  block.triangles.reserve(pieces.size());
  block.sides.reserve(pieces.size());
  for (const auto& [corners, sides] : pieces) {
    Triangle triangle;
    for (std::size_t i = 0; i < 3; ++i) triangle[i] = place_of(corners[i], block.sites);
    block.triangles.push_back(triangle);
    block.sides.push_back(sides);
  }
  return block;
}

std::vector<Simplex> all_sites(std::span<const PartitionBlock> blocks) {
  std::vector<Simplex> sites;
  for (const PartitionBlock& block : blocks) {
    sites.insert(sites.end(), block.sites.begin(), block.sites.end());
  }
  sort_and_shrink(sites);
  return sites;
}

PartitionSurface over_sites(std::span<const PartitionBlock> blocks,
                            const std::vector<Simplex>& sites) {
  PartitionSurface partition;
  std::vector<std::size_t> first{0};
  for (const PartitionBlock& block : blocks) first.push_back(first.back() + block.sides.size());
  partition.triangles.resize(first.back());
  partition.sides.resize(first.back());
  parallel_for_each(blocks.size(), [&](std::size_t b) {
    std::vector<Index> places;
    places.reserve(blocks[b].sites.size());
    for (const Simplex& site : blocks[b].sites) places.push_back(place_of(site, sites));
    for (std::size_t t = 0; t < blocks[b].sides.size(); ++t) {
      Triangle& triangle = partition.triangles[first[b] + t];
      triangle = blocks[b].triangles[t];
      for (Index& p : triangle) p = places[static_cast<std::size_t>(p)];
      partition.sides[first[b] + t] = blocks[b].sides[t];
    }
  });
  return partition;
}

PartitionSurface join_parts(std::vector<PartitionPart> parts) {
  if (parts.size() == 1) return std::move(parts.front().surface);
  std::vector<WholeSite> sites;
  for (const PartitionPart& part : parts) {
    sites.insert(sites.end(), part.sites.begin(), part.sites.end());
  }
  sort_and_shrink(sites);
  PartitionSurface all;
  all.points.resize(sites.size());
  for (PartitionPart& part : parts) {
    std::vector<Index> places;
    places.reserve(part.sites.size());
    for (const WholeSite& site : part.sites) places.push_back(place_of(site, sites));
    for (std::size_t p = 0; p < places.size(); ++p) {
      all.points[static_cast<std::size_t>(places[p])] = part.surface.points[p];
    }
    for (Triangle t : part.surface.triangles) {
      for (Index& p : t) p = places[static_cast<std::size_t>(p)];
      all.triangles.push_back(t);
    }
    all.sides.insert(all.sides.end(), part.surface.sides.begin(), part.surface.sides.end());
    part = {};
  }
  return all;
}

}  // namespace mesamis::detail::surface
