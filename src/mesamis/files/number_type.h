// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "mesamis/files/bytes.h"

namespace mesamis::detail::files {

enum class NumberType {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat32,
  kFloat64
};

constexpr std::size_t byte_size(NumberType type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

/// Calls visit with a zero of the C++ type.
template <class Visit>
auto with_number_type(NumberType type, Visit visit) {
  switch (type) {
    case NumberType::kInt8:
      return visit(std::int8_t{});
    case NumberType::kUint8:
      return visit(std::uint8_t{});
    case NumberType::kInt16:
      return visit(std::int16_t{});
    case NumberType::kUint16:
      return visit(std::uint16_t{});
    case NumberType::kInt32:
      return visit(std::int32_t{});
    case NumberType::kUint32:
      return visit(std::uint32_t{});
    case NumberType::kInt64:
      return visit(std::int64_t{});
    case NumberType::kUint64:
      return visit(std::uint64_t{});
    case NumberType::kFloat32:
      return visit(float{});
    default:
      return visit(double{});
  }
}

/// The number as a double: exact but for whole numbers beyond 2^53.
inline double load_number(const char* bytes, NumberType type, ByteOrder order) {
  return with_number_type(
      type, [=](auto zero) { return static_cast<double>(load<decltype(zero)>(bytes, order)); });
}

}  // namespace mesamis::detail::files
