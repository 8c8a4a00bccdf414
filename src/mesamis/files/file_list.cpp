// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/file_list.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <set>
#include <system_error>
#include <utility>

#include "mesamis/base/utf8.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail::files {
namespace {

namespace fs = std::filesystem;

/// The directories that were entered, so that links in a circle are entered once.
class Entered {
 public:
  bool add(const fs::path& directory) {
    struct stat info {};
    return ::stat(directory.c_str(), &info) == 0 && seen_.emplace(info.st_dev, info.st_ino).second;
  }

 private:
  std::set<std::pair<dev_t, ino_t>> seen_;
};

/// Enters a directory once, whatever links lead to it.
void choose_recursion(fs::recursive_directory_iterator& entry, Entered& entered) {
  std::error_code ignored;
  if (entry->is_directory(ignored) && !entered.add(entry->path())) {
    entry.disable_recursion_pending();
  }
}
void choose_recursion(const fs::directory_iterator&, const Entered&) {}

template <class Iterator>
std::vector<fs::path> collect(const fs::path& directory) {
  constexpr std::size_t kMostFiles = 100'000;
  std::vector<fs::path> files;
  std::error_code error;
  const fs::directory_iterator itself(directory, error);  // this one is not skipped
  if (error) refuse(directory, "cannot be read: " + reason_of(error));
  Entered entered;
  entered.add(directory);
  Iterator entry(directory,
                 fs::directory_options::skip_permission_denied |
                     fs::directory_options::follow_directory_symlink,
                 error);
  for (; !error && entry != Iterator(); entry.increment(error)) {
    std::error_code ignored;
    choose_recursion(entry, entered);
    if (!entry->is_regular_file(ignored)) continue;
    files.push_back(entry->path());
    if (files.size() > kMostFiles) {
      refuse(directory, message("expected at most ", kMostFiles, " files, found more"));
    }
  }
  if (error) refuse(directory, "cannot be read: " + reason_of(error));
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::string reason_of(const std::error_code& error) { return lower(error.message()); }

std::string reason_of(int error_number) {
  return reason_of(std::error_code(error_number, std::generic_category()));
}

void require_there(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found)
    refuse(path, "cannot be read: no such file or directory");
  if (error) refuse(path, "cannot be read: " + reason_of(error));
  if (!fs::is_directory(status) && !fs::is_regular_file(status)) {
    refuse(path, "expected a file or a directory, found neither");
  }
  const std::string why = fs::is_directory(status) ? "" : why_unreadable(path);
  if (!why.empty()) refuse(path, "cannot be read: " + why);
}

void require_file(const fs::path& path) {
  require_there(path);
  std::error_code error;
  if (fs::is_directory(path, error)) {
    refuse(path, "cannot be read: expected a file, found a directory");
  }
}

std::string why_unreadable(const fs::path& file) {
  errno = 0;
  const std::ifstream in(file, std::ios::binary);
  return in ? "" : reason_of(errno);
}

std::uint64_t size_of(const fs::path& file) {
  require_file(file);
  std::error_code error;
  const auto size = fs::file_size(file, error);
  if (error) refuse(file, "cannot be read: " + reason_of(error));
  return size;
}

std::vector<fs::path> files_below(const fs::path& directory) {
  return collect<fs::recursive_directory_iterator>(directory);
}

std::vector<fs::path> files_in(const fs::path& directory) {
  return collect<fs::directory_iterator>(directory);
}

std::string contents_of(const fs::path& directory) {
  constexpr std::size_t kMostNamed = 4, kLongestName = 60;
  std::error_code error;
  std::vector<std::string> names;
  fs::directory_iterator entry(directory, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code ignored;
    const std::string name = shortened(entry->path().filename().string(), kLongestName);
    if (name.starts_with('.')) continue;
    names.push_back((entry->is_directory(ignored) ? "the folder " : "") + shown(name));
  }
  if (error) refuse(directory, "cannot be read: " + reason_of(error));
  if (names.empty()) return "nothing";
  std::sort(names.begin(), names.end());
  std::string text;
  for (std::size_t n = 0; n < std::min(names.size(), kMostNamed); ++n) {
    text += (n > 0 ? ", " : "") + names[n];
  }
  return names.size() > kMostNamed ? message(text, " and ", names.size() - kMostNamed, " more")
                                   : text;
}

}  // namespace mesamis::detail::files
