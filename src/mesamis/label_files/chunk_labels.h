// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "mesamis/label_files/read_labels.h"

namespace mesamis::detail {

/// read_label_map() of a Zarr store or an HDF5 file. Of an OME-Zarr image that has labels in it,
/// they are read, not the image.
/// @throws InputError  as open_zarr() and open_hdf5(), for several labels of an image, and for
///                     values that are none.
///
/// O(voxels). Memory: 2 bytes per voxel, and a slice at a time.
LabelFile read_chunk_labels(const std::filesystem::path& path, const ReadLimits& limits);

}  // namespace mesamis::detail
