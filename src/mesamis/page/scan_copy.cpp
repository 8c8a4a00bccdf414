// SPDX-License-Identifier: Apache-2.0
#include "mesamis/page/scan_copy.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "mesamis/base/error.h"
#include "mesamis/files/deflate.h"

namespace mesamis::detail::page {
namespace {

/// A little more than nearly all samples, and what must be shown.
Window range_of(const VolumeView& scan, const Window& shown) {
  const auto ends = quantiles(scan.samples, {0.001, 0.999});
  const double low = std::min({ends[0], shown.low}), high = std::max({ends[1], shown.high});
  return {low, high > low ? high : low + 1};
}

VoxelGrid thinned_grid(const VolumeView& scan, const std::array<Index, 3>& block) {
  VoxelGrid grid = scan;
  Vec3 shift;
  for (std::size_t a = 0; a < 3; ++a) {
    const int axis = static_cast<int>(a);
    grid.size[a] = (scan.size[a] + block[a] - 1) / block[a];
    grid.spacing[axis] = scan.spacing[axis] * block[a];
    shift[axis] = 0.5 * (block[a] - 1) * scan.spacing[axis];
  }
  grid.origin = scan.to_world(shift);
  return grid;
}

/// Sums over the voxels of a block, which ends with the scan.
struct Block {
  std::array<Index, 3> begin{}, end{};
};

double mean_over(const VolumeView& scan, const Block& block) {
  double sum = 0;
  for (Index k = block.begin[2]; k < block.end[2]; ++k) {
    for (Index j = block.begin[1]; j < block.end[1]; ++j) {
      for (Index i = block.begin[0]; i < block.end[0]; ++i) sum += scan.at(i, j, k);
    }
  }
  std::int64_t count = 1;
  for (std::size_t a = 0; a < 3; ++a) count *= block.end[a] - block.begin[a];
  return sum / static_cast<double>(count);
}

std::string samples_of(const VolumeView& scan, const VoxelGrid& grid,
                       const std::array<Index, 3>& block, const Window& range) {
  std::string samples(grid.voxel_count(), '\0');
  for (std::size_t n = 0; n < samples.size(); ++n) {
    const std::array<Index, 3> voxel = grid.voxel(n);
    Block part;
    for (std::size_t a = 0; a < 3; ++a) {
      part.begin[a] = voxel[a] * block[a];
      part.end[a] = std::min(part.begin[a] + block[a], scan.size[a]);
    }
    const double share = (mean_over(scan, part) - range.low) / (range.high - range.low);
    samples[n] = static_cast<char>(
        static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0))));
  }
  return samples;
}

template <class T>
void put(std::string& header, std::size_t at, T value) {
  static_assert(std::endian::native == std::endian::little);
  std::memcpy(header.data() + at, &value, sizeof value);
}

/// The header of a NIfTI-1 file of 8-bit samples; its frame is RAS.
std::string nifti_header(const VoxelGrid& grid, const Window& range) {
  std::string header(352, '\0');
  put<std::int32_t>(header, 0, 348);
  put<std::int16_t>(header, 40, 3);
  for (std::size_t a = 0; a < 7; ++a) {
    put<std::int16_t>(header, 42 + 2 * a, static_cast<std::int16_t>(a < 3 ? grid.size[a] : 1));
  }
  put<std::int16_t>(header, 70, 2);  // 8-bit samples
  put<std::int16_t>(header, 72, 8);
  put<float>(header, 76, 1);
  for (std::size_t a = 0; a < 3; ++a) {
    put(header, 80 + 4 * a, static_cast<float>(grid.spacing[static_cast<int>(a)]));
  }
  put<float>(header, 108, 352);
  put(header, 112, static_cast<float>((range.high - range.low) / 255));
  put(header, 116, static_cast<float>(range.low));
  header[123] = 2;                    // mm
  put<std::int16_t>(header, 254, 1);  // the rows below are the position of a voxel in the scanner
  for (std::size_t row = 0; row < 3; ++row) {
    const double sign = row < 2 ? -1 : 1;
    const int axis = static_cast<int>(row);
    for (std::size_t column = 0; column < 3; ++column) {
      const int along = static_cast<int>(column);
      const double step = grid.direction.rows[row][along] * grid.spacing[along];
      put(header, 280 + 16 * row + 4 * column, static_cast<float>(sign * step));
    }
    put(header, 280 + 16 * row + 12, static_cast<float>(sign * grid.origin[axis]));
  }
  std::memcpy(header.data() + 344, "n+1", 4);
  return header;
}

/// The axis along which a block is shortest and can still grow; -1: none.
int axis_to_thin(const VolumeView& scan, const std::array<Index, 3>& block) {
  constexpr Index kFewest = 8;
  int best = -1;
  double shortest = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double side = block[a] * scan.spacing[static_cast<int>(a)];
    if (scan.size[a] / (block[a] + 1) < kFewest || (best >= 0 && side >= shortest)) continue;
    best = static_cast<int>(a);
    shortest = side;
  }
  return best;
}

}  // namespace

std::string well_gzipped(const std::string& bytes) {
  constexpr int kSmallest = 9;
  return gzipped("page", bytes, kSmallest);
}

ScanCopy scan_copy(const VolumeView& scan, const Window& shown, std::size_t most) {
  constexpr double kBytesPerVoxel = 0.35;  // packed, at least: smaller blocks are not tried
  const Window range = range_of(scan, shown);
  ScanCopy copy{{}, {1, 1, 1}, range.low, range.high};
  for (;;) {
    const VoxelGrid grid = thinned_grid(scan, copy.block);
    const int axis = axis_to_thin(scan, copy.block);
    const double least = kBytesPerVoxel * static_cast<double>(grid.voxel_count());
    if (axis < 0 || least <= static_cast<double>(most)) {
      copy.nifti_gz =
          well_gzipped(nifti_header(grid, range) + samples_of(scan, grid, copy.block, range));
      if (axis < 0 || copy.nifti_gz.size() <= most) return copy;
    }
    ++copy.block[static_cast<std::size_t>(axis)];
  }
}

}  // namespace mesamis::detail::page
