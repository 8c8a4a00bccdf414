// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/split_at_seeds.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <string>
#include <tuple>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"
#include "mesamis/object/voxel_distance.h"
#include "mesamis/object/voxel_islands.h"
#include "mesamis/object/voxel_neighbours.h"

namespace mesamis::detail::object {
namespace {

/// The value that a tenth of the marked samples above the level exceed.
double bright_value(const VolumeView& volume, std::span<const std::uint8_t> mask, double level) {
  std::vector<float> marked;
  for (std::size_t n = 0; n < mask.size(); ++n) {
    if (mask[n] != 0 && volume.samples[n] > level) marked.push_back(volume.samples[n]);
  }
  if (marked.empty()) return level + 1;
  const auto tenth = marked.begin() + static_cast<std::ptrdiff_t>(marked.size() * 9 / 10);
  std::nth_element(marked.begin(), tenth, marked.end());
  return *tenth;
}

/// The depth in a mask, mm. What is beyond the grid counts as within it.
std::vector<float> depths(std::span<const std::uint8_t> mask, const VoxelGrid& grid) {
  std::vector<float> depth = distance_to_mask(complement(mask), grid);
  const auto farthest = static_cast<float>(norm(grid.box().extent()));
  for (float& mm : depth) mm = std::min(mm, farthest);
  return depth;
}

/// Depth times brightness, see the header; what is marked but not above the level is a cavity.
std::vector<float> strengths(const VolumeView& volume, std::span<const std::uint8_t> mask,
                             double level, std::vector<float> depth) {
  const double bright = bright_value(volume, mask, level);
  parallel_for(depth.size(), [&](std::size_t n) {
    const double value = volume.samples[n];
    const double above = value > level ? (value - level) / (bright - level) : 1;
    depth[n] *= static_cast<float>(std::clamp(above, 0.0, 1.0));
  });
  return depth;
}

/// The deepest marked voxel within the ball around a voxel that its depth makes, and one voxel
/// more.
std::size_t deepest_nearby(const VoxelGrid& grid, const std::vector<float>& depth,
                           std::size_t from) {
  const double most = depth[from] + std::max({grid.spacing.x, grid.spacing.y, grid.spacing.z});
  const auto v = grid.voxel(from);
  std::array<std::array<Index, 2>, 3> range;
  for (std::size_t a = 0; a < 3; ++a)
    range[a] = voxels_around(grid, static_cast<int>(a), v[a], most);
  std::size_t deepest = from;
  for (Index k = range[2][0]; k <= range[2][1]; ++k) {
    for (Index j = range[1][0]; j <= range[1][1]; ++j) {
      for (Index i = range[0][0]; i <= range[0][1]; ++i) {
        const std::size_t n = grid.offset(i, j, k);
        if (!(depth[n] > depth[deepest])) continue;
        const Vec3 away{(i - v[0]) * grid.spacing.x, (j - v[1]) * grid.spacing.y,
                        (k - v[2]) * grid.spacing.z};
        if (norm(away) <= most) deepest = n;
      }
    }
  }
  return deepest;
}

/// Climbs from a voxel to where the object is deepest. A part would otherwise begin with the thin
/// end that a seed happens to lie in, after a thicker neighbour has come through the neck.
std::size_t climb(const VoxelGrid& grid, const std::vector<float>& depth, std::size_t from) {
  for (std::size_t next = from;; from = next) {
    next = deepest_nearby(grid, depth, from);
    if (next == from) return from;
  }
}

/// A voxel next to a part: what is taken first is greatest.
struct Candidate {
  float strength;
  std::size_t step;  // when it was reached
  std::size_t voxel;
  std::uint16_t label;

  bool operator<(const Candidate& other) const {
    return std::tie(strength, other.step, other.voxel, other.label) <
           std::tie(other.strength, step, voxel, label);
  }
};

/// The watershed.
class Flood {
 public:
  Flood(const VoxelGrid& grid, std::span<const std::uint8_t> mask, std::vector<float> strength)
      : grid_(grid), mask_(mask), strength_(std::move(strength)), labels_(mask.size(), 0) {}

  void add_seed(std::size_t voxel, std::uint16_t label) {
    open_.push({kSeedStrength, 0, voxel, label});
  }

  std::vector<std::uint16_t> run() {
    while (!open_.empty()) {
      const Candidate next = open_.top();
      open_.pop();
      if (labels_[next.voxel] == 0) take(next);
    }
    return std::move(labels_);
  }

 private:
  static constexpr float kSeedStrength = std::numeric_limits<float>::infinity();

  void take(const Candidate& c) {
    labels_[c.voxel] = c.label;
    for_each_neighbour(grid_, c.voxel, [&](std::size_t n, int) {
      if (mask_[n] != 0 && labels_[n] == 0) open_.push({strength_[n], c.step + 1, n, c.label});
    });
  }

  const VoxelGrid& grid_;
  std::span<const std::uint8_t> mask_;
  std::vector<float> strength_;
  std::vector<std::uint16_t> labels_;
  std::priority_queue<Candidate> open_;
};

/// The marked voxels that each seed stands for.
std::vector<std::vector<std::size_t>> places_of(std::span<const std::array<Index, 3>> seeds,
                                                std::span<const std::uint8_t> mask,
                                                const VoxelGrid& grid) {
  std::vector<std::vector<std::size_t>> places;
  places.reserve(seeds.size());
  for (const auto& seed : seeds) {
    for (std::size_t a = 0; a < 3; ++a) {
      if (seed[a] >= 0 && seed[a] < grid.size[a]) continue;
      throw InputError("seed: expected a voxel of the scan, found " + std::to_string(seed[a]) +
                       " along axis " + std::to_string(a));
    }
    places.push_back(marked_at(mask, grid, seed));
    const auto is_first = [&](const auto& others) { return others[0] == places.back()[0]; };
    if (std::count_if(places.begin(), places.end(), is_first) > 1) {
      throw InputError("seed: expected one per part, found two at the same voxel");
    }
  }
  return places;
}

}  // namespace

LabelMap split_at_seeds(const VolumeView& volume, std::span<const std::uint8_t> mask, double level,
                        std::span<const std::array<Index, 3>> seeds) {
  require_mask_of(mask, volume);
  if (seeds.empty() || seeds.size() > static_cast<std::size_t>(kMaxLabel)) {
    throw InputError("seed: expected 1 to " + std::to_string(kMaxLabel) + ", found " +
                     std::to_string(seeds.size()));
  }
  const auto places = places_of(seeds, mask, volume);
  const std::vector<float> depth = depths(mask, volume);
  std::vector<std::size_t> tops;
  tops.reserve(places.size());
  for (const auto& voxels : places) tops.push_back(climb(volume, depth, voxels[0]));
  Flood flood(volume, mask, strengths(volume, mask, level, depth));
  LabelMap map{volume, {}, {}};
  for (std::size_t n = 0; n < places.size(); ++n) {
    const auto label = static_cast<Index>(n + 1);
    for (const std::size_t voxel : places[n]) {
      flood.add_seed(voxel, static_cast<std::uint16_t>(label));
    }
    const bool is_its_own = std::count(tops.begin(), tops.end(), tops[n]) == 1;
    if (is_its_own) flood.add_seed(tops[n], static_cast<std::uint16_t>(label));
    map.segments.push_back({"part " + std::to_string(label), label, 0, default_colour(label)});
  }
  map.layers.push_back(flood.run());
  return map;
}

}  // namespace mesamis::detail::object
