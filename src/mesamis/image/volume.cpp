// SPDX-License-Identifier: Apache-2.0
#include "mesamis/image/volume.h"

#include <cmath>

#include "mesamis/base/error.h"
#include "mesamis/base/message.h"

namespace mesamis {
namespace {

constexpr double kDirectionTolerance = 1e-6;

void require_two_voxels(const std::array<Index, 3>& n) {
  if (std::min({n[0], n[1], n[2]}) >= 2) return;
  throw InputError(message("volume: expected at least 2 voxels in each direction, found ", n[0],
                           " x ", n[1], " x ", n[2]));
}

void require_sizes(const VolumeView& volume) {
  const auto& n = volume.size;
  require_two_voxels(n);
  if (volume.samples.size() != volume.voxel_count()) {
    throw InputError(message("volume: expected ", volume.voxel_count(), " samples for ", n[0],
                             " x ", n[1], " x ", n[2], " voxels, found ", volume.samples.size()));
  }
}

void require_grid(const VoxelGrid& volume) {
  for (int a = 0; a < 3; ++a) {
    if (!(volume.spacing[a] > 0) || !std::isfinite(volume.spacing[a])) {
      throw InputError(message("volume: expected a positive spacing along axis ", a, ", found ",
                               volume.spacing[a], " mm"));
    }
    if (!std::isfinite(volume.origin[a])) {
      throw InputError(
          message("volume: expected a finite origin, found ", volume.origin[a], " along axis ", a));
    }
  }
  const auto& rows = volume.direction.rows;
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = a; b < 3; ++b) {
      const double deviation = std::abs(dot(rows[a], rows[b]) - (a == b ? 1 : 0));
      if (!(deviation <= kDirectionTolerance)) {
        throw InputError(message("volume: expected an orthonormal direction to ",
                                 kDirectionTolerance, ", found a deviation of ", deviation));
      }
    }
  }
}

void require_samples(const VolumeView& volume) {
  const std::span<const float> f = volume.samples;
  const auto unknown = std::find_if(f.begin(), f.end(), [](float x) { return !std::isfinite(x); });
  if (unknown != f.end()) {
    const auto [i, j, k] = volume.voxel(static_cast<std::size_t>(unknown - f.begin()));
    throw InputError(message("volume: expected finite samples, found ", *unknown, " at voxel ", i,
                             " ", j, " ", k));
  }
  if (std::all_of(f.begin(), f.end(), [&f](float x) { return x == f[0]; })) {
    throw InputError(message("volume: expected samples that differ, found ", f[0], " everywhere"));
  }
}

/// What a copy keeps: `count` voxels per direction, the first at `begin`, `stride` apart.
struct Selection {
  std::array<Index, 3> begin, count, stride;
};

/// @param values  one per voxel.
template <class Value>
std::vector<Value> select(std::span<const Value> values, const VoxelGrid& grid,
                          const Selection& kept) {
  const auto& [begin, count, stride] = kept;
  std::vector<Value> out;
  out.reserve(VoxelGrid{.size = count}.voxel_count());
  for (Index k = 0; k < count[2]; ++k) {
    for (Index j = 0; j < count[1]; ++j) {
      const Value* line =
          values.data() + grid.offset(begin[0], begin[1] + j * stride[1], begin[2] + k * stride[2]);
      for (Index i = 0; i < count[0]; ++i) {
        out.push_back(line[static_cast<std::ptrdiff_t>(i) * stride[0]]);
      }
    }
  }
  return out;
}

Volume select(const VolumeView& volume, const Selection& kept) {
  Volume out;
  out.size = kept.count;
  out.direction = volume.direction;
  out.modality = volume.modality;
  out.frame_of_reference = volume.frame_of_reference;
  Vec3 corner;
  for (int a = 0; a < 3; ++a) {
    const auto s = static_cast<std::size_t>(a);
    corner[a] = kept.begin[s] * volume.spacing[a];
    out.spacing[a] = volume.spacing[a] * kept.stride[s];
  }
  out.origin = volume.to_world(corner);
  out.samples = select(volume.samples, volume, kept);
  return out;
}

}  // namespace

Volume copy_volume(const VolumeView& volume) {
  return {volume, {volume.samples.begin(), volume.samples.end()}};
}

void require_usable(const VolumeView& volume) {
  require_sizes(volume);
  require_grid(volume);
  require_samples(volume);
}

std::array<Index, 3> cropped_size(const VoxelGrid& volume, const CropRange& range) {
  require_two_voxels(volume.size);
  std::array<Index, 3> size{};
  for (std::size_t a = 0; a < 3; ++a) {
    const Index n = volume.size[a];
    const Index end = range.end[a] == -1 ? n : range.end[a];
    if (range.begin[a] < 0 || range.begin[a] > n || end < 0 || end > n) {
      throw InputError(message("crop: expected a range within 0:", n, " along axis ", a, ", found ",
                               range.begin[a], ":", end));
    }
    if (end - range.begin[a] < 2) {
      throw InputError(message("crop: expected at least 2 voxels along axis ", a, ", found ",
                               range.begin[a], ":", end));
    }
    size[a] = end - range.begin[a];
  }
  return size;
}

Volume crop(const VolumeView& volume, const CropRange& range) {
  return select(volume, {range.begin, cropped_size(volume, range), {1, 1, 1}});
}

std::vector<std::uint8_t> crop(std::span<const std::uint8_t> marks, const VoxelGrid& grid,
                               const CropRange& range) {
  return select(marks, grid, {range.begin, cropped_size(grid, range), {1, 1, 1}});
}

Volume subsample(const VolumeView& volume, const std::array<Index, 3>& stride) {
  Selection kept{{0, 0, 0}, {}, stride};
  for (std::size_t a = 0; a < 3; ++a) {
    if (stride[a] < 1) {
      throw InputError(message("subsample: expected a stride of at least 1 along axis ", a,
                               ", found ", stride[a]));
    }
    kept.count[a] = (volume.size[a] - 1) / stride[a] + 1;
    if (kept.count[a] < 2) {
      throw InputError(message("subsample: expected at least 2 voxels to remain along axis ", a,
                               ", found ", kept.count[a], " (stride ", stride[a], " on ",
                               volume.size[a], ")"));
    }
  }
  return select(volume, kept);
}

}  // namespace mesamis
