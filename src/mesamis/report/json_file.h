// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "mesamis/base/types.h"
#include "mesamis/files/output_path.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::report {

/// Writes an indented JSON file, which appears whole or not at all. Numbers that are not finite
/// become null, text that is not UTF-8 is repaired.
/// @throws InputError  if the file cannot be written.
void write_json(const OutputPath& path, const nlohmann::ordered_json& value);

/// Reads a JSON file.
/// @throws InputError  if the file cannot be read, is not JSON, nests more than 64 lists and
///                     objects or has an object with a key twice; the message says where or which.
nlohmann::json read_json(const std::filesystem::path& path);

/// A point or vector as [x, y, z], in mm or whatever unit it has.
nlohmann::ordered_json vec_json(const Vec3& v);

}  // namespace mesamis::detail::report
