// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "mesamis/rooms.h"

/// Arrays in a file, one after the other, for this program on machines of one kind: the numbers are
/// as in memory.
namespace mesamis::detail::slabs {

/// Collects arrays; scratch.h writes them.
class ArchiveWriter {
 public:
  template <class Item>
  void add(const std::vector<Item>& items) {
    static_assert(std::is_trivially_copyable_v<Item>);
    add_bytes(items.data(), items.size(), sizeof(Item));
  }
  /// An array of one.
  template <class Item>
  void add_one(const Item& item) {
    static_assert(std::is_trivially_copyable_v<Item>);
    add_bytes(&item, 1, sizeof(Item));
  }
  /// All of them, as they lie in a file; valid until something is added.
  std::string_view bytes() const noexcept { return bytes_; }

 private:
  void add_bytes(const void* items, std::size_t count, std::size_t size_of_one);
  std::string bytes_;
};

/// Hands arrays out in the order in which they were added.
class ArchiveReader {
 public:
  /// @param name  of the file, for messages.
  ArchiveReader(std::string bytes, std::filesystem::path name)
      : bytes_(std::move(bytes)), name_(std::move(name)) {}
  /// @throws InputError  if the file holds no further array of such items.
  template <class Item>
  std::vector<Item> next() {
    static_assert(std::is_trivially_copyable_v<Item>);
    std::vector<Item> items(begin_array(sizeof(Item)));
    if (!items.empty()) std::memcpy(items.data(), bytes_.data() + at_, items.size() * sizeof(Item));
    at_ += items.size() * sizeof(Item);
    return items;
  }
  /// What add_one() added.
  /// @throws InputError  if there is no array of one such item.
  template <class Item>
  Item next_one() {
    const std::vector<Item> items = next<Item>();
    if (items.size() != 1) refuse("expected one item, found " + std::to_string(items.size()));
    return items[0];
  }
  /// Of the file, bytes.
  std::size_t size() const noexcept { return bytes_.size(); }

 private:
  /// Reads the head of an array.
  /// @return how many items follow.
  std::size_t begin_array(std::size_t size_of_one);
  [[noreturn]] void refuse(const std::string& what) const;
  std::string bytes_;
  std::filesystem::path name_;
  std::size_t at_ = 0;
};

}  // namespace mesamis::detail::slabs
