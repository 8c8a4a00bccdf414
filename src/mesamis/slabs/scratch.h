// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "mesamis/slabs/archive.h"

namespace mesamis::detail::slabs {

/// The folder through which the tasks of a run hand their results on. A file that it
/// writes is whole: it appears under its name when all of it is written. (Those of mapped_items.h
/// are written in place; tasks are done when they say so.) So a run that was killed goes on where
/// it was. AtomicFile would bring each of the many files to the disk at once, and tells by locks of
/// one machine which unfinished files are abandoned.
class Scratch {
 public:
  /// @param folder  where a folder of the run's own is made, if there is none.
  /// @throws InputError  if that is not possible.
  explicit Scratch(const std::filesystem::path& folder);

  const std::filesystem::path& folder() const noexcept { return folder_; }
  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  bool has(const std::string& name) const;
  /// @throws InputError  if the file cannot be written.
  void write(const std::string& name, const ArchiveWriter& archive) const;
  /// @throws InputError  if there is no such file.
  ArchiveReader read(const std::string& name) const;
  void remove(const std::string& name) const;
  /// Removes the run's folder, and the one around it if nothing is left in that.
  void clear() const;

 private:
  std::filesystem::path folder_;
};

}  // namespace mesamis::detail::slabs
