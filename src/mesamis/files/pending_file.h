// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "mesamis/rooms.h"

namespace mesamis::detail::files {

/// A new file beside the one that it will replace. At its end one of them is left: the new file if
/// replace() was called.
class PendingFile {
 public:
  /// Creates the empty new file. Removes what killed processes have left in the folder.
  /// @param target  as the target of an AtomicFile.
  /// @throws InputError  as AtomicFile.
  explicit PendingFile(std::filesystem::path target);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  const std::filesystem::path& target() const noexcept { return target_; }
  const std::filesystem::path& temporary() const noexcept { return temporary_; }
  /// @return  the folder of both files.
  std::filesystem::path folder() const { return temporary_.parent_path(); }
  /// Brings the bytes to the disk, and gives them the mode of the file that they replace.
  /// @throws InputError  if they do not get there.
  void harden();
  /// Renames the new file. Call harden() before and flush_folder() after it. The old file, if there
  /// is one, is kept aside until the end of this object, where the file system can exchange two.
  /// @throws InputError  if it cannot be renamed; the target is then as it was.
  void replace();
  /// Takes replace() back, as far as the old file was kept; as when it was not called.
  void put_back() noexcept;

 private:
  void create();
  std::filesystem::path target_;             ///< as the caller has it
  std::filesystem::path place_, temporary_;  ///< absolute, without links at its end
  int slot_, descriptor_ = -1;
  enum class Old { kInPlace, kNone, kAside, kGone } old_ = Old::kInPlace;  ///< of the target
};

/// Brings the names in a folder to the disk.
/// @throws InputError  if they do not get there.
void flush_folder(const std::filesystem::path& folder);

/// @return  the file that a path means: absolute, links at its end followed, there or not.
/// @throws InputError  if they lead in a circle, or cannot be read.
std::filesystem::path without_links(const std::filesystem::path& path);

/// Removes the new files of all PendingFile objects; see remove_unfinished_files().
void remove_pending_files() noexcept;

}  // namespace mesamis::detail::files
