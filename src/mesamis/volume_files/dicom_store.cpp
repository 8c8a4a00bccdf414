// SPDX-License-Identifier: Apache-2.0
#include "mesamis/volume_files/dicom_store.h"

#include <algorithm>
#include <array>
#include <system_error>

#include "mesamis/files/byte_source.h"
#include "mesamis/files/file_list.h"
#include "mesamis/files/refuse.h"
#include "mesamis/volume_files/formats.h"

namespace mesamis::detail::volume_files {
namespace {

namespace fs = std::filesystem;

Bytes bytes_in(const std::string& text) {
  return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}

}  // namespace

bool is_zip(const fs::path& path) {
  std::error_code ignored;
  if (lower_extension(path) != ".zip" || !fs::is_regular_file(path, ignored) ||
      !why_unreadable(path).empty()) {
    return false;
  }
  std::array<char, 4> begin{};
  ByteSource source(path, Packing::kPlain);
  return source.read(begin.data(), begin.size()) == begin.size() && begin[0] == 'P' &&
         begin[1] == 'K';
}

DicomStore::DicomStore(const fs::path& path, MemoryBudget& budget) : path_(path), budget_(budget) {
  if (!is_zip(path)) {
    find_in_folder(path);
    return;
  }
  bytes_ = read_all(path, budget);
  archive_ = std::make_unique<ZipArchive>(path, bytes_, budget);
  find_in_archive();
}

void DicomStore::find_in_folder(const fs::path& path) {
  const fs::path parent = path.has_parent_path() ? path.parent_path() : fs::path(".");
  for (const fs::path& file : fs::is_directory(path) ? files_below(path) : files_in(parent)) {
    if (const std::string why = why_unreadable(file); !why.empty()) {
      unreadable_.push_back(message(shown(file.filename().string()), ": ", why));
    } else if (looks_like_dicom(file)) {
      files_.push_back(file);
    }
  }
}

void DicomStore::find_in_archive() {
  for (const std::string& name : archive_->names()) {
    if (name.ends_with('/')) continue;
    const fs::path file = path_ / fs::path(name).relative_path();
    const ScopedFile scope(budget_, path_);
    if (begins_like_dicom(bytes_in(part(file)))) files_.push_back(file);
  }
  std::sort(files_.begin(), files_.end());
}

std::string DicomStore::part(const fs::path& file) const {
  const auto found = archive_->part(file.lexically_relative(path_).string());
  return found.value_or("");
}

DicomFile DicomStore::read(const fs::path& file) const {
  if (!archive_) return read_dicom_file(file, budget_);
  const std::string bytes = part(file);
  budget_.claim(bytes.size(), 1, "bytes of the file");
  return parse_dicom_file(file, {bytes.begin(), bytes.end()}, budget_);
}

}  // namespace mesamis::detail::volume_files
