// SPDX-License-Identifier: Apache-2.0
#include "mesamis/slabs/archive.h"

#include <array>

#include "mesamis/base/error.h"

namespace mesamis::detail::slabs {

namespace {

/// Before each array: how many items, and the bytes of one.
using Head = std::array<std::uint64_t, 2>;

}  // namespace

void ArchiveWriter::add_bytes(const void* items, std::size_t count, std::size_t size_of_one) {
  const Head head{count, size_of_one};
  bytes_.append(reinterpret_cast<const char*>(head.data()), sizeof(Head));
  bytes_.append(static_cast<const char*>(items), count * size_of_one);
}

std::size_t ArchiveReader::begin_array(std::size_t size_of_one) {
  Head head{};
  const std::size_t left = bytes_.size() - at_;
  if (left >= sizeof(Head)) {
    std::memcpy(head.data(), bytes_.data() + at_, sizeof(Head));
    if (head[1] == size_of_one && head[0] <= (left - sizeof(Head)) / size_of_one) {
      at_ += sizeof(Head);
      return head[0];
    }
  }
  refuse("expected an array of items of " + std::to_string(size_of_one) + " bytes at byte " +
         std::to_string(at_) + ", found another or the end");
}

void ArchiveReader::refuse(const std::string& what) const {
  throw InputError(name_.string() + ": " + what + ": the scratch file is damaged");
}

}  // namespace mesamis::detail::slabs
