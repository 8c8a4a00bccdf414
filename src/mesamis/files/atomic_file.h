// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

namespace mesamis {

/// A file that appears whole or not at all. The caller writes to temporary_path(); commit() renames
/// that file to the target. Without commit(), the destructor or remove_unfinished_files() removes
/// it.
class AtomicFile {
 public:
  /// Creates the empty temporary file.
  ///
  /// @param target  name of a file that exists or not, in a directory that exists. The temporary
  /// file
  ///                lies in the same directory and has the same extension.
  /// @throws InputError  if the directory does not exist or cannot be written to, or if the target
  ///                     exists and is not a regular file.
  explicit AtomicFile(std::filesystem::path target);
  /// Removes the temporary file, unless it was committed.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// @return  the absolute path of the temporary file.
  const std::filesystem::path& temporary_path() const noexcept { return temporary_; }
  /// Renames the temporary file to the target, replacing it. The caller has closed the file and
  /// checked that everything was written.
  /// @throws InputError  if the file cannot be renamed; the target is then as it was.
  void commit();

 private:
  std::filesystem::path target_, temporary_;
  int slot_;
  bool committed_ = false;
};

/// Writes a whole file at once, through an AtomicFile.
///
/// @param path   as the target of an AtomicFile.
/// @param bytes  the whole content.
/// @throws InputError  if the file cannot be written; it is then as it was.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Removes the temporary files that are not committed, of all AtomicFile objects of the process. A
/// signal handler may call it: it allocates nothing, takes no lock and keeps errno. It reaches at
/// most 64 files at a time; further ones are removed by their destructors only.
void remove_unfinished_files() noexcept;

}  // namespace mesamis
