// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

/// The log that SkyScan's scanners (Bruker) leave beside the slices that they reconstruct.
namespace mesamis::detail::volume_files {

/// What a log says of the slices beside it.
struct SkyscanLog {
  std::filesystem::path file;
  Vec3 spacing;  ///< mm
};

/// Finds the log of a directory of slices: a .log with the section [Reconstruction] and its
/// "Pixel Size (um)"; slices are as far apart as pixels, times "Section to Section Step".
/// @return none where there is no such file, or no usable size in it.
/// @throws InputError  as files_in().
///
/// O(bytes of the logs).
std::optional<SkyscanLog> find_skyscan_log(const std::filesystem::path& directory);

/// Whether a picture is a scout view, by its name: "..._spr".
bool is_scout(const std::filesystem::path& picture);

}  // namespace mesamis::detail::volume_files
