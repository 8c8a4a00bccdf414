// SPDX-License-Identifier: Apache-2.0
#include "mesamis/restore/level_crossings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "mesamis/base/parallel.h"

namespace mesamis::detail::restore {
namespace {

/// The largest float that is not above the level: a sample exceeds both or none.
float float_not_above(double level) {
  const auto rounded = static_cast<float>(level);
  return rounded > level ? std::nextafter(rounded, -std::numeric_limits<float>::infinity())
                         : rounded;
}

/// Where the lines from the voxels of a row to their next voxels cross the level: for each voxel a
/// byte with a bit for each axis, eight voxels to a word.
class RowCrossings {
 public:
  RowCrossings(const VolumeView& volume, double level)
      : volume_(volume),
        level_(float_not_above(level)),
        length_(static_cast<std::size_t>(volume.size[0])),
        bytes_((length_ + 7) / 8 * 8, 0) {}

  void find(Index j, Index k) {
    const auto [nx, ny, nz] = volume_.size;
    const float* row = volume_.samples.data() + volume_.offset(0, j, k);
    const auto layer = static_cast<std::ptrdiff_t>(nx) * ny;
    const float level = level_;
    const float* beside = j + 1 < ny ? row + nx : row;
    const float* above = k + 1 < nz ? row + layer : row;
    std::uint8_t* bytes = bytes_.data();
    for (std::size_t i = 0; i + 1 < length_; ++i) {
      const bool here = row[i] > level;
      const unsigned x = (row[i + 1] > level) != here, y = (beside[i] > level) != here,
                     z = (above[i] > level) != here;
      bytes[i] = static_cast<std::uint8_t>(x + 2 * y + 4 * z);
    }
    const std::size_t i = length_ - 1;
    const bool here = row[i] > level;
    const unsigned y = (beside[i] > level) != here, z = (above[i] > level) != here;
    bytes[i] = static_cast<std::uint8_t>(2 * y + 4 * z);
  }

  std::size_t words() const { return bytes_.size() / 8; }
  /// How often the lines of an axis cross the level, of the eight voxels of a word.
  std::size_t count(std::size_t word, int axis) const {
    constexpr std::uint64_t kOnes = 0x0101010101010101;
    std::uint64_t eight = 0;
    std::memcpy(&eight, bytes_.data() + 8 * word, 8);
    return (((eight >> axis) & kOnes) * kOnes) >> 56;
  }
  bool crosses(std::size_t i, int axis) const { return ((bytes_[i] >> axis) & 1) != 0; }

 private:
  const VolumeView& volume_;
  float level_;
  std::size_t length_;
  std::vector<std::uint8_t> bytes_;
};

using Counts = std::array<std::size_t, 3>;

std::size_t sum(const Counts& counts) { return counts[0] + counts[1] + counts[2]; }

/// How often the grid lines of each axis cross the level, from the voxels of each layer.
std::vector<Counts> count_crossings(const VolumeView& volume, double level) {
  std::vector<Counts> counts(static_cast<std::size_t>(volume.size[2]));
  parallel_for_each(counts.size(), [&](std::size_t layer) {
    RowCrossings row(volume, level);
    Counts of_layer{};
    for (Index j = 0; j < volume.size[1]; ++j) {
      row.find(j, static_cast<Index>(layer));
      for (std::size_t word = 0; word < row.words(); ++word) {
        for (int axis = 0; axis < 3; ++axis) of_layer[axis] += row.count(word, axis);
      }
    }
    counts[layer] = of_layer;
  });
  return counts;
}

/// The crossing between voxel `at` and the next one along the axis.
SurfacePoint crossing(const VolumeView& volume, double level, std::array<Index, 3> at, int axis) {
  auto next = at;
  ++next[axis];
  const double a = volume.at(at[0], at[1], at[2]), b = volume.at(next[0], next[1], next[2]);
  const double t = std::clamp((level - a) / (b - a), 0.0, 1.0);
  SurfacePoint point;
  for (int c = 0; c < 3; ++c) point.position[c] = at[c] * volume.spacing[c];
  point.position[axis] += t * volume.spacing[axis];
  const Vec3 g = (1 - t) * gradient_at(volume, at[0], at[1], at[2]) +
                 t * gradient_at(volume, next[0], next[1], next[2]);
  point.normal = -1.0 * unit_or_zero(g);
  return point;
}

/// The crossings of a layer whose number, counted through all layers, is a multiple of `every`.
/// @param number  of the layer's first.
std::vector<SurfacePoint> crossings_of_layer(const VolumeView& volume, double level, Index k,
                                             std::size_t number, std::size_t every) {
  RowCrossings row(volume, level);
  std::vector<SurfacePoint> points;
  std::size_t to_next = (every - number % every) % every;
  for (Index j = 0; j < volume.size[1]; ++j) {
    row.find(j, k);
    for (std::size_t word = 0; word < row.words(); ++word) {
      const std::size_t count = row.count(word, 0) + row.count(word, 1) + row.count(word, 2);
      if (to_next >= count) {
        to_next -= count;
        continue;
      }
      for (std::size_t n = 0; n < 24; ++n) {
        const std::size_t i = 8 * word + n / 3;
        const auto axis = static_cast<int>(n % 3);
        if (!row.crosses(i, axis)) continue;
        if (to_next > 0) {
          --to_next;
          continue;
        }
        points.push_back(crossing(volume, level, {static_cast<Index>(i), j, k}, axis));
        to_next = every - 1;
      }
    }
  }
  return points;
}

}  // namespace

Vec3 gradient_at(const VolumeView& volume, Index i, Index j, Index k) {
  const std::array<Index, 3> at{i, j, k};
  Vec3 g;
  for (int axis = 0; axis < 3; ++axis) {
    auto low = at, high = at;
    low[axis] = std::max(at[axis] - 1, 0);
    high[axis] = std::min(at[axis] + 1, volume.size[axis] - 1);
    g[axis] = (volume.at(high[0], high[1], high[2]) - volume.at(low[0], low[1], low[2])) /
              ((high[axis] - low[axis]) * volume.spacing[axis]);
  }
  return g;
}

std::vector<SurfacePoint> crossing_points(const VolumeView& volume, double level,
                                          std::size_t most) {
  const std::vector<Counts> counts = count_crossings(volume, level);
  std::vector<std::size_t> first{0};
  for (const Counts& layer : counts) first.push_back(first.back() + sum(layer));
  const std::size_t every = std::max<std::size_t>(1, first.back() / std::max<std::size_t>(1, most));
  return parallel_collect<SurfacePoint>(
      counts.size(), 1, [&](std::size_t k, std::size_t, auto& found) {
        found = crossings_of_layer(volume, level, static_cast<Index>(k), first[k], every);
      });
}

double level_area(const VolumeView& volume, double level) {
  Counts count{};
  for (const Counts& layer : count_crossings(volume, level)) {
    for (std::size_t a = 0; a < 3; ++a) count[a] += layer[a];
  }
  const Vec3& s = volume.spacing;
  return (static_cast<double>(count[0]) * s.y * s.z + static_cast<double>(count[1]) * s.x * s.z +
          static_cast<double>(count[2]) * s.x * s.y) /
         1.5;
}

}  // namespace mesamis::detail::restore
