// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "mesamis/files/reading.h"
#include "mesamis/rooms.h"

/// The one account of the memory that a file may claim. Each reader asks it before it takes memory
/// whose amount a file decides.
namespace mesamis::detail::files {

class MemoryBudget {
 public:
  /// @param file    for messages: the file or folder that is read.
  /// @param limits  where they name no limit, what is free now counts; no limit where the system
  ///                does not tell.
  MemoryBudget(std::filesystem::path file, const ReadLimits& limits);
  MemoryBudget(const MemoryBudget&) = delete;
  MemoryBudget& operator=(const MemoryBudget&) = delete;

  /// Asks for memory before it is taken. Products and sums are checked in 64 bits.
  /// @param count  of the things, each of so many bytes.
  /// @param what   the things, for the message: "triangles".
  /// @throws InputError  if it is more than what is left: one line that names the file, what was
  ///                     claimed and what is allowed.
  void claim(std::uint64_t count, std::uint64_t bytes_each, std::string_view what);
  /// Gives back what was claimed and is free again.
  void give_back(std::uint64_t bytes) noexcept { held_ -= std::min(bytes, held_); }

  /// Messages name this file from now on.
  /// @return the file that they named before.
  std::filesystem::path rename(std::filesystem::path file) {
    return std::exchange(file_, std::move(file));
  }

  std::uint64_t held() const noexcept { return held_; }    ///< bytes
  std::uint64_t limit() const noexcept { return limit_; }  ///< bytes
  std::uint64_t left() const noexcept { return limit_ - held_; }

 private:
  std::filesystem::path file_;
  std::uint64_t limit_ = 0, held_ = 0;
};

/// Memory that is free again at the end of a scope.
class ScopedClaim {
 public:
  /// @throws InputError  as MemoryBudget::claim().
  ScopedClaim(MemoryBudget& budget, std::uint64_t count, std::uint64_t bytes_each,
              std::string_view what)
      : budget_(budget), bytes_(count * bytes_each) {
    budget.claim(count, bytes_each, what);
  }
  ~ScopedClaim() { budget_.give_back(bytes_); }
  ScopedClaim(const ScopedClaim&) = delete;
  ScopedClaim& operator=(const ScopedClaim&) = delete;

 private:
  MemoryBudget& budget_;
  std::uint64_t bytes_;
};

/// One file of several that are read: messages name it while this lives, and what was claimed for
/// it is given back at the end.
class ScopedFile {
 public:
  ScopedFile(MemoryBudget& budget, const std::filesystem::path& file)
      : budget_(budget), before_(budget.rename(file)), held_(budget.held()) {}
  ~ScopedFile() {
    budget_.rename(std::move(before_));
    budget_.give_back(budget_.held() - std::min(held_, budget_.held()));
  }
  ScopedFile(const ScopedFile&) = delete;
  ScopedFile& operator=(const ScopedFile&) = delete;

 private:
  MemoryBudget& budget_;
  std::filesystem::path before_;
  std::uint64_t held_;
};

/// Makes room in a vector or a string, claimed before it is taken. While it grows, its old and its
/// new bytes are held.
/// @param size  elements at least.
/// @throws InputError  as MemoryBudget::claim().
template <class Array>
void reserve_within(MemoryBudget& budget, Array& array, std::size_t size, std::string_view what) {
  const std::size_t before = array.capacity();
  if (size <= before) return;
  budget.claim(size, sizeof(typename Array::value_type), what);
  array.reserve(size);
  budget.give_back(before * sizeof(typename Array::value_type));
}

/// Appends an element; the room doubles where there is none.
/// @throws InputError  as MemoryBudget::claim().
template <class Element>
void append_within(MemoryBudget& budget, std::vector<Element>& array, Element element,
                   std::string_view what) {
  constexpr std::size_t kFirst = 16;
  if (array.size() == array.capacity()) {
    reserve_within(budget, array, std::max(kFirst, 2 * array.size()), what);
  }
  array.push_back(std::move(element));
}

/// Empties a vector whose room was claimed, and gives the room back.
template <class Element>
void free_within(MemoryBudget& budget, std::vector<Element>& array) noexcept {
  budget.give_back(array.capacity() * sizeof(Element));
  array = {};
}

}  // namespace mesamis::detail::files
