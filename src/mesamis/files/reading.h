// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

/// What readers are given and tell.
namespace mesamis {

/// What a reader may take of the machine.
struct ReadLimits {
  /// Memory for what comes of a file, 10^9 bytes; 0: what is free, see available_memory().
  double memory_gb = 0;
  /// Whether a header (.nhdr, .mhd) may name a data file outside of the folder that it lies in.
  bool allow_outside = false;
};

/// What the system changes with every change of a file.
struct FileState {
  std::uint64_t device = 0, inode = 0, bytes = 0;
  std::int64_t modified_ns = 0, changed_ns = 0;  ///< of the content; of the content or the entry
  bool operator==(const FileState&) const = default;
};

/// A file that a reader has opened.
struct ReadFile {
  std::filesystem::path path;
  FileState state;  ///< when it was opened
};

}  // namespace mesamis
