// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

#include "mesamis/scan_files/read_volume.h"

namespace mesamis {

/// Adds the options of every command that reads a scan: --series, --raw, --spacing,
/// --resample. `options` must
/// outlive the parsing.
void add_read_options(CLI::App& command, ReadOptions& options);

/// Reads the scan of a command, logs the reader's warnings and checks that the scan can be used.
/// @throws InputError  one line that begins with the path.
VolumeFile read_scan(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace mesamis
