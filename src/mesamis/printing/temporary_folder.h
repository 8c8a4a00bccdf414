// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace mesamis {

/// A folder for temporary files that only this user can read, in the folder that TMPDIR names or
/// the system's place for them. The destructor removes it with its content.
class TemporaryFolder {
 public:
  /// @param purpose  part of the folder's name: mesamis-PURPOSE-XXXXXX.
  /// @throws InputError  if it cannot be made.
  explicit TemporaryFolder(const std::string& purpose);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace mesamis
