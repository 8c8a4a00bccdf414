// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "mesamis/image/grey_values.h"
#include "mesamis/image/volume.h"

namespace mesamis::detail::page {

/// A scan as the viewer takes it.
struct ScanCopy {
  std::string nifti_gz;          ///< a gzipped NIfTI-1 file of 8-bit samples; no words in it
  std::array<Index, 3> block{};  ///< voxels of the scan along each side of one of the copy
  double low = 0, high = 0;      ///< native values of the samples 0 and 255; beyond is cut off
};

/// Makes a small copy of a scan: means over blocks of voxels, as large as needed, in 256 steps.
/// @param scan   usable, see require_usable().
/// @param shown  native values that the steps cover at least; else nearly all samples.
/// @param most   bytes of the copy, as a goal: a copy of 8 voxels along an axis is not made
/// smaller.
/// @throws InputError  if zlib cannot be started.
ScanCopy scan_copy(const VolumeView& scan, const Window& shown, std::size_t most);

/// Bytes as one gzip stream, well compressed; the same bytes every time.
/// @throws InputError  if zlib cannot be started.
std::string well_gzipped(const std::string& bytes);

}  // namespace mesamis::detail::page
