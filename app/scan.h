// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "mesamis/scan_files/read_volume.h"

namespace mesamis {

/// Reads the scan of a command, logs the reader's warnings and checks that the scan can be used.
/// @param series  DICOM: its UID, may be empty.
/// @throws InputError  one line that begins with the path.
VolumeFile read_scan(const std::filesystem::path& path, const std::string& series);

}  // namespace mesamis
