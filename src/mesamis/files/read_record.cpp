// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/read_record.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>

#include "mesamis/files/file_list.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail::files {
namespace {

thread_local ReadRecord* innermost = nullptr;

std::int64_t nanoseconds(const timespec& time) {
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

bool path_is_less(const ReadFile& a, const ReadFile& b) { return a.path < b.path; }

[[noreturn]] void refuse_changed(const std::filesystem::path& file) {
  refuse(file, "expected a file that stays as it is while it is read, found it changed");
}

}  // namespace

FileState state_of(const std::filesystem::path& file) {
  struct stat found {};
  if (stat(file.c_str(), &found) != 0) {
    refuse(file, "cannot be read: " + reason_of(errno));
  }
  return {found.st_dev, found.st_ino, static_cast<std::uint64_t>(found.st_size),
          nanoseconds(found.st_mtim), nanoseconds(found.st_ctim)};
}

ReadRecord::ReadRecord() : outer_(innermost) { innermost = this; }

ReadRecord::~ReadRecord() { innermost = outer_; }

std::vector<ReadFile> ReadRecord::files() const {
  std::vector<ReadFile> files = files_;
  std::stable_sort(files.begin(), files.end(), path_is_less);
  const auto same = [](const ReadFile& a, const ReadFile& b) {
    if (a.path != b.path) return false;
    if (a.state != b.state) refuse_changed(a.path);
    return true;
  };
  files.erase(std::unique(files.begin(), files.end(), same), files.end());
  return files;
}

void note_read(const std::filesystem::path& file, const FileState& before) {
  if (innermost == nullptr) return;
  if (state_of(file) != before) refuse_changed(file);
  innermost->files_.push_back({file, before});
}

void require_unchanged(const ReadFile& file) {
  if (state_of(file.path) != file.state) refuse_changed(file.path);
}

}  // namespace mesamis::detail::files
