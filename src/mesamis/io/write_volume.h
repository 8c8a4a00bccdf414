// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "mesamis/image/volume.h"

namespace mesamis {

enum class SampleType { kFloat, kShort };

struct NrrdOptions {
  SampleType type = SampleType::kFloat;  ///< short: 16 bits with a sign, samples are rounded
  bool gzip = false;                     ///< smaller, slower
};

/// Writes a .nrrd file (NRRD0004, header and samples in one): space left-posterior-superior,
/// space directions and space origin in mm. The file appears whole or not at all. The volume's
/// modality is not stated: the format has no field for it.
/// @throws InputError  for another extension, samples that are not as many as voxels, samples that
///                     do not fit into 16 bits, or a file that cannot be written.
void write_nrrd(const std::filesystem::path& path, const Volume& volume,
                const NrrdOptions& options = {});

}  // namespace mesamis
