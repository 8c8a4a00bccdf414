// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "mesamis/files/output_path.h"
#include "mesamis/image/slice_source.h"
#include "mesamis/image/volume.h"

namespace mesamis::detail::volume_files {

enum class SampleType {
  kFloat,  ///< 32-bit floating point
  kShort,  ///< 16-bit integers with a sign; samples are rounded
};

struct NrrdOptions {
  SampleType type = SampleType::kFloat;
  bool gzip = false;  ///< compressed by zlib, fastest level
  Index slab = 0;     ///< slices of a source that are read at once, no change of the bytes; 0: some
};

/// Writes a volume as .nrrd (NRRD0004, header and samples in one file).
///
/// Space is left-posterior-superior; space directions and space origin are in mm. The volume's
/// modality is not stated: the format has no field for it. The file appears whole or not at all.
/// The same volume gives the same bytes, whatever the locale.
/// @param path     ends with .nrrd.
/// @param volume   one sample per voxel, native units; spacing and origin in mm, LPS.
/// @throws InputError  for another extension, samples that are not as many as voxels, samples that
///                     do not fit into 16 bits, or a file that cannot be written.
///
/// Memory: a slab's samples, see slab_slices().
void write_nrrd(const OutputPath& path, const Volume& volume, const NrrdOptions& options = {});

/// Writes a volume that need not fit into the memory, a few slices at a time: the bytes of the
/// function above.
/// @param source  samples in native units.
/// @throws InputError  as the function above, and as source.read().
///
/// Memory: a slab's samples.
void write_nrrd(const OutputPath& path, const SliceSource& source, const NrrdOptions& options = {});

}  // namespace mesamis::detail::volume_files
