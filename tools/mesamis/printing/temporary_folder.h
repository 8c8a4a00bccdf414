// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "mesamis/rooms.h"

namespace mesamis::detail::printing {

/// A folder for temporary files that only this user can read, in the folder that TMPDIR names or
/// the system's place for them. The destructor removes it with its content. What a killed process
/// has left is removed by the next one that makes a folder for the same purpose.
class TemporaryFolder {
 public:
  /// Makes the folder.
  /// @param purpose  part of the folder's name: mesamis-PURPOSE-XXXXXX.
  /// @throws InputError  if it cannot be made.
  explicit TemporaryFolder(const std::string& purpose);
  /// Removes the folder with its content.
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  /// @return  the absolute path of the folder, which is there.
  const std::filesystem::path& path() const noexcept { return path_; }

 private:
  void make(const std::filesystem::path& pattern);
  std::filesystem::path path_;
  int lock_ = -1;  ///< descriptor of the file that tells that the owner lives
};

}  // namespace mesamis::detail::printing
