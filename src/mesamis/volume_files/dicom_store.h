// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mesamis/files/dicom_data.h"
#include "mesamis/files/zip_archive.h"

/// Where the files of a DICOM series lie: in a directory and those below it, or in a ZIP archive.
namespace mesamis::detail::volume_files {

/// Whether a path is a file that begins like a ZIP archive and is called .zip.
bool is_zip(const std::filesystem::path& path);

/// The files of a directory or an archive. Those of an archive have its path and their names in it.
class DicomStore {
 public:
  /// @param path    a directory, a DICOM file (its directory counts), or a ZIP archive, which is
  ///                read whole.
  /// @param budget  must live on.
  /// @throws InputError  as files_below(), ZipArchive and MemoryBudget::claim().
  DicomStore(const std::filesystem::path& path, MemoryBudget& budget);

  /// The files that look like DICOM. O(bytes) of an archive, which is unpacked.
  const std::vector<std::filesystem::path>& files() const { return files_; }
  /// Files that cannot be opened, each with the reason.
  const std::vector<std::string>& unreadable() const { return unreadable_; }
  /// Reads one of the files, as read_dicom_file() does.
  DicomFile read(const std::filesystem::path& file) const;

 private:
  void find_in_folder(const std::filesystem::path& path);
  void find_in_archive();
  std::string part(const std::filesystem::path& file) const;

  std::filesystem::path path_;
  MemoryBudget& budget_;
  std::string bytes_;  // of the archive, which points into it
  std::unique_ptr<ZipArchive> archive_;
  std::vector<std::filesystem::path> files_;
  std::vector<std::string> unreadable_;
};

}  // namespace mesamis::detail::volume_files
