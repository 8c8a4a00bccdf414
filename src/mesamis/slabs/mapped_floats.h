// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>

namespace mesamis::detail {

/// Makes a file of so many floats, all zero; one that is there already loses what it held.
/// @throws InputError  if there is no room for it.
void make_float_file(const std::filesystem::path& path, std::size_t count);

/// Writes floats into a file of make_float_file().
/// @param first  where, in floats.
/// @throws InputError  if they cannot be written.
void write_floats(const std::filesystem::path& path, std::size_t first,
                  std::span<const float> values);

/// A file of floats as memory: what is read of it is fetched, and dropped again where memory is
/// short.
struct MappedFloats {
  std::span<const float> values;
  std::shared_ptr<const void> owner;  ///< keeps it mapped
};

/// Maps a file of make_float_file().
/// @param count  floats that it holds.
/// @throws InputError  if there is none, or another number of floats in it.
MappedFloats map_floats(const std::filesystem::path& path, std::size_t count);

}  // namespace mesamis::detail
