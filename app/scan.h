// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "mesamis/volume_files/open_slices.h"
#include "mesamis/volume_files/read_volume.h"

namespace CLI {
class App;
}  // namespace CLI

namespace mesamis {

/// The values of --modality.
inline const std::vector<std::string> kModalities{"CT", "MR", "other"};

/// Adds --modality alone. `options` must outlive the parsing.
void add_modality_option(CLI::App& command, ReadOptions& options);

/// Adds the options of every command that reads a scan: --series, --raw, --spacing, --resample,
/// --volume, --channel, --modality. `options` must outlive the parsing.
void add_read_options(CLI::App& command, ReadOptions& options);

/// Refuses options that say how a scan is read for what is none.
/// @throws InputError  one line that begins with the path.
void require_no_read_options(const std::filesystem::path& path, const ReadOptions& options);

/// Reads a volume as read_volume() does, and scans in chunks too: Zarr and HDF5, whole.
/// @throws InputError  one line that begins with the path.
VolumeFile read_any_volume(const std::filesystem::path& path, const ReadOptions& options);

/// As open_slices(), of any of these.
std::unique_ptr<FileSlices> open_any_slices(const std::filesystem::path& path,
                                            const ReadOptions& options);

/// As read_grid(), of any of these.
VoxelGrid read_any_grid(const std::filesystem::path& path, const ReadOptions& options);

/// As list_volumes(), of any of these.
std::vector<VolumeInfo> list_any_volumes(const std::filesystem::path& path,
                                         const ReadOptions& options);

/// Reads the scan of a command, logs the reader's warnings and checks that the scan can be used.
/// @throws InputError  one line that begins with the path.
VolumeFile read_scan(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace mesamis
