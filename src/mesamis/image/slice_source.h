// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::image {

/// A scan that is read a few slices at a time: one that is too large for the memory.
class SliceSource {
 public:
  virtual ~SliceSource() = default;

  /// Where the voxels lie, and how many they are.
  virtual const VoxelGrid& grid() const = 0;

  /// Reads slices of constant k. Several threads may call it at the same time.
  /// @param first  0 to the grid's number of slices less count.
  /// @param count  at least 1.
  /// @return one sample per voxel of these slices in native units; i runs fastest, then j, k.
  ///         The same bits for the same slices, whatever else was read before.
  /// @throws InputError  one line that begins with the path: what, where, expected, found.
  ///
  /// O(voxels of the slices), in time and in memory, for formats that keep them together.
  virtual std::vector<float> read(Index first, Index count) const = 0;
};

/// Slices of constant k that follow one another.
struct SliceRange {
  Index first = 0, count = 0;
};

/// Some slices of a source as a volume: the grid is that of these slices.
/// @param first, count  as for SliceSource::read().
/// @throws InputError  as SliceSource::read().
Volume read_slab(const SliceSource& source, Index first, Index count);

/// How many slices are worth reading at once: about 2^26 voxels, but no fewer than are read beside
/// them, so that these at most double the work.
/// @param around  slices that are read beside those that are wanted, both ends together, >= 0.
/// @return at least 1, at most those of the grid.
Index slab_slices(const VoxelGrid& grid, Index around = 0);

/// A volume in memory as a source.
class VolumeSlices : public SliceSource {
 public:
  /// @param volume  must live, unchanged, as long as this object.
  explicit VolumeSlices(const VolumeView& volume) : volume_(volume) {}
  const VoxelGrid& grid() const override { return volume_; }
  std::vector<float> read(Index first, Index count) const override;

 private:
  VolumeView volume_;
};

}  // namespace mesamis::detail::image
