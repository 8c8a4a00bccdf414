// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/file_list.h"

#include <algorithm>
#include <system_error>

#include "mesamis/files/refuse.h"

namespace mesamis::detail {
namespace {

namespace fs = std::filesystem;

template <class Iterator>
std::vector<fs::path> collect(const fs::path& directory) {
  constexpr std::size_t kMostFiles = 100'000;
  std::vector<fs::path> files;
  std::error_code error;
  Iterator entry(directory, fs::directory_options::skip_permission_denied, error);
  for (; !error && entry != Iterator(); entry.increment(error)) {
    std::error_code ignored;
    if (!entry->is_regular_file(ignored)) continue;
    files.push_back(entry->path());
    if (files.size() > kMostFiles) {
      refuse(directory, say("expected at most ", kMostFiles, " files, found more"));
    }
  }
  if (error) refuse(directory, "cannot be read: " + error.message());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::uint64_t size_of(const fs::path& file) {
  std::error_code error;
  const auto size = fs::file_size(file, error);
  if (error) refuse(file, "cannot be read: " + error.message());
  return size;
}

std::vector<fs::path> files_below(const fs::path& directory) {
  return collect<fs::recursive_directory_iterator>(directory);
}

std::vector<fs::path> files_in(const fs::path& directory) {
  return collect<fs::directory_iterator>(directory);
}

}  // namespace mesamis::detail
