// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

/// The matrix that SPM stores in a MATLAB file beside an image.
namespace mesamis::detail::volume_files {

/// Where the voxels lie: RAS, mm.
struct SpmMatrix {
  std::array<Vec3, 3> steps{};  ///< from a voxel to the next along i, j, k
  Vec3 origin{};                ///< of the first voxel
  std::int64_t count = 1;       ///< matrices in the file, one per volume
};

/// Reads the variable `mat`, else `M`, of a MATLAB file of level 4 or 5, compressed or not: 4 x 4
/// or 4 x 4 x N, for voxels that are counted from 1. `M` lacks the exchange of sides that SPM
/// applies to Analyze, so that its first row is negated.
/// @param volume  from 0: which of several matrices; the first if there are not so many.
/// @return none if there is no such file, or an empty one.
/// @throws InputError  if it is none of these files, has neither variable, or this one is no real,
///                     finite affine matrix.
///
/// O(variables) and the bytes of compressed ones; constant memory.
std::optional<SpmMatrix> read_spm_matrix(const std::filesystem::path& file, std::int64_t volume);

}  // namespace mesamis::detail::volume_files
