// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "mesamis/io/detail/bytes.h"

namespace mesamis::detail {

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

/// The number as a double: exact but for whole numbers beyond 2^53.
inline double load_number(const char* bytes, NumberType type, ByteOrder order) {
  switch (type) {
    case NumberType::kInt8:
      return load<std::int8_t>(bytes, order);
    case NumberType::kUint8:
      return load<std::uint8_t>(bytes, order);
    case NumberType::kInt16:
      return load<std::int16_t>(bytes, order);
    case NumberType::kUint16:
      return load<std::uint16_t>(bytes, order);
    case NumberType::kInt32:
      return load<std::int32_t>(bytes, order);
    case NumberType::kUint32:
      return load<std::uint32_t>(bytes, order);
    case NumberType::kInt64:
      return static_cast<double>(load<std::int64_t>(bytes, order));
    case NumberType::kUint64:
      return static_cast<double>(load<std::uint64_t>(bytes, order));
    case NumberType::kFloat32:
      return load<float>(bytes, order);
    case NumberType::kFloat64:
      break;
  }
  return load<double>(bytes, order);
}

}  // namespace mesamis::detail
