// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesamis/image/label_map.h"
#include "segment_run.h"

/// What `segment` refuses of its options before any work.
namespace mesamis {

/// Checks what needs no scan: names of files, and what does not go together.
/// @throws CLI::ValidationError, InputError  as require_output().
void require_segment(const SegmentOptions& options, const Settings& settings);

/// Checks what belongs to several objects: places for errors, a scan for meshes.
/// @throws CLI::ValidationError
void require_several(const SegmentOptions& options);

/// Checks that the files of several objects, whose names are known with them, can be written.
/// @param wanted  the objects that are looked for.
/// @throws CLI::ValidationError, InputError  as require_writable(), or for a format that does not
///                                           hold them.
void require_object_files(const SegmentOptions& options, const std::vector<Segment>& wanted);

/// Checks the name of a label map before any work.
/// @throws CLI::ValidationError, InputError  as require_output().
void require_labelmap(const std::filesystem::path& path, const std::string& option);

}  // namespace mesamis
