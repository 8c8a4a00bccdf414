// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/mapped_items.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "mesamis/base/error.h"

namespace mesamis::detail::slabs {
namespace {

/// A file that is closed at the end.
class OpenFile {
 public:
  OpenFile(const std::filesystem::path& path, int flags)
      : path_(path), descriptor_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0) refuse("cannot be opened");
  }
  ~OpenFile() { ::close(descriptor_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  int descriptor() const noexcept { return descriptor_; }
  std::size_t size() const {
    struct stat facts {};
    if (::fstat(descriptor_, &facts) != 0) refuse("has no size");
    return static_cast<std::size_t>(facts.st_size);
  }
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(path_.string() + ": the scratch file " + what + ": " + std::strerror(errno));
  }

 private:
  const std::filesystem::path& path_;
  int descriptor_;
};

}  // namespace

void make_file(const std::filesystem::path& path, std::size_t bytes) {
  const OpenFile file(path, O_RDWR | O_CREAT | O_TRUNC);
  if (::ftruncate(file.descriptor(), static_cast<off_t>(bytes)) != 0) {
    file.refuse("found no room for " + std::to_string(bytes) + " bytes");
  }
}

void write_at(const std::filesystem::path& path, std::size_t first,
              std::span<const std::byte> bytes) {
  const OpenFile file(path, O_WRONLY);
  auto at = static_cast<off_t>(first);
  while (!bytes.empty()) {
    const ssize_t done = ::pwrite(file.descriptor(), bytes.data(), bytes.size(), at);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) file.refuse("cannot be written");
    at += done;
    bytes = bytes.subspan(static_cast<std::size_t>(done));
  }
}

MappedBytes map_file(const std::filesystem::path& path, std::size_t bytes) {
  const OpenFile file(path, O_RDONLY);
  if (file.size() != bytes) {
    throw InputError(path.string() + ": expected a scratch file of " + std::to_string(bytes) +
                     " bytes, found " + std::to_string(file.size()));
  }
  void* memory = ::mmap(nullptr, bytes, PROT_READ, MAP_SHARED, file.descriptor(), 0);
  if (memory == MAP_FAILED) file.refuse("cannot be mapped");
  return {{static_cast<const std::byte*>(memory), bytes},
          {memory, [bytes](const void* p) { ::munmap(const_cast<void*>(p), bytes); }}};
}

}  // namespace mesamis::detail::slabs
