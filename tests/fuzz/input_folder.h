// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

namespace mesamis {

/// A folder of this process in memory (/dev/shm, else the temporary one), for readers that take
/// paths. It goes with the process; what processes that crashed have left goes at the next start.
class InputFolder {
 public:
  InputFolder();
  ~InputFolder();
  InputFolder(const InputFolder&) = delete;
  InputFolder& operator=(const InputFolder&) = delete;

  /// Writes a file, over what was there.
  std::filesystem::path write(const char* name, std::string_view bytes) const;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The folder of this process.
const InputFolder& input_folder();

}  // namespace mesamis
