// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "mesamis/files/output_path.h"
#include "mesamis/rooms.h"

namespace mesamis::detail::files {

class PendingFile;

/// A file that appears whole or not at all. The caller writes to temporary_path(); commit() renames
/// that file to the target. Without commit(), the destructor or remove_unfinished_files() removes
/// it. What a killed process leaves is removed by the next AtomicFile in the folder.
///
/// A target that is a link stays one: the file that it leads to is replaced. A file that is
/// replaced hands on its mode.
class AtomicFile {
 public:
  /// Creates the empty temporary file.
  ///
  /// @param target  name of a file that exists or not, in a directory that exists. The temporary
  ///                file lies in the same directory, under a name of its own.
  /// @throws InputError  if the directory does not exist or cannot be written to, if the name is
  ///                     too long, or if the target exists and is not a regular file.
  explicit AtomicFile(const OutputPath& target);
  /// Removes the temporary file, unless it was committed.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// @return  the absolute path of the temporary file.
  const std::filesystem::path& temporary_path() const noexcept { return temporary_; }
  /// Brings the temporary file to the disk and renames it to the target, replacing it; the set of a
  /// target that has one does so later. Call it once, when the file is closed and everything is
  /// known to be written.
  /// @throws InputError  if a byte does not reach the disk or the file cannot be renamed; the
  ///                     target is then as it was.
  void commit();

 private:
  std::unique_ptr<PendingFile> file_;  ///< none once it is committed
  std::filesystem::path temporary_;
  OutputSet* set_;
};

/// Writes a whole file at once, through an AtomicFile.
///
/// @param path   as the target of an AtomicFile.
/// @param bytes  the whole content.
/// @throws InputError  if the file cannot be written; it is then as it was.
void write_file(const OutputPath& path, std::string_view bytes);

/// Removes the temporary files that are not renamed, of all AtomicFile objects of the process. A
/// signal handler may call it: it allocates nothing, takes no lock and keeps errno. It reaches at
/// most 1024 files at a time; further ones are removed by their destructors only.
void remove_unfinished_files() noexcept;

}  // namespace mesamis::detail::files
