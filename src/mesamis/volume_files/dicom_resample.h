// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesamis/image/volume.h"
#include "mesamis/volume_files/dicom_spacing.h"

/// Stacks that are no regular grid, brought onto one: a tilted gantry, uneven or missing slices.
namespace mesamis::detail::volume_files {

/// A regular grid for a stack, and where the slices lie in it.
struct ResamplePlan {
  VoxelGrid grid;             ///< columns and rows as the slices; third axis along their normal
  std::vector<double> plane;  ///< per slice: its place along the third axis, voxels, ascending
  std::vector<std::array<double, 2>> shift;  ///< per slice: of its first pixel, pixels, >= 0
  bool tilted = false, uneven = false;       ///< else the slices are the grid's own
  std::vector<std::string> notes;            ///< what was done, and what it costs, in words

  bool needed() const noexcept { return tilted || uneven; }
};

/// Plans the grid of a stack.
///
/// Pixels keep their size; a tilted stack gets as many more as its slices are shifted. The planes
/// are as far apart as the nearest two slices, or a quarter of the median distance if that is more;
/// the first and the last slice lie on planes. A stack that is a regular grid keeps its own.
/// @param path  begins the message.
/// @throws InputError  if two slices lie at one place, or the grid has more than 64 voxels per
///                     sample of the slices.
ResamplePlan plan_resampling(const std::filesystem::path& path, const SortedSlices& sorted);

/// Interpolates the samples of a stack onto its grid, linearly within a slice and between slices.
/// What one of both slices does not cover gets the least sample of all.
/// @param columns, rows  of each slice.
/// @param samples        slice by slice, native units.
/// @return one per voxel of plan.grid.
///
/// O(voxels of the grid), in threads; the same bits for any number of them.
std::vector<float> resampled(const ResamplePlan& plan, const std::array<int, 2>& columns_rows,
                             const std::vector<float>& samples);

}  // namespace mesamis::detail::volume_files
