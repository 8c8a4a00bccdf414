// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "mesamis/files/output_path.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::files {

class PendingFile;

/// Files that appear together, when all of them are whole on the disk, or none of them.
///
/// A writer whose path is a file() of the set hands its file to the set instead of renaming it.
/// commit() renames them all, in the order in which they came; the destructor removes those that it
/// has not renamed. What is to be read again before the end, like the input of another program, is
/// written without a set.
class OutputSet {
 public:
  /// A file that is whole but not in its place yet.
  struct Member {
    std::filesystem::path target, temporary;
  };

  /// Begins an empty set.
  /// @param outer  optional: commit() hands the files to this set, which lives longer.
  explicit OutputSet(OutputSet* outer = nullptr);
  /// Removes the files that are not renamed.
  ~OutputSet();
  OutputSet(const OutputSet&) = delete;
  OutputSet& operator=(const OutputSet&) = delete;

  /// Where a writer puts a file of this set.
  OutputPath file(std::filesystem::path path) { return {std::move(path), this}; }
  /// Tells which files wait in this set, in the order in which they came.
  std::vector<Member> members() const;
  /// Renames all files, and brings the names to the disk.
  /// @throws InputError  if one cannot be renamed; all are then as they were. On file systems that
  ///                     cannot exchange two files, files that were replaced before it are new.
  ///
  /// Only renames lie between the first new file and the last: microseconds on a local disk.
  void commit();

 private:
  friend class AtomicFile;
  void add(std::unique_ptr<PendingFile> file);
  void replace_all();

  OutputSet* outer_;
  std::vector<std::unique_ptr<PendingFile>> files_;
};

/// Refuses a file that could not be written at the end of long work, by the same rules as
/// AtomicFile. Leaves nothing behind.
/// @throws InputError  as AtomicFile.
void require_writable(const std::filesystem::path& target);

/// Refuses files that would be written over each other or over an input. Two paths are one file
/// also by way of links and of ".." in a path.
/// @param outputs, inputs  files and folders that exist or not; empty paths are left out.
/// @throws InputError  naming the file.
///
/// O(n log n + n m) for n outputs and m inputs.
void require_distinct(std::span<const std::filesystem::path> outputs,
                      std::span<const std::filesystem::path> inputs);

}  // namespace mesamis::detail::files
