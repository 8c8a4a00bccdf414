// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "support/temp_folder.h"

namespace mesamis {

/// A program made of lines for the shell.
inline void write_script(const std::filesystem::path& file, const std::string& lines) {
  write_bytes(file, "#!/bin/sh\n" + lines + "\n");
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
}

}  // namespace mesamis
