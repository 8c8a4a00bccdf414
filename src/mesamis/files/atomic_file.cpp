// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "mesamis/base/error.h"
#include "mesamis/files/refuse.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;

/// Names of unfinished files where a signal handler can read them: no allocation, no locks.
struct Slot {
  enum State : int { kFree, kBusy, kArmed };
  std::atomic<int> state{kFree};
  char path[4096] = {};
};
static_assert(std::atomic<int>::is_always_lock_free);

constexpr int kNoSlot = -1;
std::array<Slot, 64> slots;

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

std::string reason(int error) { return std::generic_category().message(error); }

/// Beside the target, with its extension; unlike any other file's of any process.
fs::path temporary_name(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  fs::path name = ".";
  name += target.stem();
  name += ".unfinished-" + std::to_string(getpid()) + '-' + std::to_string(counter++);
  name += target.extension();
  return target.parent_path() / name;
}

void require_replaceable(const fs::path& target) {
  std::error_code ignored;
  const fs::file_status status = fs::status(target, ignored);
  if (target.filename().empty() || (fs::exists(status) && !fs::is_regular_file(status))) {
    throw InputError(target.string() + ": cannot be written: expected the name of a file");
  }
}

}  // namespace

AtomicFile::AtomicFile(fs::path target) : target_(std::move(target)), slot_(kNoSlot) {
  require_replaceable(target_);
  // Absolute, so that it means the same to a signal handler after a change of directory.
  temporary_ = temporary_name(fs::absolute(target_));
  slot_ = occupy_slot(temporary_.string());
  const int file = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0) {
    const int error = errno;
    release_slot(slot_);
    throw InputError(target_.string() + ": cannot be written: " + reason(error));
  }
  close(file);
}

AtomicFile::~AtomicFile() {
  if (!committed_) unlink(temporary_.c_str());
  release_slot(slot_);
}

void AtomicFile::commit() {
  if (rename(temporary_.c_str(), target_.c_str()) != 0) {
    throw InputError(target_.string() + ": cannot be written: " + reason(errno));
  }
  committed_ = true;
}

void write_file(const fs::path& path, std::string_view bytes) {
  AtomicFile file(path);
  std::ofstream out(file.temporary_path(), std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) detail::refuse(path, "cannot be written; is the disk full?");
  file.commit();
}

void remove_unfinished_files() noexcept {
  const int error = errno;  // the interrupted code may be looking at it
  for (Slot& slot : slots) {
    int expected = Slot::kArmed;
    if (!slot.state.compare_exchange_strong(expected, Slot::kBusy)) continue;
    unlink(slot.path);
    slot.state.store(Slot::kArmed);
  }
  errno = error;
}

}  // namespace mesamis
