// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

namespace mesamis {

/// A file that appears whole or not at all: write to temporary_path(), then commit() renames it
/// to the target. Without commit() the temporary file is removed, by the destructor or by
/// remove_unfinished_files() from a signal handler.
class AtomicFile {
 public:
  /// The temporary name keeps the target's extension and lies in the target's directory.
  /// @throws InputError  if the directory does not exist or cannot be written to.
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& temporary_path() const { return temporary_; }
  /// @throws InputError  if the file cannot be renamed.
  void commit();

 private:
  std::filesystem::path target_, temporary_;
  int slot_;
  bool committed_ = false;
};

/// Writes a whole file at once, through an AtomicFile.
/// @throws InputError  if it cannot be written.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Removes every temporary file that was not committed. Safe to call in a signal handler.
void remove_unfinished_files() noexcept;

}  // namespace mesamis
