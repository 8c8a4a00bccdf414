// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>

#include "mesamis/rooms.h"

/// Large arrays in files of their own, of numbers or of what is as trivial.
namespace mesamis::detail::slabs {

/// A file as memory: what is read of it is fetched, and dropped again where memory is short.
struct MappedBytes {
  std::span<const std::byte> bytes;
  std::shared_ptr<const void> owner;  ///< keeps it mapped
};

/// As make_item_file() for bytes.
void make_file(const std::filesystem::path& path, std::size_t bytes);
/// As write_items() for bytes.
void write_at(const std::filesystem::path& path, std::size_t first,
              std::span<const std::byte> bytes);
/// As map_items() for bytes.
MappedBytes map_file(const std::filesystem::path& path, std::size_t bytes);

/// Makes a file of so many items, all zero; one that is there already loses what it held.
/// @throws InputError  if there is no room for it.
template <class Item>
void make_item_file(const std::filesystem::path& path, std::size_t count) {
  make_file(path, count * sizeof(Item));
}

/// Writes items into a file of make_item_file().
/// @param first  where, in items.
/// @throws InputError  if they cannot be written.
template <class Item>
void write_items(const std::filesystem::path& path, std::size_t first,
                 std::span<const Item> items) {
  static_assert(std::is_trivially_copyable_v<Item>);
  write_at(path, first * sizeof(Item), std::as_bytes(items));
}

/// As MappedBytes, for items.
template <class Item>
struct MappedItems {
  std::span<const Item> values;
  std::shared_ptr<const void> owner;  ///< keeps them mapped
};

/// Maps a file of make_item_file().
/// @param count  items that it holds, at least one.
/// @throws InputError  if there is none, or another number of items in it.
template <class Item>
MappedItems<Item> map_items(const std::filesystem::path& path, std::size_t count) {
  static_assert(std::is_trivially_copyable_v<Item>);
  MappedBytes mapped = map_file(path, count * sizeof(Item));
  return {{reinterpret_cast<const Item*>(mapped.bytes.data()), count}, std::move(mapped.owner)};
}

}  // namespace mesamis::detail::slabs
