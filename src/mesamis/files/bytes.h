// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string>

#include "mesamis/rooms.h"

namespace mesamis::detail::files {

enum class ByteOrder { kLittle, kBig };

/// Numbers as they stand in a file, whatever the machine's own order is.
template <class Number>
Number load(const char* bytes, ByteOrder order = ByteOrder::kLittle) {
  std::array<char, sizeof(Number)> own;
  std::memcpy(own.data(), bytes, sizeof(Number));
  if ((order == ByteOrder::kBig) != (std::endian::native == std::endian::big)) {
    std::reverse(own.begin(), own.end());
  }
  return std::bit_cast<Number>(own);
}

/// Little endian.
template <class Number>
void append(std::string& out, Number value) {
  auto own = std::bit_cast<std::array<char, sizeof(Number)>>(value);
  if constexpr (std::endian::native == std::endian::big) std::reverse(own.begin(), own.end());
  out.append(own.data(), own.size());
}

}  // namespace mesamis::detail::files
