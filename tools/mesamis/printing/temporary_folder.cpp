// SPDX-License-Identifier: Apache-2.0
#include "mesamis/printing/temporary_folder.h"

#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <system_error>

#include "mesamis/base/error.h"
#include "mesamis/files/owned_file.h"

namespace mesamis::detail::printing {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOwner = ".owner";  // in each folder; locked as long as its maker lives

/// A folder whose maker is gone, and no link to one.
bool is_left_behind(const fs::directory_entry& entry) {
  std::error_code error;
  return fs::is_directory(entry.symlink_status(error)) && is_abandoned(entry.path() / kOwner);
}

/// Removes what killed processes of this user have left.
/// @param begin  of the folders' names.
void remove_left_behind(const fs::path& place, const std::string& begin) {
  constexpr std::size_t kRandom = 6;  // characters of mkdtemp()
  std::error_code error;
  fs::directory_iterator entry(place, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.size() != begin.size() + kRandom || !name.starts_with(begin)) continue;
    std::error_code ignored;
    if (is_left_behind(*entry)) fs::remove_all(entry->path(), ignored);
  }
}

}  // namespace

TemporaryFolder::TemporaryFolder(const std::string& purpose) {
  std::error_code error;
  const fs::path place = fs::temp_directory_path(error);
  if (error) {
    throw InputError("TMPDIR: expected a folder for temporary files: " + error.message());
  }
  const std::string begin = "mesamis-" + purpose + "-";
  remove_left_behind(place, begin);
  make(place / (begin + "XXXXXX"));
}

void TemporaryFolder::make(const fs::path& pattern) {
  constexpr int kTries = 100;  // another process may take a folder without a lock for left behind
  for (int i = 0; i < kTries && lock_ < 0; ++i) {
    std::string name = pattern.string();
    if (!mkdtemp(name.data())) break;
    path_ = name;
    lock_ = create_owned(path_ / kOwner);
  }
  if (lock_ >= 0) return;
  throw InputError(pattern.parent_path().string() +
                   ": no folder for temporary files can be made there: " +
                   std::generic_category().message(errno));
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  if (lock_ >= 0) close(lock_);
}

}  // namespace mesamis::detail::printing
