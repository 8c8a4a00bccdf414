// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "mesamis/io/read_volume.h"

namespace mesamis {

/// Reads the scan a command works on, logs its warnings and checks that it can be used.
/// @param series  DICOM: its UID, may be empty.
/// @throws InputError  one line that begins with the path.
VolumeFile read_scan(const std::filesystem::path& path, const std::string& series);

}  // namespace mesamis
