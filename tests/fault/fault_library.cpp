// SPDX-License-Identifier: Apache-2.0
// Loaded before a program (LD_PRELOAD), makes one of its system calls fail, or kills it there.
//
// MESAMIS_FAULT is KIND:N, the N-th call of a kind from 1 on, after the program's first call of
// signal():
//   write    write(), writev()           fails: no space left
//   full     the same and all later ones: a disk that is full
//   seek     lseek()                     fails: I/O error
//   rename   rename(), renameat2()       fails: I/O error
//   fsync    fsync()                     fails: I/O error
//   alloc    malloc(), calloc(), realloc() of 64 bytes or more: out of memory
//   thread   pthread_create()            fails: try again
//   kill     SIGKILL before the N-th of all these but alloc, of open() of a new file and of
//   unlink()
// MESAMIS_FAULT_COUNTS names a file that gets "KIND COUNT" lines at the end of the program.
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
}

namespace {

enum Kind { kWrite, kSeek, kRename, kFsync, kAlloc, kThread, kKill, kKinds };
constexpr const char* kNames[kKinds] = {"write", "seek",   "rename", "fsync",
                                        "alloc", "thread", "kill"};

std::atomic<bool> armed{false};
std::atomic<long> counts[kKinds];

struct Plan {
  int kind = -1;
  long number = 0;
  bool for_ever = false;
};
Plan plan;

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

/// Counts a call.
/// @return whether it is to fail.
bool fails(Kind kind) {
  if (!armed) return false;
  if (kind != kAlloc && ++counts[kKill] == plan.number && plan.kind == kKill) {
    kill(getpid(), SIGKILL);
  }
  if (kind == kKill) return false;
  const long count = ++counts[kind];
  return plan.kind == kind && (plan.for_ever ? count >= plan.number : count == plan.number);
}

template <class Result>
Result failed(int error, Result result) {
  errno = error;
  return result;
}

/// What is told on the standard streams is no file of ours.
bool writing_fails(int file) { return file > STDERR_FILENO && fails(kWrite); }

__attribute__((constructor)) void read_plan() {
  const char* text = getenv("MESAMIS_FAULT");
  const char* colon = text ? strchr(text, ':') : nullptr;
  if (!colon) return;
  const std::size_t length = static_cast<std::size_t>(colon - text);
  plan.number = atol(colon + 1);
  plan.for_ever = strncmp(text, "full", length) == 0;
  if (plan.for_ever) plan.kind = kWrite;
  for (int kind = 0; kind < kKinds; ++kind) {
    if (strlen(kNames[kind]) == length && strncmp(text, kNames[kind], length) == 0) {
      plan.kind = kind;
    }
  }
}

__attribute__((destructor)) void tell_counts() {
  armed = false;
  const char* path = getenv("MESAMIS_FAULT_COUNTS");
  FILE* out = path ? fopen(path, "w") : nullptr;
  if (!out) return;
  for (int kind = 0; kind < kKinds; ++kind)
    fprintf(out, "%s %ld\n", kNames[kind], counts[kind].load());
  fclose(out);
}

}  // namespace

extern "C" {

sighandler_t signal(int number, sighandler_t handler) {
  armed = true;
  return next<sighandler_t (*)(int, sighandler_t)>("signal")(number, handler);
}

ssize_t write(int file, const void* bytes, std::size_t count) {
  if (writing_fails(file)) return failed(ENOSPC, -1);
  return next<ssize_t (*)(int, const void*, std::size_t)>("write")(file, bytes, count);
}

ssize_t writev(int file, const iovec* pieces, int count) {
  if (writing_fails(file)) return failed(ENOSPC, -1);
  return next<ssize_t (*)(int, const iovec*, int)>("writev")(file, pieces, count);
}

off_t lseek(int file, off_t offset, int whence) {
  if (fails(kSeek)) return failed(EIO, off_t{-1});
  return next<off_t (*)(int, off_t, int)>("lseek")(file, offset, whence);
}

off64_t lseek64(int file, off64_t offset, int whence) {
  if (fails(kSeek)) return failed(EIO, off64_t{-1});
  return next<off64_t (*)(int, off64_t, int)>("lseek64")(file, offset, whence);
}

int rename(const char* from, const char* to) {
  if (fails(kRename)) return failed(EIO, -1);
  return next<int (*)(const char*, const char*)>("rename")(from, to);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  if (fails(kRename)) return failed(EIO, -1);
  return next<int (*)(int, const char*, int, const char*, unsigned)>("renameat2")(
      from_folder, from, to_folder, to, flags);
}

int fsync(int file) {
  if (fails(kFsync)) return failed(EIO, -1);
  return next<int (*)(int)>("fsync")(file);
}

int unlink(const char* path) {
  fails(kKill);
  return next<int (*)(const char*)>("unlink")(path);
}

int open(const char* path, int flags, ...) {
  if ((flags & O_CREAT) == 0) return next<int (*)(const char*, int, ...)>("open")(path, flags);
  va_list more;
  va_start(more, flags);
  const mode_t mode = va_arg(more, mode_t);
  va_end(more);
  fails(kKill);
  return next<int (*)(const char*, int, ...)>("open")(path, flags, mode);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*),
                   void* argument) {
  if (fails(kThread)) return EAGAIN;
  return next<int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*)>(
      "pthread_create")(thread, attributes, work, argument);
}

constexpr std::size_t kSmall = 64;  // C++ keeps room aside for the smallest: its exceptions

void* malloc(std::size_t bytes) {
  return bytes >= kSmall && fails(kAlloc) ? failed<void*>(ENOMEM, nullptr) : __libc_malloc(bytes);
}

void* calloc(std::size_t count, std::size_t bytes) {
  return count * bytes >= kSmall && fails(kAlloc) ? failed<void*>(ENOMEM, nullptr)
                                                  : __libc_calloc(count, bytes);
}

void* realloc(void* old, std::size_t bytes) {
  return bytes >= kSmall && fails(kAlloc) ? failed<void*>(ENOMEM, nullptr)
                                          : __libc_realloc(old, bytes);
}

}  // extern "C"
