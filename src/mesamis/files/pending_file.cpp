// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/pending_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <system_error>

#include "mesamis/base/error.h"
#include "mesamis/files/owned_file.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail::files {
namespace {

namespace fs = std::filesystem;

/// Names of new files where a signal handler can read them: no allocation, no locks.
struct Slot {
  enum State : int { kFree, kBusy, kArmed };
  std::atomic<int> state{kFree};
  char path[4096] = {};
};
static_assert(std::atomic<int>::is_always_lock_free);

constexpr int kNoSlot = -1;
std::array<Slot, 1024> slots;

/// No slot is left, or the name is too long: the file is then removed by its destructor only.
int occupy_slot(const std::string& path) {
  if (path.size() >= sizeof(Slot::path)) return kNoSlot;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    int expected = Slot::kFree;
    if (!slots[i].state.compare_exchange_strong(expected, Slot::kBusy)) continue;
    std::memcpy(slots[i].path, path.c_str(), path.size() + 1);
    slots[i].state.store(Slot::kArmed);
    return static_cast<int>(i);
  }
  return kNoSlot;
}

/// Not while a handler reads the name: the slot is then given up, which matters to nobody.
void release_slot(int slot) {
  if (slot == kNoSlot) return;
  int expected = Slot::kArmed;
  slots[static_cast<std::size_t>(slot)].state.compare_exchange_strong(expected, Slot::kFree);
}

[[noreturn]] void refuse_to_write(const fs::path& target, int error) {
  refuse(target, "cannot be written: " + std::generic_category().message(error));
}

/// In a folder like /tmp only the owner of a file may replace it.
bool may_replace(const struct stat& file, const fs::path& folder) {
  struct stat around {};
  if (stat(folder.c_str(), &around) != 0 || (around.st_mode & S_ISVTX) == 0) return true;
  const uid_t user = geteuid();
  return user == 0 || user == file.st_uid || user == around.st_uid;
}

/// Exchanges two files in one step.
/// @return  false, and nothing done, if one is not a file or the file system has no such step.
bool exchange(const fs::path& a, const fs::path& b) noexcept {
#ifdef RENAME_EXCHANGE
  struct stat there {};
  return lstat(b.c_str(), &there) == 0 && S_ISREG(there.st_mode) &&
         renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0;
#else
  return false;
#endif
}

/// @param place  of the target, without links.
void require_replaceable(const fs::path& target, const fs::path& place) {
  struct stat facts {};
  const bool there = lstat(place.c_str(), &facts) == 0;
  if (!there && errno != ENOENT) refuse_to_write(target, errno);
  if (target.filename().empty() || (there && !S_ISREG(facts.st_mode))) {
    refuse(target, "cannot be written: expected the name of a file");
  }
  if (there && !may_replace(facts, place.parent_path())) refuse_to_write(target, EPERM);
}

}  // namespace

PendingFile::PendingFile(fs::path target) : target_(std::move(target)), slot_(kNoSlot) {
  place_ = without_links(target_);
  require_replaceable(target_, place_);
  remove_abandoned(place_.parent_path());
  create();
}

void PendingFile::create() {
  constexpr int kTries = 100;
  for (int i = 0; descriptor_ < 0; ++i) {
    // Absolute, so that it means the same to a signal handler after a change of directory.
    temporary_ = new_name(place_.parent_path());
    slot_ = occupy_slot(temporary_.string());
    descriptor_ = create_owned(temporary_);
    const int error = errno;
    if (descriptor_ >= 0) return;
    release_slot(slot_);
    if (error != EEXIST || i == kTries) refuse_to_write(target_, error);
  }
}

PendingFile::~PendingFile() {
  if (old_ == Old::kInPlace || old_ == Old::kAside) unlink(temporary_.c_str());
  release_slot(slot_);
  close(descriptor_);  // last: up to here nobody else takes the file for abandoned
}

void PendingFile::harden() {
  struct stat old {};
  if (stat(place_.c_str(), &old) == 0 && S_ISREG(old.st_mode)) {
    constexpr mode_t kRights = S_IRWXU | S_IRWXG | S_IRWXO;
    if (fchmod(descriptor_, old.st_mode & kRights) != 0) refuse_to_write(target_, errno);
  }
  if (fsync(descriptor_) != 0) refuse_to_write(target_, errno);
}

void PendingFile::replace() {
  if (exchange(temporary_, place_)) {
    old_ = Old::kAside;
    return;
  }
  const bool there = access(place_.c_str(), F_OK) == 0;
  if (rename(temporary_.c_str(), place_.c_str()) != 0) refuse_to_write(target_, errno);
  old_ = there ? Old::kGone : Old::kNone;
}

void PendingFile::put_back() noexcept {
  if (old_ == Old::kAside && exchange(temporary_, place_)) old_ = Old::kInPlace;
  if (old_ == Old::kNone && rename(place_.c_str(), temporary_.c_str()) == 0) old_ = Old::kInPlace;
}

void flush_folder(const fs::path& folder) {
  const int opened = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened < 0) return;  // one that can be written to but not read
  const int error = fsync(opened) == 0 ? 0 : errno;
  close(opened);
  if (error != 0 && error != EINVAL && error != ENOTSUP) refuse_to_write(folder, error);
}

fs::path without_links(const fs::path& path) {
  constexpr int kMostLinks = 40;  // as many as Linux follows
  std::error_code error;
  fs::path place = fs::absolute(path, error);
  if (error) refuse(path, "cannot be written: " + error.message());
  for (int i = 0; fs::is_symlink(fs::symlink_status(place, error)); ++i) {
    if (i == kMostLinks) refuse_to_write(path, ELOOP);
    const fs::path to = fs::read_symlink(place, error);
    if (error) refuse(path, "cannot be written: " + error.message());
    place = place.parent_path() / to;  // `to` alone if it is absolute
  }
  return place;
}

void remove_pending_files() noexcept {
  const int error = errno;  // the interrupted code may be looking at it
  for (Slot& slot : slots) {
    int expected = Slot::kArmed;
    if (!slot.state.compare_exchange_strong(expected, Slot::kBusy)) continue;
    unlink(slot.path);
    slot.state.store(Slot::kArmed);
  }
  errno = error;
}

}  // namespace mesamis::detail::files
