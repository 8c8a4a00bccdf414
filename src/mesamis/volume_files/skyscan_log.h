// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/base/types.h"
#include "mesamis/rooms.h"

/// The log that SkyScan's scanners (Bruker) leave beside the slices that they reconstruct.
namespace mesamis::detail::volume_files {

/// What a log says of the pictures beside it.
struct SkyscanLog {
  std::filesystem::path file;
  Vec3 spacing;                        ///< mm
  bool reconstructed = true;           ///< false: it tells of projections alone
  std::array<std::int64_t, 2> size{};  ///< pixels of the pictures that it tells of; 0: not stated
  std::vector<std::string> warnings{};
};

/// Finds the log of a directory of slices.
///
/// A .log with the section [Reconstruction] and its "Pixel Size (um)", or another length called
/// "Pixel Size" or "Image Pixel Size", in (um), (mm) or the unit behind the number; slices are as
/// far apart as pixels, times "Section to Section Step". Of several logs that whose name begins the
/// picture's name, else the first. Without such a log, one of projections: its "Image Pixel Size".
/// @param picture  name of the first slice.
/// @return none where there is no such file, or no usable size in it.
/// @throws InputError  as files_in().
///
/// O(bytes of the logs).
std::optional<SkyscanLog> find_skyscan_log(const std::filesystem::path& directory,
                                           std::string_view picture = {});

/// Whether a picture is a scout view, by its name: "..._spr".
bool is_scout(const std::filesystem::path& picture);

}  // namespace mesamis::detail::volume_files
