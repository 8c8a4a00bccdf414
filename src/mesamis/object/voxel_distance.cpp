// SPDX-License-Identifier: Apache-2.0
#include "mesamis/object/voxel_distance.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "mesamis/base/error.h"
#include "mesamis/base/parallel.h"

namespace mesamis::detail::object {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One line of squared distances, and the parabolas that are its least values.
class Line {
 public:
  explicit Line(std::size_t count) : values_(count), vertex_(count), from_(count + 1) {}

  /// Replaces n values, `step` apart, by their least sum with the squared distance along the line.
  void transform(float* first, std::size_t step, double spacing) {
    for (std::size_t q = 0; q < values_.size(); ++q) values_[q] = first[q * step];
    // Where all are equal, none is nearer by way of another: most lines are all 0 or all infinite.
    if (std::adjacent_find(values_.begin(), values_.end(), std::not_equal_to()) == values_.end()) {
      return;
    }
    const double square = spacing * spacing;
    const std::size_t parabolas = lower_envelope(square);
    if (parabolas == 0) return;
    std::size_t at = 0;
    for (std::size_t q = 0; q < values_.size(); ++q) {
      while (at + 1 < parabolas && from_[at + 1] < static_cast<double>(q)) ++at;
      const double away = static_cast<double>(q) - static_cast<double>(vertex_[at]);
      first[q * step] = static_cast<float>(square * away * away + values_[vertex_[at]]);
    }
  }

 private:
  /// Where the parabola at q begins to be less than that at p < q, in steps.
  double crossing(std::size_t p, std::size_t q, double square) const {
    const auto x = static_cast<double>(p), y = static_cast<double>(q);
    return ((values_[q] - values_[p]) / square + y * y - x * x) / (2 * (y - x));
  }

  std::size_t lower_envelope(double square) {
    std::size_t count = 0;
    for (std::size_t q = 0; q < values_.size(); ++q) {
      if (values_[q] == kInfinity) continue;
      while (count > 0 && crossing(vertex_[count - 1], q, square) <= from_[count - 1]) --count;
      from_[count] = count > 0 ? crossing(vertex_[count - 1], q, square) : -kInfinity;
      vertex_[count++] = q;
    }
    return count;
  }

  std::vector<double> values_;
  std::vector<std::size_t> vertex_;
  std::vector<double> from_;  // where each parabola begins to be the least
};

/// Transforms all lines along an axis.
void along_axis(std::vector<float>& squares, const VoxelGrid& grid, int axis) {
  constexpr std::size_t kLines = 64;  // per block
  std::array<std::size_t, 3> size;
  for (std::size_t a = 0; a < 3; ++a) size[a] = static_cast<std::size_t>(grid.size[a]);
  const std::array<std::size_t, 3> step{1, size[0], size[0] * size[1]};
  const auto a = static_cast<std::size_t>(axis);
  const std::size_t b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2;
  parallel_blocks(size[b] * size[c], kLines, [&](std::size_t begin, std::size_t end) {
    Line line(size[a]);
    for (std::size_t n = begin; n < end; ++n) {
      float* first = squares.data() + (n % size[b]) * step[b] + (n / size[b]) * step[c];
      line.transform(first, step[a], grid.spacing[axis]);
    }
  });
}

}  // namespace

void require_mask_of(std::span<const std::uint8_t> mask, const VoxelGrid& grid) {
  if (mask.size() == grid.voxel_count()) return;
  throw InputError("mask: expected a mark for each of " + std::to_string(grid.voxel_count()) +
                   " voxels, found " + std::to_string(mask.size()));
}

std::vector<float> distance_to_mask(std::span<const std::uint8_t> mask, const VoxelGrid& grid) {
  require_mask_of(mask, grid);
  std::vector<float> values(mask.size());
  parallel_for(values.size(), [&](std::size_t n) {
    values[n] = mask[n] != 0 ? 0 : std::numeric_limits<float>::infinity();
  });
  for (int axis = 0; axis < 3; ++axis) along_axis(values, grid, axis);
  parallel_for(values.size(), [&](std::size_t n) { values[n] = std::sqrt(values[n]); });
  return values;
}

VoxelMask dilated(std::span<const std::uint8_t> mask, const VoxelGrid& grid, double mm) {
  constexpr double kRounding = 1e-6;
  if (!(mm >= 0)) {
    throw InputError("margin: expected mm of at least 0, found " + std::to_string(mm));
  }
  const std::vector<float> distance = distance_to_mask(mask, grid);
  VoxelMask grown(mask.size());
  const double most = mm * (1 + kRounding);
  parallel_for(grown.size(), [&](std::size_t n) { grown[n] = distance[n] <= most; });
  return grown;
}

VoxelMask eroded(std::span<const std::uint8_t> mask, const VoxelGrid& grid, double mm) {
  return complement(dilated(complement(mask), grid, mm));
}

VoxelMask complement(std::span<const std::uint8_t> mask) {
  VoxelMask other(mask.size());
  parallel_for(mask.size(), [&](std::size_t n) { other[n] = mask[n] == 0; });
  return other;
}

VoxelMask only_in(std::span<const std::uint8_t> mask, std::span<const std::uint8_t> other) {
  VoxelMask rest(mask.size());
  parallel_for(mask.size(), [&](std::size_t n) { rest[n] = mask[n] != 0 && other[n] == 0; });
  return rest;
}

std::size_t count_marked(std::span<const std::uint8_t> mask) {
  return mask.size() -
         static_cast<std::size_t>(std::count(mask.begin(), mask.end(), std::uint8_t{0}));
}

}  // namespace mesamis::detail::object
