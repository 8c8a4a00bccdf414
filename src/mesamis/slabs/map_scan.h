// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "mesamis/image/slice_source.h"
#include "mesamis/image/volume.h"

namespace mesamis::detail::slabs {

/// A scan whose samples lie on a disk: what is looked at is fetched into the memory, and dropped
/// again where memory is short.
struct MappedScan {
  VolumeView volume;                  ///< native units
  std::shared_ptr<const void> owner;  ///< keeps the samples where they are; goes last
};

/// Copies a scan, some slices at a time, to where functions that need all of it can look at any
/// voxel: for scans that are larger than the memory.
/// @param folder  must exist; the samples lie there in a file that goes with the scan; of a program
///                that is killed meanwhile it stays. Four bytes per voxel.
/// @throws InputError  as SliceSource::read(), or if there is no room.
///
/// O(voxels); memory of the slices that are read at once, see slab_slices().
MappedScan map_scan(const SliceSource& source, const std::filesystem::path& folder);

}  // namespace mesamis::detail::slabs
