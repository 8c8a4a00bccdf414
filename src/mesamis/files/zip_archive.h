// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesamis/files/memory_budget.h"

namespace mesamis::detail::files {

/// The parts of a ZIP archive in memory: stored or deflated, not encrypted; ZIP64 too.
class ZipArchive {
 public:
  /// Reads the directory at the end of the archive.
  /// @param file    for messages.
  /// @param bytes   the whole archive; must live on.
  /// @param budget  of the reader; must live on.
  /// @throws InputError  if it is no such archive, its directory is cut off or has more than 10 000
  ///                     parts.
  ZipArchive(std::filesystem::path file, std::string_view bytes, MemoryBudget& budget);

  /// The names of all parts in the order of the directory, in lower case. O(parts).
  /// @throws nothing
  std::vector<std::string> names() const;

  /// Unpacks a part. What the directory claims of its size is compared with what its bytes can
  /// hold, and claimed, before anything is unpacked; it stays claimed.
  /// @param name  as in the directory, without regard to case.
  /// @return      its bytes; nothing if there is no such part.
  /// @throws InputError  if the part is cut off, broken, packed in another way or not of the size
  ///                     and the checksum that the directory states; as MemoryBudget::claim().
  ///
  /// Linear in the bytes.
  std::optional<std::string> part(std::string_view name);

 private:
  struct Part {
    std::string name;  ///< in lower case
    std::uint64_t flags = 0, method = 0, checksum = 0, stored_size = 0, plain_size = 0, begin = 0;
  };
  /// The records of all parts, one after another.
  struct Directory {
    std::uint64_t begin = 0, count = 0;
  };
  Directory find_directory() const;
  Part part_at(std::uint64_t at) const;
  std::uint64_t number(std::uint64_t at, std::size_t size) const;
  std::string_view stored(const Part& part) const;
  std::string inflated(const Part& part, std::string_view stored) const;

  std::filesystem::path file_;
  std::string_view bytes_;
  MemoryBudget& budget_;
  std::vector<Part> parts_;
};

}  // namespace mesamis::detail::files
