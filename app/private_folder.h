// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "interrupt.h"

namespace mesamis {

/// A folder for temporary files that only this user can read, in TMPDIR or the system's place for
/// them. It is removed with all that is in it, also when the program is interrupted: interrupts
/// are held while it exists.
class PrivateFolder {
 public:
  /// @throws InputError  if it cannot be made.
  explicit PrivateFolder(const std::string& purpose);
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  HeldInterrupts held_;
  std::filesystem::path path_;
};

}  // namespace mesamis
