// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/image/volume.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::volume_files {

/// What the samples behind a NRRD header are, and the user's own lines.
struct NrrdContent {
  std::string type;   ///< "float", "int16", "uint8", "uint16"; this machine's byte order
  bool gzip = false;  ///< one gzip stream
  Index values = 1;   ///< per voxel; above 1 they are a list axis that comes first
  std::vector<std::pair<std::string, std::string>> keys{};  ///< "key:=value"; line ends are escaped
};

/// The header of a NRRD0004 file, the empty line at its end included: the samples follow.
///
/// Space is left-posterior-superior; space directions and space origin are in mm, in decimals that
/// read back to the same bits, whatever the locale.
std::string nrrd_header(const VoxelGrid& grid, const NrrdContent& content);

}  // namespace mesamis::detail::volume_files
