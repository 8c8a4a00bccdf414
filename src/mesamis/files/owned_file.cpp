// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/owned_file.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <system_error>

#include "mesamis/base/error.h"

namespace mesamis::detail::files {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBegin = ".mesamis-", kEnd = ".unfinished";
constexpr std::size_t kDigits = 16;

/// A descriptor that is closed at the end, errno kept.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    const int error = errno;
    if (number_ >= 0) close(number_);
    errno = error;
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return number_; }
  int release() {
    const int number = number_;
    number_ = -1;
    return number;
  }

 private:
  int number_;
};

bool is_owned_name(std::string_view name) {
  if (name.size() != kBegin.size() + kDigits + kEnd.size() || !name.starts_with(kBegin) ||
      !name.ends_with(kEnd)) {
    return false;
  }
  const std::string_view digits = name.substr(kBegin.size(), kDigits);
  return std::all_of(digits.begin(), digits.end(),
                     [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

/// @param folder  descriptor of the folder that the path begins in.
/// @return  a descriptor that holds the lock of an abandoned file; -1 if there is an owner.
int take_over(int folder, const char* file) noexcept {
  // Not a link, and without waiting for whoever is at the other end of a pipe.
  Descriptor opened(openat(folder, file, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat facts {};
  const bool mine = opened.get() >= 0 && fstat(opened.get(), &facts) == 0 &&
                    S_ISREG(facts.st_mode) && facts.st_uid == geteuid();
  return mine && flock(opened.get(), LOCK_EX | LOCK_NB) == 0 ? opened.release() : -1;
}

}  // namespace

fs::path new_name(const fs::path& folder) {
  std::uint64_t number = 0;
  if (getentropy(&number, sizeof number) != 0) {
    throw InputError(folder.string() +
                     ": no random name: " + std::generic_category().message(errno));
  }
  char digits[kDigits + 1];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(number));
  return folder / (std::string(kBegin) + digits + std::string(kEnd));
}

int create_owned(const fs::path& file) noexcept {
  Descriptor made(open(file.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (made.get() < 0) return -1;
  // Before the lock is held another process may take the file for abandoned, and remove it.
  struct stat facts {};
  const bool taken = flock(made.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (taken || (fstat(made.get(), &facts) == 0 && facts.st_nlink == 0)) {
    errno = EEXIST;
    return -1;
  }
  return made.release();
}

bool is_abandoned(const fs::path& file) noexcept {
  return Descriptor(take_over(AT_FDCWD, file.c_str())).get() >= 0;
}

/// Without std::filesystem, whose iterators end the program where memory does.
void remove_abandoned(const fs::path& folder) noexcept {
  DIR* const entries = opendir(folder.c_str());
  if (entries == nullptr) return;  // a folder that cannot be listed keeps what is in it
  const int place = dirfd(entries);
  while (const dirent* entry = readdir(entries)) {
    if (!is_owned_name(entry->d_name)) continue;
    const Descriptor abandoned(take_over(place, entry->d_name));  // locked until it is gone
    if (abandoned.get() >= 0) unlinkat(place, entry->d_name, 0);
  }
  closedir(entries);
}

}  // namespace mesamis::detail::files
