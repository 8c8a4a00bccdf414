// SPDX-License-Identifier: Apache-2.0
#include "mesamis/files/memory_budget.h"

#include <limits>
#include <utility>

#include "mesamis/base/available_memory.h"
#include "mesamis/files/refuse.h"

namespace mesamis::detail::files {
namespace {

constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

std::uint64_t limit_in_bytes(const ReadLimits& limits) {
  const auto free = memory_limit(limits.memory_gb);
  return free && *free < static_cast<double>(kNoLimit) ? static_cast<std::uint64_t>(*free)
                                                       : kNoLimit;
}

}  // namespace

MemoryBudget::MemoryBudget(std::filesystem::path file, const ReadLimits& limits)
    : file_(std::move(file)), limit_(limit_in_bytes(limits)) {}

void MemoryBudget::claim(std::uint64_t count, std::uint64_t bytes_each, std::string_view what) {
  if (bytes_each == 0 || count <= left() / bytes_each) {
    held_ += count * bytes_each;
    return;
  }
  const auto megabytes = [](double bytes) { return message(bytes / 1e6, " MB"); };
  refuse(file_, message("memory: expected a file that needs at most ",
                        megabytes(static_cast<double>(limit_)), ", found one that claims ",
                        megabytes(static_cast<double>(count) * static_cast<double>(bytes_each)),
                        " for ", what, " beside ", megabytes(static_cast<double>(held_))));
}

}  // namespace mesamis::detail::files
