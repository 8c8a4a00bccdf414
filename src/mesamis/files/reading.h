// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

/// Limits of readers, and the files they opened.
namespace mesamis {

/// Limits of a reader.
struct ReadLimits {
  /// Memory for the contents of a file, 10^9 bytes; 0: the available memory, see
  /// available_memory().
  double memory_gb = 0;
  /// Whether a header (.nhdr, .mhd) may name a data file outside its own folder.
  bool allow_outside = false;
};

/// The state of a file that every change of it alters.
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
