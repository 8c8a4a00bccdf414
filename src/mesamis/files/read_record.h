// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "mesamis/files/reading.h"
#include "mesamis/rooms.h"

/// Which files a reader has opened, and in which state, so that a sum over them can be known to be
/// that of the bytes that were read.
namespace mesamis::detail::files {

/// @throws InputError  if there is no such file, or none that may be asked.
FileState state_of(const std::filesystem::path& file);

/// Notes each file that is opened for reading on this thread while this lives. Of records within
/// one another the innermost counts.
class ReadRecord {
 public:
  /// Begins an empty record.
  ReadRecord();
  ~ReadRecord();
  ReadRecord(const ReadRecord&) = delete;
  ReadRecord& operator=(const ReadRecord&) = delete;

  /// Every file once, in the order of their paths. O(n log n).
  /// @throws InputError  naming a file that was opened more than once in different states.
  std::vector<ReadFile> files() const;

 private:
  friend void note_read(const std::filesystem::path&, const FileState&);

  ReadRecord* outer_;
  std::vector<ReadFile> files_;
};

/// For readers: notes a file that was opened, where somebody asks.
/// @param before  its state before it was opened.
/// @throws InputError  if it has changed since.
void note_read(const std::filesystem::path& file, const FileState& before);

/// @throws InputError  if the file is not in the state any more in which it was opened.
void require_unchanged(const ReadFile& file);

}  // namespace mesamis::detail::files
